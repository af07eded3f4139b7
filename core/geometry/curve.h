#pragma once

#include "core/base/result.h"
#include "core/geometry/point.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace oversketch {

/// A place on a curve: arc length from its first point (px), the point itself, and the segment it lies on.
struct CurvePosition {
  double s = 0;
  Point point;
  int segment = 0;
  /// Distance from what was asked for, px.
  double distance = 0;
};

/// A closed polygon by arc length.  Immutable; copies share everything.
///
/// The last point is joined to the first; points need not be distinct, but the whole length must be positive and every
/// coordinate finite (CHECK).  s counts modulo length().
/// @threads safe to read from several threads.
class ClosedCurve {
public:
  explicit ClosedCurve(Points points);

  const Points& points() const;
  int size() const;
  double length() const;
  /// Positive when the points run clockwise on the screen (y down), px².
  double signed_area() const;
  /// Arc length at point i.
  double s_at(int i) const;
  /// The point at arc length s (any real number).  O(log n).
  Point at(double s) const;
  /// Unit tangent of the segment at s; the following segment's at a corner.  O(log n).
  Point tangent(double s) const;
  /// Unit vector of at(s + half) − at(s − half): a tangent averaged over 2·half px; tangent(s) where that vanishes.
  Point smooth_tangent(double s, double half) const;
  int segment_at(double s) const;
  /// Nearest point of the curve, the same to the last bit as trying every segment; the smaller s where several are
  /// equally near.  About O(log n) for points near the curve; O(n) where all of it is equally far, as from a circle's
  /// centre.
  CurvePosition nearest(Point p) const;
  /// s of `b` minus s of `a` going forwards, in [0, length).
  double forward(double a, double b) const;
  /// s brought into [0, length).
  double wrap(double s) const;

private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

double signed_area(const Points& closed);
double perimeter(const Points& closed);
double path_length(const Points& open);
/// By the nonzero-winding rule, exactly; a point on an edge belongs to the inside on the edge's right (or, for a
/// horizontal edge, below it), as in rasterize_polygon().  O(n).
bool contains(const Points& closed, Point p);

/// Where two segments of a polyline cross or touch: segments i < j (segment k joins points k and k + 1) and the point.
struct Crossing {
  int first = 0;
  int second = 0;
  Point point;
};

/// First crossing in order of (first, second), exact (the orientation test never errs by rounding); neighbours count
/// only when they fold back on each other.  Repeated points count as one.  `point` is right to rounding.
/// @cost O(n log n) on ordinary curves, about 0.2 µs a point, and on long straight hatching in any one direction; 150
/// bytes
///   a point whatever the lengths.
std::optional<Crossing> find_self_crossing(const Points& points, bool closed);

/// Douglas–Peucker: a subset of the points, every dropped one within `tolerance` px of the result's chord.  For a
/// closed curve the first point and the one furthest from it are kept.  tolerance ≥ 0 (CHECK).
/// @cost O(n log n) on ordinary curves, O(n · points kept) at worst; no recursion.
Points simplify(const Points& points, double tolerance, bool closed);

/// `count` ≥ 3 points equally spaced by arc length, the first at s = 0.
Points resample(const ClosedCurve& curve, int count);

/// The curve without repeated neighbours (exactly equal points), the closing repeat of the first one included.
Points without_repeats(const Points& closed);

/// What every outline and sketch must be: at least 3 distinct points, finite, |coordinate| < kMaskCoordinateLimit, area
/// at least `least_area` px², no crossing.  Nothing is repaired but exact repeats.
/// @param what  "outline" or "sketch", for the sentence.
/// @errors curve.too-few-points, curve.not-finite, curve.too-far, curve.no-area, curve.crosses-itself (with the point).
Result<Points> check_closed_curve(const Points& points, std::string_view what, double least_area = 1.0);

} // namespace oversketch
