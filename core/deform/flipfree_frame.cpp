#include "core/deform/flipfree_frame.h"

#include <cmath>

namespace oversketch {
namespace {

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

} // namespace

double snap_to_frame(double v) {
  return std::round(v / kFrameGrid) * kFrameGrid;
}

SketchFrame make_sketch_frame(const ClosedCurve& outline, double cell, const ClosedCurve& sketch) {
  const double cell_px = std::sqrt(std::abs(sketch.signed_area() / outline.signed_area())) * cell;
  const Point centre = centroid_of(sketch.points());
  Points points;
  for (const Point p : sketch.points()) {
    const Point at = (p - centre) / cell_px;
    points.push_back({snap_to_frame(at.x), snap_to_frame(at.y)});
  }
  ClosedCurve curve(std::move(points));
  const double px_per_s = sketch.length() / curve.length();
  return {std::move(curve), cell_px, centre, px_per_s};
}

} // namespace oversketch
