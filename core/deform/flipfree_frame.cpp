#include "core/deform/flipfree_frame.h"

#include <cmath>

namespace oversketch {
namespace {

/// Sine of the turn below which a line goes straight on: far above rounding, far below any curve drawn by points.
constexpr double kStraight = 1e-9;

Point centroid_of(const Points& closed) {
  const Point origin = closed.front();
  Point sum;
  double area = 0;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const Point a = closed[i] - origin, b = closed[(i + 1) % closed.size()] - origin;
    sum += cross(a, b) * (a + b);
    area += 3 * cross(a, b);
  }
  return origin + sum / area;
}

bool goes_straight(Point before, Point at, Point after) {
  const Point in = at - before, out = after - at;
  return dot(in, out) > 0 && std::abs(cross(in, out)) <= kStraight * length(in) * length(out);
}

Points without_straight(const Points& closed) {
  Points out;
  const std::size_t n = closed.size();
  for (std::size_t i = 0; i < n; ++i)
    if (!goes_straight(closed[(i + n - 1) % n], closed[i], closed[(i + 1) % n])) out.push_back(closed[i]);
  return out;
}

} // namespace

double snap_to_frame(double v) {
  return std::round(v / kFrameGrid) * kFrameGrid;
}

SketchFrame make_sketch_frame(const ClosedCurve& outline, double cell, const ClosedCurve& sketch) {
  const Points corners = without_straight(sketch.points());
  const double cell_px = std::sqrt(std::abs(signed_area(corners) / outline.signed_area())) * cell;
  const Point centre = centroid_of(corners);
  Points points;
  for (const Point p : corners) {
    const Point at = (p - centre) / cell_px;
    points.push_back({snap_to_frame(at.x), snap_to_frame(at.y)});
  }
  ClosedCurve curve(std::move(points));
  const double px_per_s = sketch.length() / curve.length();
  return {std::move(curve), cell_px, centre, px_per_s};
}

} // namespace oversketch
