#include "core/base/check.h"
#include "core/geometry/mask.h"

#include <cstddef>

namespace oversketch {

namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t kOne = 1 << 16;
constexpr std::int64_t kHalf = kOne / 2;

struct FixedPoint {
  std::int64_t x;
  std::int64_t y;
};

FixedPoint to_fixed(Point p) {
  CHECK(std::abs(p.x) < kMaskCoordinateLimit && std::abs(p.y) < kMaskCoordinateLimit,
        "a polygon to be rasterized must keep to the coordinate limit");
  return {std::llrint(p.x * static_cast<double>(kOne)), std::llrint(p.y * static_cast<double>(kOne))};
}

std::int64_t ceil_divided(std::int64_t a, std::int64_t b) {
  return a >= 0 ? (a + b - 1) / b : -(-a / b);
}

/// First row whose centre is at or below the height y.
std::int64_t first_row(std::int64_t y) {
  return ceil_divided(y - kHalf, kOne);
}

/// Where an edge passes a row: the first column whose centre is not to its left, and which way the edge runs.
struct Pass {
  int column;
  int winding;
};

/// An edge from its upper to its lower end, and the rows that it passes within the clip.
struct Edge {
  FixedPoint top;
  FixedPoint bottom;
  int winding;
  int begin;
  int end;

  /// Calls visit(row, column) for each row.  Column = ceil((X − ½) of the crossing), by a division carried on row by
  /// row: quotient and rest of A / D with A = (top.x − ½) dy + (row centre − top.y) dx, D = dy, all in units of 2⁻¹⁶
  /// px.
  template <class Visit>
  void walk(Visit&& visit) const {
    const std::int64_t dx = bottom.x - top.x, dy = bottom.y - top.y, divisor = kOne * dy;
    const std::int64_t down = kOne * begin + kHalf - top.y;
    const Wide start = static_cast<Wide>(top.x - kHalf) * dy + static_cast<Wide>(down) * dx;
    std::int64_t quotient = static_cast<std::int64_t>(start / divisor);
    std::int64_t rest = static_cast<std::int64_t>(start % divisor);
    if (rest < 0) rest += divisor, --quotient;
    std::int64_t step = dx / dy, step_rest = dx % dy;
    if (step_rest < 0) step_rest += dy, --step;
    step_rest *= kOne;
    for (int row = begin; row < end; ++row) {
      visit(row, static_cast<int>(quotient + (rest > 0)));
      quotient += step;
      rest += step_rest;
      if (rest >= divisor) rest -= divisor, ++quotient;
    }
  }
};

std::vector<Edge> edges_of(const Points& polygon, const Rect& clip) {
  std::vector<Edge> edges;
  edges.reserve(polygon.size());
  FixedPoint from = to_fixed(polygon.back());
  for (const Point p : polygon) {
    const FixedPoint to = to_fixed(p);
    const bool down = from.y < to.y;
    const FixedPoint top = down ? from : to, bottom = down ? to : from;
    const std::int64_t begin = std::max<std::int64_t>(first_row(top.y), clip.y);
    const std::int64_t end = std::min<std::int64_t>(first_row(bottom.y), clip.bottom());
    if (begin < end) edges.push_back({top, bottom, down ? 1 : -1, static_cast<int>(begin), static_cast<int>(end)});
    from = to;
  }
  return edges;
}

/// All passes, row by row: row r's are passes[starts[r − top] … starts[r − top + 1]).
struct Passes {
  int top = 0;
  std::vector<std::size_t> starts;
  std::vector<Pass> passes;
};

Passes passes_by_row(const std::vector<Edge>& edges) {
  int top = edges.front().begin, bottom = edges.front().end;
  for (const Edge& edge : edges)
    top = std::min(top, edge.begin), bottom = std::max(bottom, edge.end);
  const auto row_index = [top](int row) { return static_cast<std::size_t>(row - top); };
  // Counts that come and go with each edge, summed once for the number of passes and again for where each row starts.
  std::vector<std::int64_t> change(row_index(bottom) + 1, 0);
  for (const Edge& edge : edges)
    ++change[row_index(edge.begin)], --change[row_index(edge.end)];
  Passes all{top, std::vector<std::size_t>(row_index(bottom) + 1, 0), {}};
  std::int64_t in_row = 0;
  for (std::size_t r = 0; r + 1 < all.starts.size(); ++r) {
    in_row += change[r];
    all.starts[r + 1] = all.starts[r] + static_cast<std::size_t>(in_row);
  }
  all.passes.resize(all.starts.back());
  std::vector<std::size_t> next = all.starts;
  for (const Edge& edge : edges)
    edge.walk([&](int row, int column) { all.passes[next[row_index(row)]++] = {column, edge.winding}; });
  return all;
}

} // namespace

Mask rasterize_polygon(const Points& polygon, const Rect& clip) {
  if (polygon.empty()) return {};
  const std::vector<Edge> edges = edges_of(polygon, clip);
  if (edges.empty() || clip.empty()) return {};
  Passes all = passes_by_row(edges);
  std::vector<Mask::Run> runs;
  for (std::size_t r = 0; r + 1 < all.starts.size(); ++r) {
    const auto begin = all.passes.begin() + static_cast<std::ptrdiff_t>(all.starts[r]);
    const auto end = all.passes.begin() + static_cast<std::ptrdiff_t>(all.starts[r + 1]);
    std::sort(begin, end, [](const Pass& a, const Pass& b) { return a.column < b.column; });
    int winding = 0, entered = 0;
    for (auto pass = begin; pass != end; ++pass) {
      if (winding == 0) entered = pass->column;
      winding += pass->winding;
      if (winding != 0) continue;
      const int x0 = std::max(entered, clip.x), x1 = std::min(pass->column, clip.right());
      if (x0 < x1) runs.push_back({all.top + static_cast<int>(r), x0, x1});
    }
  }
  return Mask(std::move(runs));
}

} // namespace oversketch
