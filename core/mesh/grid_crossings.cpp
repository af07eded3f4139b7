#include "core/mesh/grid_crossings.h"

#include "core/base/check.h"
#include "core/geometry/predicates.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace oversketch {

namespace {

Point swapped(Point p) {
  return {p.y, p.x};
}

/// A segment that crosses a line, seen as if the line were vertical, from the side of smaller coordinates.
struct Crosser {
  Point low;
  Point high;
};

Crosser crosser_of(const Points& points, const GridCrossing& c) {
  Point a = points[c.segment], b = points[c.segment + 1 == static_cast<int>(points.size()) ? 0 : c.segment + 1];
  if (!c.vertical) a = swapped(a), b = swapped(b);
  return c.forward ? Crosser{a, b} : Crosser{b, a};
}

/// Sign of the difference of the coordinates at which two segments cross one line.  They do not cross each other, so it
/// is the same wherever both exist, also where one of them ends.
int compare(const Crosser& s, const Crosser& t) {
  const int at_low = s.low.x >= t.low.x ? orientation(t.low, t.high, s.low) : -orientation(s.low, s.high, t.low);
  if (at_low != 0) return at_low;
  return s.high.x <= t.high.x ? orientation(t.low, t.high, s.high) : -orientation(s.low, s.high, t.high);
}

/// Walks one segment from cell to cell.
class SegmentWalk {
public:
  SegmentWalk(const ClosedCurve& outline, const Grid& grid, int segment)
      : grid_(grid),
        a_(outline.points()[segment]),
        b_(outline.points()[segment + 1 == outline.size() ? 0 : segment + 1]),
        start_s_(outline.s_at(segment)),
        length_(distance(a_, b_)),
        segment_(segment) {}

  void run(int column, int row, int last_column, int last_row, std::vector<GridCrossing>& out) const {
    const int right = last_column > column ? 1 : -1, down = last_row > row ? 1 : -1;
    while (column != last_column || row != last_row) {
      const bool vertical =
          row == last_row ||
          (column != last_column && vertical_first(line_ahead(column, right), line_ahead(row, down), right, down));
      if (vertical) {
        out.push_back(crossing(true, right > 0, line_ahead(column, right), row));
        column += right;
      } else {
        out.push_back(crossing(false, down > 0, line_ahead(row, down), column));
        row += down;
      }
    }
  }

private:
  static int line_ahead(int cell, int step) { return step > 0 ? cell + 1 : cell; }

  /// Whether the vertical line comes before the horizontal one: by the side on which the segment passes their crossing.
  bool vertical_first(int column_line, int row_line, int right, int down) const {
    const int side = orientation(a_, b_, grid_.corner(column_line, row_line));
    // Through the corner itself: it counts as lying a step to the left, and the vertical line with it.
    return side != 0 ? side * right * down > 0 : right > 0;
  }

  GridCrossing crossing(bool vertical, bool forward, int line, int along) const {
    const double at = vertical ? grid_.x(line) : grid_.y(line);
    const double from = vertical ? a_.x : a_.y, to = vertical ? b_.x : b_.y;
    const double t = (at - from) / (to - from);
    const double position = vertical ? a_.y + t * (b_.y - a_.y) : a_.x + t * (b_.x - a_.x);
    return {vertical, forward, line, along, segment_, start_s_ + t * length_, position, 0, 0};
  }

  const Grid& grid_;
  Point a_;
  Point b_;
  double start_s_;
  double length_;
  int segment_;
};

auto edge_key(const GridCrossing& c) {
  return std::tuple(c.vertical, c.line, c.along);
}

/// Sorts crossings of one edge by coordinate: by rounded ones where these are clearly different.
void sort_edge(const Points& points, const std::vector<GridCrossing>& crossings, std::vector<int>::iterator first,
               std::vector<int>::iterator last, double rounding) {
  const bool clear = std::adjacent_find(first, last, [&](int i, int j) {
                       return crossings[j].position - crossings[i].position <= rounding;
                     }) == last;
  if (clear) return;
  // stable_sort keeps within the range even when an outline that crosses itself makes the order inconsistent.
  std::stable_sort(first, last, [&](int i, int j) {
    const double gap = crossings[j].position - crossings[i].position;
    if (std::abs(gap) > rounding) return gap > 0;
    return compare(crosser_of(points, crossings[i]), crosser_of(points, crossings[j])) < 0;
  });
}

/// Whether the inside follows the crossing at larger coordinates.
bool opens(const GridCrossing& c) {
  return c.vertical == c.forward;
}

/// Fills in rank and edge; false when inside and outside do not alternate along an edge.
bool rank_crossings(const ClosedCurve& outline, std::vector<GridCrossing>& crossings) {
  const Box box = bounds(outline.points());
  // Each position is off by less than 16 half ulps of the largest coordinate.
  const double rounding =
      1e-14 * std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  std::vector<int> order(crossings.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<int>(i);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    const GridCrossing &a = crossings[i], &b = crossings[j];
    const auto ka = edge_key(a), kb = edge_key(b);
    return ka != kb ? ka < kb : a.position < b.position;
  });
  int edge = 0;
  for (auto first = order.begin(); first != order.end(); ++edge) {
    auto last = first;
    while (last != order.end() && edge_key(crossings[*last]) == edge_key(crossings[*first]))
      ++last;
    if (last - first > 1) sort_edge(outline.points(), crossings, first, last, rounding);
    for (auto it = first; it != last; ++it) {
      if (it != first && opens(crossings[*it]) == opens(crossings[*(it - 1)])) return false;
      crossings[*it].rank = static_cast<int>(it - order.begin());
      crossings[*it].edge = edge;
    }
    first = last;
  }
  return true;
}

} // namespace

std::int64_t count_crossings(const ClosedCurve& outline, const Grid& grid) {
  std::int64_t count = 0;
  const Points& points = outline.points();
  int column = grid.column(points.back().x), row = grid.row(points.back().y);
  for (const Point p : points) {
    const int next_column = grid.column(p.x), next_row = grid.row(p.y);
    count += std::abs(next_column - column) + std::abs(next_row - row);
    column = next_column;
    row = next_row;
  }
  return count;
}

std::optional<std::vector<GridCrossing>> find_crossings(const ClosedCurve& outline, const Grid& grid) {
  std::vector<GridCrossing> crossings;
  crossings.reserve(static_cast<std::size_t>(count_crossings(outline, grid)));
  const Points& points = outline.points();
  int column = grid.column(points[0].x), row = grid.row(points[0].y);
  for (int i = 0; i < outline.size(); ++i) {
    const Point end = points[i + 1 == outline.size() ? 0 : i + 1];
    const int next_column = grid.column(end.x), next_row = grid.row(end.y);
    if (next_column != column || next_row != row)
      SegmentWalk(outline, grid, i).run(column, row, next_column, next_row, crossings);
    column = next_column;
    row = next_row;
  }
  // Rounding may put two crossings of one segment in the wrong order by a last bit.
  for (std::size_t i = 1; i < crossings.size(); ++i)
    crossings[i].s = std::max(crossings[i].s, crossings[i - 1].s);
  if (!rank_crossings(outline, crossings)) return std::nullopt;
  return crossings;
}

} // namespace oversketch
