#pragma once

#include "core/geometry/box_levels.h"
#include "core/geometry/point.h"

namespace oversketch {

/// The point of a segment that is nearest to some point, and how far along it lies (0 at its start, 1 at its end).
struct SegmentHit {
  int segment = 0;
  double t = 0;
  Point point;
  /// Squared distance, px².
  double squared = HUGE_VAL;
};

/// Nearest point of the segment a…b.  The result never leaves the box round a and b, not even by rounding; its ends are
/// met exactly; a segment of no length is its start.  `segment` is 0.
inline SegmentHit nearest_on_segment(Point a, Point b, Point p) {
  const Point along = b - a;
  const double reach = dot(p - a, along), squared_length = dot(along, along);
  SegmentHit hit;
  if (!(reach > 0)) {
    hit.point = a;
  } else if (reach >= squared_length) {
    hit.t = 1;
    hit.point = b;
  } else {
    hit.t = reach / squared_length;
    const Point q = a + hit.t * along;
    hit.point = {std::clamp(q.x, std::min(a.x, b.x), std::max(a.x, b.x)),
                 std::clamp(q.y, std::min(a.y, b.y), std::max(a.y, b.y))};
  }
  const Point away = p - hit.point;
  hit.squared = dot(away, away);
  return hit;
}

/// Nearest-point search on a polyline.
///
/// The same hit, bit by bit, as trying every segment with nearest_on_segment() and keeping the first best: boxes bound
/// the computed distances, not only the true ones, because rounding is monotone.
/// @cost O(n) to build, 48 bytes a point.  A query near the line about O(log n); at worst (all segments equally far)
/// O(n).
/// @threads safe to read from several threads.
class SegmentTree {
public:
  /// At least one point; a closed line has a segment from the last point to the first.  Finite points only.
  SegmentTree(const Points& points, bool closed);

  int segment_count() const { return levels_.item_count(); }
  /// The smallest segment number where several are equally near.
  SegmentHit nearest(Point p) const;

private:
  struct Bounds {
    Point low{HUGE_VAL, HUGE_VAL};
    Point high{-HUGE_VAL, -HUGE_VAL};
    void add(const Bounds& other) {
      low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
      high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
    }
    double squared_distance(Point p) const {
      const double dx = std::max(0.0, std::max(low.x - p.x, p.x - high.x));
      const double dy = std::max(0.0, std::max(low.y - p.y, p.y - high.y));
      return dx * dx + dy * dy;
    }
  };

  /// Segment k joins ring_[k] and ring_[k + 1].
  Points ring_;
  BoxLevels<Bounds> levels_;
};

} // namespace oversketch
