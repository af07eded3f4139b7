#include "core/geometry/mask.h"

#include "core/base/check.h"

#include <array>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace oversketch {

namespace {

bool comes_before(const Mask::Run& a, const Mask::Run& b) {
  return std::tie(a.y, a.x0, a.x1) < std::tie(b.y, b.x0, b.x1);
}

/// Reads runs in order, row by row.
struct RowReader {
  const std::vector<Mask::Run>& runs;
  std::size_t at = 0;

  void seek(int y) {
    while (at < runs.size() && runs[at].y < y)
      ++at;
  }
  bool on(int y) const { return at < runs.size() && runs[at].y == y; }
};

} // namespace

Mask::Mask(std::vector<Run> runs) : runs_(std::move(runs)) {
  std::erase_if(runs_, [](const Run& run) { return run.x1 <= run.x0; });
  if (runs_.empty()) return;
  if (!std::is_sorted(runs_.begin(), runs_.end(), comes_before)) std::sort(runs_.begin(), runs_.end(), comes_before);
  std::size_t last = 0;
  for (std::size_t i = 1; i < runs_.size(); ++i) {
    const Run run = runs_[i];
    if (run.y == runs_[last].y && run.x0 <= runs_[last].x1)
      runs_[last].x1 = std::max(runs_[last].x1, run.x1);
    else
      runs_[++last] = run;
  }
  runs_.resize(last + 1);
  int x0 = runs_[0].x0, x1 = runs_[0].x1;
  for (const Run& run : runs_) {
    x0 = std::min(x0, run.x0);
    x1 = std::max(x1, run.x1);
    count_ += static_cast<std::int64_t>(run.x1) - run.x0;
  }
  bounds_ = {x0, runs_.front().y, x1 - x0, runs_.back().y - runs_.front().y + 1};
}

bool Mask::contains(int x, int y) const {
  const Run last_possible{y, x, std::numeric_limits<int>::max()};
  const auto after = std::upper_bound(runs_.begin(), runs_.end(), last_possible, comes_before);
  if (after == runs_.begin()) return false;
  const Run& run = *(after - 1);
  return run.y == y && run.x0 <= x && x < run.x1;
}

Mask translated(const Mask& mask, int dx, int dy) {
  std::vector<Mask::Run> runs = mask.runs();
  for (Mask::Run& run : runs)
    run = {run.y + dy, run.x0 + dx, run.x1 + dx};
  return Mask(std::move(runs));
}

Mask grown(const Mask& mask) {
  const auto& runs = mask.runs();
  std::vector<Mask::Run> out;
  out.reserve(runs.size() * 3);
  // Three readers walk the rows below, at and above the one being made; merging keeps the runs sorted.
  std::array<RowReader, 3> readers{RowReader{runs}, RowReader{runs}, RowReader{runs}};
  for (std::size_t i = 0; i < runs.size();) {
    const int row = runs[i].y;
    // This row may be reached from itself and from the next; rows above it were done unless there was a gap.
    const int first = out.empty() ? row - 1 : std::max(row - 1, out.back().y + 1);
    for (int y = first; y <= row + 1; ++y) {
      for (int k = 0; k < 3; ++k)
        readers[static_cast<std::size_t>(k)].seek(y + k - 1);
      for (;;) {
        RowReader* next = nullptr;
        for (int k = 0; k < 3; ++k) {
          RowReader& reader = readers[static_cast<std::size_t>(k)];
          if (!reader.on(y + k - 1)) continue;
          if (next == nullptr || runs[reader.at].x0 < runs[next->at].x0) next = &reader;
        }
        if (next == nullptr) break;
        const Mask::Run& run = runs[next->at++];
        if (!out.empty() && out.back().y == y && run.x0 - 1 <= out.back().x1)
          out.back().x1 = std::max(out.back().x1, run.x1 + 1);
        else
          out.push_back({y, run.x0 - 1, run.x1 + 1});
      }
    }
    while (i < runs.size() && runs[i].y == row)
      ++i;
  }
  return Mask(std::move(out));
}

Mask intersect(const Mask& mask, const Rect& rect) {
  std::vector<Mask::Run> out;
  const auto begin = std::lower_bound(mask.runs().begin(), mask.runs().end(), rect.y,
                                      [](const Mask::Run& run, int y) { return run.y < y; });
  for (auto run = begin; run != mask.runs().end() && run->y < rect.bottom(); ++run)
    out.push_back({run->y, std::max(run->x0, rect.x), std::min(run->x1, rect.right())});
  return Mask(std::move(out));
}

} // namespace oversketch
