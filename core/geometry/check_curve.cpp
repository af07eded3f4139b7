#include "core/geometry/curve.h"
#include "core/geometry/mask.h"
#include "core/geometry/point_text.h"

#include <cstddef>
#include <cstdio>
#include <string>

namespace oversketch {

namespace {

std::string place(std::string_view what, std::size_t i) {
  return std::string(what) + " point " + std::to_string(i);
}

Result<void> check_coordinates(const Points& points, std::string_view what) {
  const std::string name(what);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = points[i];
    if (!is_finite(p))
      return Error{"curve.not-finite", "the " + name + " has a coordinate that is not a finite number", place(what, i)};
    if (std::abs(p.x) >= kMaskCoordinateLimit || std::abs(p.y) >= kMaskCoordinateLimit)
      return Error{"curve.too-far",
                   "the " + name + " reaches " + point_text(p) + ": keep it within " +
                       std::to_string(static_cast<int>(kMaskCoordinateLimit)) + " px of the origin",
                   place(what, i)};
  }
  return {};
}

int count_distinct_up_to_three(const Points& points) {
  if (points.empty()) return 0;
  const auto differs = [&](Point p) { return !(p == points[0]); };
  const auto second = std::find_if(points.begin(), points.end(), differs);
  if (second == points.end()) return 1;
  const auto third = std::find_if(second, points.end(), [&](Point p) { return differs(p) && !(p == *second); });
  return third == points.end() ? 2 : 3;
}

/// No less than the area of any part of the curve: tells a line, which has none, from a figure of eight.
double area_without_sign(const Points& points) {
  double twice = 0;
  for (std::size_t i = 2; i < points.size(); ++i)
    twice += std::abs(cross(points[i - 1] - points[0], points[i] - points[0]));
  return 0.5 * twice;
}

} // namespace

Result<Points> check_closed_curve(const Points& points, std::string_view what, double least_area) {
  const std::string name(what);
  if (const auto finite = check_coordinates(points, what); !finite) return finite.error();
  if (const int distinct = count_distinct_up_to_three(points); distinct < 3)
    return Error{"curve.too-few-points",
                 "the " + name + " has " + std::to_string(distinct) + (distinct == 1 ? " point" : " different points") +
                     ": draw a line round an area",
                 name};
  const auto check_area = [&](double area) -> Result<void> {
    if (area > 0 && area >= least_area) return {};
    char sizes[96];
    std::snprintf(sizes, sizeof sizes, "encloses %.3g px², less than %.3g px²", area, least_area);
    return Error{"curve.no-area", "the " + name + " " + sizes + ": draw it round a larger area", name};
  };
  if (const auto flat = check_area(area_without_sign(points)); !flat) return flat.error();
  if (const auto crossing = find_self_crossing(points, true))
    return Error{"curve.crosses-itself",
                 "the " + name + " crosses itself at " + point_text(crossing->point) + ": draw it without crossings",
                 place(what, static_cast<std::size_t>(crossing->first))};
  if (const auto small = check_area(std::abs(signed_area(points))); !small) return small.error();
  return without_repeats(points);
}

} // namespace oversketch
