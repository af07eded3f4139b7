#include "core/clone/pixel_graph.h"

#include "core/base/check.h"

#include <algorithm>
#include <limits>

namespace oversketch {
namespace {

/// Walks one row's run along the runs of the row at `step` (−1 above, +1 below): `met(k, x0, x1)` for each overlap with
/// run k, `open(x0, x1)` for each part without a neighbour.  `from` is a run not right of this one, moved on as far as
/// the next run of the row may need it.
template <class Met, class Open>
void walk(const std::vector<Mask::Run>& runs, std::size_t run, int step, std::size_t& from, Met met, Open open) {
  const Mask::Run& here = runs[run];
  const int y = here.y + step;
  while (from < runs.size() && (runs[from].y < y || (runs[from].y == y && runs[from].x1 <= here.x0)))
    ++from;
  int x = here.x0;
  for (std::size_t k = from; k < runs.size() && runs[k].y == y && runs[k].x0 < here.x1; ++k) {
    const int x0 = std::max(here.x0, runs[k].x0), x1 = std::min(here.x1, runs[k].x1);
    if (x < x0) open(x, x0);
    met(k, x0, x1);
    x = x1;
  }
  if (x < here.x1) open(x, here.x1);
}

} // namespace

PixelGraph::PixelGraph(const Mask& pixels) : mask(pixels) {
  CHECK(mask.count() <= std::numeric_limits<int>::max(), "more pixels than numbers");
  const std::vector<Mask::Run>& runs = mask.runs();
  first.reserve(runs.size());
  for (const Mask::Run& run : runs) {
    first.push_back(count);
    count += run.x1 - run.x0;
  }
  std::size_t above = 0, below = 0;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const auto [y, x0, x1] = runs[run];
    const int base = first[run] - x0;
    const auto open_at = [&](int row) {
      return [this, base, row](int from, int to) {
        for (int x = from; x < to; ++x)
          ring.push_back({base + x, x, row});
      };
    };
    walk(
        runs, run, -1, above,
        [&](std::size_t k, int from, int to) {
          stretches.push_back({first[k] + from - runs[k].x0, base + from, to - from});
        },
        open_at(y - 1));
    ring.push_back({first[run], x0 - 1, y});
    ring.push_back({base + x1 - 1, x1, y});
    walk(
        runs, run, +1, below, [](std::size_t, int, int) {}, open_at(y + 1));
  }
}

} // namespace oversketch
