#include "core/geometry/curve.h"

#include "core/base/index.h"
#include "core/geometry/predicates.h"
#include "core/geometry/segment_tree.h"

#include <cstddef>
#include <utility>

namespace oversketch {

struct ClosedCurve::Data {
  Points points;
  /// Arc length at each point, and the whole length as the last entry.
  std::vector<double> arc;
  /// For each of n equal parts of the length, the number of points before it: narrows the search for a segment.
  std::vector<int> parts;
  double parts_per_px = 0;
  double area = 0;
  SegmentTree tree;

  explicit Data(Points all) : points(std::move(all)), tree(points, true) {
    const int n = static_cast<int>(points.size());
    arc.resize(points.size() + 1);
    for (int i = 0; i < n; ++i)
      arc[index(i + 1)] = arc[index(i)] + distance(points[index(i)], end_of(i));
    CHECK(arc.back() > 0 && std::isfinite(arc.back()), "a closed curve must have a positive, finite length");
    area = oversketch::signed_area(points);
    parts_per_px = n / arc.back();
    parts.assign(points.size() + 2, 0);
    for (int i = 0; i < n; ++i)
      ++parts[index(part_of(arc[index(i)]) + 1)];
    for (std::size_t k = 1; k < parts.size(); ++k)
      parts[k] += parts[k - 1];
  }

  Point end_of(int segment) const { return points[index(segment + 1) == points.size() ? 0 : index(segment + 1)]; }
  /// Monotone in s, so that comparing parts never contradicts comparing s.
  int part_of(double s) const { return std::min(static_cast<int>(s * parts_per_px), static_cast<int>(points.size())); }

  /// The last segment that starts at or before s, 0 ≤ s < length: never one of no length.
  int segment_at(double s) const {
    const int part = part_of(s);
    const auto first = arc.begin() + parts[index(part)], last = arc.begin() + parts[index(part) + 1];
    return static_cast<int>(std::upper_bound(first, last, s) - arc.begin()) - 1;
  }
};

ClosedCurve::ClosedCurve(Points points) {
  CHECK(!points.empty(), "a closed curve needs points");
  for (const Point p : points)
    CHECK(is_finite(p), "a closed curve must be finite");
  data_ = std::make_shared<const Data>(std::move(points));
}

const Points& ClosedCurve::points() const {
  return data_->points;
}
int ClosedCurve::size() const {
  return static_cast<int>(data_->points.size());
}
double ClosedCurve::length() const {
  return data_->arc.back();
}
double ClosedCurve::signed_area() const {
  return data_->area;
}

double ClosedCurve::s_at(int i) const {
  CHECK(i >= 0 && i < size(), "no such point of the curve");
  return data_->arc[index(i)];
}

double ClosedCurve::wrap(double s) const {
  const double whole = length();
  if (s >= 0 && s < whole) return s;
  CHECK(std::isfinite(s), "arc length that is not finite");
  const double rest = std::fmod(s, whole);
  const double positive = rest < 0 ? rest + whole : rest;
  return positive < whole ? positive : 0.0;
}

double ClosedCurve::forward(double a, double b) const {
  return wrap(wrap(b) - wrap(a));
}

int ClosedCurve::segment_at(double s) const {
  return data_->segment_at(wrap(s));
}

Point ClosedCurve::at(double s) const {
  const double wrapped = wrap(s);
  const int i = data_->segment_at(wrapped);
  const double start = data_->arc[index(i)];
  return lerp(data_->points[index(i)], data_->end_of(i), (wrapped - start) / (data_->arc[index(i + 1)] - start));
}

Point ClosedCurve::tangent(double s) const {
  const int i = segment_at(s);
  const Point along = data_->end_of(i) - data_->points[index(i)];
  return along / oversketch::length(along);
}

Point ClosedCurve::smooth_tangent(double s, double half) const {
  const Point across = at(s + half) - at(s - half);
  const double size = oversketch::length(across);
  return size > 0 ? across / size : tangent(s);
}

CurvePosition ClosedCurve::nearest(Point p) const {
  const SegmentHit hit = data_->tree.nearest(p);
  const double start = data_->arc[index(hit.segment)], end = data_->arc[index(hit.segment + 1)];
  const double s = hit.t == 1 ? end : std::min(start + hit.t * (end - start), end);
  return {s < length() ? s : 0.0, hit.point, hit.segment, std::sqrt(hit.squared)};
}

double signed_area(const Points& closed) {
  // About the first point: far from the origin the plain sum would lose digits.
  double twice = 0;
  for (std::size_t i = 2; i < closed.size(); ++i)
    twice += cross(closed[i - 1] - closed[0], closed[i] - closed[0]);
  return 0.5 * twice;
}

double path_length(const Points& open) {
  double sum = 0;
  for (std::size_t i = 1; i < open.size(); ++i)
    sum += distance(open[i - 1], open[i]);
  return sum;
}

double perimeter(const Points& closed) {
  return closed.empty() ? 0.0 : path_length(closed) + distance(closed.back(), closed.front());
}

bool contains(const Points& closed, Point p) {
  int winding = 0;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const Point a = closed[i], b = closed[i + 1 < closed.size() ? i + 1 : 0];
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    // A point on the edge counts as to its right, whichever way the edge runs.
    if (a.y <= p.y && orientation(a, b, p) <= 0)
      ++winding;
    else if (b.y <= p.y && orientation(b, a, p) <= 0)
      --winding;
  }
  return winding != 0;
}

Points without_repeats(const Points& closed) {
  Points out;
  out.reserve(closed.size());
  for (const Point p : closed)
    if (out.empty() || !(out.back() == p)) out.push_back(p);
  while (out.size() > 1 && out.back() == out.front())
    out.pop_back();
  return out;
}

Points resample(const ClosedCurve& curve, int count) {
  CHECK(count >= 3, "a closed curve is resampled to at least 3 points");
  Points out;
  out.reserve(index(count));
  for (int i = 0; i < count; ++i)
    out.push_back(curve.at(curve.length() * i / count));
  return out;
}

} // namespace oversketch
