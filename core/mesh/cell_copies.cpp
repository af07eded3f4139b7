#include "core/mesh/cell_copies.h"

#include "core/base/check.h"
#include "core/geometry/predicates.h"

#include <algorithm>
#include <utility>

namespace oversketch {

namespace {

/// A segment that crosses the horizontal line through a point, from above to below (y grows).
struct Hit {
  Point top;
  Point bottom;
  int chain = 0;
  /// The outline goes down here: what lies to the right of it is outside.
  bool down = false;
};

/// Whether `a` lies left of `b` on the line that both cross; they do not cross each other.
bool left_of(const Hit& a, const Hit& b) {
  // Of a segment run from top to bottom, smaller x is the side on which orientation is positive.
  const int at_top = a.top.y >= b.top.y ? orientation(b.top, b.bottom, a.top) : -orientation(a.top, a.bottom, b.top);
  if (at_top != 0) return at_top > 0;
  return (a.bottom.y <= b.bottom.y ? orientation(b.top, b.bottom, a.bottom) : -orientation(a.top, a.bottom, b.bottom)) >
         0;
}

/// Finds the copy of one entered cell that holds a point: looks left from the point to the nearest chain, or to the
/// cell's left side and what lies there.
class CellSearch {
public:
  CellSearch(const CellCopies& copies, const CellCopies::Span& span, Point p)
      : c_(copies), span_(span), p_(p), edge_{copies.grid.x(span.first_column), p.y} {}

  std::optional<int> run() const {
    std::optional<Hit> nearest;
    for (int i = span_.first_stop; i < span_.last_stop; ++i)
      if (c_.stops[i].enters) search_chain(c_.stops[i].chain, nearest);
    if (!nearest) return at_left_side();
    if (nearest->down) return std::nullopt;
    return c_.chains[nearest->chain].copy;
  }

private:
  void search_chain(int chain, std::optional<Hit>& nearest) const {
    const Points& points = c_.outline.points();
    const int n = c_.outline.size();
    const bool last = chain + 1 == static_cast<int>(c_.chains.size());
    const int first_segment = c_.chains[chain].segment;
    const int end_segment = last ? c_.chains[0].segment + n : c_.chains[chain + 1].segment;
    for (int i = first_segment; i <= end_segment; ++i) {
      const Point a = points[i % n], b = points[(i + 1) % n];
      const bool down = b.y > p_.y;
      if ((a.y > p_.y) == down) continue;
      const Hit hit{down ? a : b, down ? b : a, chain, down};
      // Between the left side and the point; on the left side itself counts as within, as the grid's lines count.
      if (orientation(hit.top, hit.bottom, p_) > 0 || orientation(hit.top, hit.bottom, edge_) < 0) continue;
      if (!nearest || left_of(*nearest, hit)) nearest = hit;
    }
  }

  std::optional<int> at_left_side() const {
    // Sides 0, 1, 2 come before the left one, which runs upwards.
    int before = span_.last_stop - 1;
    while (before >= span_.first_stop && c_.stops[before].side == 3 && !is_below(c_.stops[before]))
      --before;
    if (before < span_.first_stop) before = span_.last_stop - 1;
    const CellCopies::Stop& stop = c_.stops[before];
    if (stop.enters) return std::nullopt;
    return c_.chains[stop.chain].copy;
  }

  /// Whether the outline crosses the cell's left side below the point's height.
  bool is_below(const CellCopies::Stop& stop) const {
    const Points& points = c_.outline.points();
    Point a = points[stop.segment], b = points[(stop.segment + 1) % c_.outline.size()];
    if (!stop.forward) std::swap(a, b);
    const int side = orientation(a, b, edge_);
    // Through the very place: the left side counts as a step further left, where the segment is lower if it rises.
    return side != 0 ? side < 0 : b.y < a.y;
  }

  const CellCopies& c_;
  const CellCopies::Span& span_;
  Point p_;
  /// The point's height on the cell's left side.
  Point edge_;
};

} // namespace

int CellCopies::chain_at(double s) const {
  const auto after =
      std::upper_bound(chains.begin(), chains.end(), s, [](double at, const Chain& c) { return at < c.start_s; });
  return static_cast<int>((after == chains.begin() ? chains.end() : after) - chains.begin()) - 1;
}

const CellCopies::Span* CellCopies::span_of(int column, int row) const {
  const int r = row - first_row;
  if (r < 0 || r + 1 >= static_cast<int>(first_span_of_row.size())) return nullptr;
  const auto first = spans.begin() + first_span_of_row[r], last = spans.begin() + first_span_of_row[r + 1];
  const auto at = std::lower_bound(first, last, column, [](const Span& s, int c) { return s.last_column < c; });
  return at == last || at->first_column > column ? nullptr : &*at;
}

std::optional<int> CellCopies::copy_at(Point p) const {
  const int column = grid.column(p.x), row = grid.row(p.y);
  const Span* span = span_of(column, row);
  if (span == nullptr) return std::nullopt;
  if (!span->entered()) return span->first_copy + (column - span->first_column);
  return CellSearch(*this, *span, p).run();
}

} // namespace oversketch
