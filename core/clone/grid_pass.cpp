#include "core/clone/grid_pass.h"

#include "core/base/parallel.h"

#include <algorithm>

namespace oversketch {
namespace {

/// Starting a thread costs as much as this many nodes of a pass.
constexpr int kLeastNodesPerThread = 30'000;

/// How many rows before they are needed values are fetched; not on grids with fewer nodes, 8 MB: what stays in the
/// last cache comes soon enough, and asking takes a tenth of the time.
constexpr int kAhead = 2;
constexpr int kLeastFetched = 350'000;

/// Rows at which bands begin, and one past the last row at the end; bands of about as many nodes.
std::vector<int> cut_bands(const GridLevel& level, int threads, int lag) {
  const int bands = std::clamp(level.count() / kLeastNodesPerThread, 1, std::max(1, threads));
  std::vector<int> begin = {0};
  for (int band = 1; band < bands; ++band) {
    const auto node = static_cast<int>(static_cast<std::int64_t>(level.count()) * band / bands);
    int low = begin.back(), high = level.rows();
    while (low < high) {
      const int middle = (low + high) / 2;
      if (level.first_in(middle) < node)
        low = middle + 1;
      else
        high = middle;
    }
    // Neighbouring seams must not touch each other's rows.
    if (low > begin.back() + 2 * lag + 2 && low < level.rows() - 2 * lag - 2) begin.push_back(low);
  }
  begin.push_back(level.rows());
  return begin;
}

void run_band(GridRows& rows, const RowPass& pass, bool fetches, int begin, int end, bool is_first, bool is_last) {
  const int lag = pass.stages.back().lag;
  const std::function<void(int row)> write = pass.make_writer ? pass.make_writer() : nullptr;
  for (int head = begin; head < end + lag; ++head) {
    if (write && head < end) write(head);
    std::size_t part = 0;
    for (const RowStage& stage : pass.stages) {
      if (fetches && head + kAhead < end) rows.fetch(head + kAhead, part++, pass.stages.size(), pass.needed);
      const int row = head - stage.lag;
      if (row >= begin + (is_first ? 0 : stage.lag) && row < end - (is_last ? 0 : stage.lag)) stage.run(rows, row);
    }
  }
}

} // namespace

void run_pass(const GridLevel& level, GridValues values, const GridKernels& kernels, std::span<const float> zeros,
              const RowPass& pass, int threads) {
  const std::vector<int> begin = cut_bands(level, threads, pass.stages.back().lag);
  const std::size_t bands = begin.size() - 1;
  const bool fetches = level.count() >= kLeastFetched && !pass.make_writer;
  run_parallel(static_cast<int>(bands), threads, [&](int i) {
    const auto band = static_cast<std::size_t>(i);
    GridRows rows(level, values, kernels, zeros);
    run_band(rows, pass, fetches, begin[band], begin[band + 1], band == 0, band + 1 == bands);
  });
  for (std::size_t band = 1; band < bands; ++band) {
    GridRows rows(level, values, kernels, zeros);
    for (const RowStage& stage : pass.stages)
      for (int row = begin[band] - stage.lag; row < begin[band] + stage.lag; ++row)
        stage.run(rows, row);
  }
}

} // namespace oversketch
