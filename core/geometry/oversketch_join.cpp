#include "core/geometry/oversketch_plan.h"

#include "core/geometry/path.h"
#include "core/geometry/predicates.h"

#include <cstddef>

namespace oversketch {

namespace {

double join_length(double gap, double tolerance) {
  return gap + 2 * tolerance;
}

/// Goes over from the curve to the stroke.
struct Mixer {
  const ClosedCurve& curve;
  const Path& path;
  /// The curve is followed for no more than half its part.
  double part_length;

  /// From the curve's s and the path's start (direction +1) or from the path's end backwards (−1), t = 0…1 of the
  /// window.
  Point mix(double s, double direction, double window, double t) const {
    const double w = t * t * (3 - 2 * t), u = window * t;
    const double rate = std::min(1.0, 0.5 * part_length / window);
    const Point on_path = path.at(direction > 0 ? u : path.length() - u);
    return lerp(curve.at(s + direction * rate * u), on_path, w);
  }
};

/// About one sample a pixel, but enough for a small join and few for a long one.
int sample_count(double window) {
  return std::clamp(static_cast<int>(window), 8, 64);
}

struct Cut {
  StrokeJoin join;
  /// The stroke from the cut on, its first point on the curve.
  Points rest;
};

/// The last place within `window` px of the stroke's start where it meets the curve on the kept part.
std::optional<Cut> cut_start(const ClosedCurve& curve, const Points& stroke, double window, double kept_begin,
                             double kept_length) {
  std::optional<Cut> last;
  double walked = 0;
  for (std::size_t k = 0; k + 1 < stroke.size() && walked < window; ++k) {
    const Point a = stroke[k], b = stroke[k + 1], along = b - a;
    walked += length(along);
    double furthest = -1;
    for (int i = 0; i < curve.size(); ++i) {
      const Point c = curve.points()[static_cast<std::size_t>(i)];
      const Point d = curve.points()[static_cast<std::size_t>(i + 1 == curve.size() ? 0 : i + 1)];
      const double turn = cross(along, d - c);
      if (turn == 0 || c == d || a == b || !segments_touch(a, b, c, d)) continue;
      const double t = std::clamp(cross(c - a, d - c) / turn, 0.0, 1.0);
      const CurvePosition place = curve.nearest(lerp(a, b, t));
      if (t <= furthest || curve.forward(kept_begin, place.s) > kept_length) continue;
      furthest = t;
      last = Cut{{place.s, place.point, place.segment, 0}, {place.point}};
      last->rest.insert(last->rest.end(), stroke.begin() + static_cast<std::ptrdiff_t>(k) + 1, stroke.end());
    }
  }
  return last;
}

Points reversed(const Points& points) {
  return {points.rbegin(), points.rend()};
}

} // namespace

Points make_path(const ClosedCurve& curve, const OversketchPlan& plan, double tolerance, bool smooth) {
  Points out{plan.from.point};
  if (!smooth) {
    out.insert(out.end(), plan.stroke.begin(), plan.stroke.end());
    out.push_back(plan.to.point);
    return out;
  }
  const Path path(plan.stroke);
  const double half = 0.5 * path.length();
  const double first = std::min(join_length(plan.from.gap, tolerance), half);
  const double second = std::min(join_length(plan.to.gap, tolerance), half);
  const Mixer mixer{curve, path, plan.part_length};
  const int first_count = sample_count(first), second_count = sample_count(second);
  for (int i = 1; i <= first_count; ++i)
    out.push_back(mixer.mix(plan.from.s, 1, first, static_cast<double>(i) / first_count));
  for (std::size_t i = 0; i < path.points().size(); ++i)
    if (path.s_at(i) > first && path.s_at(i) < path.length() - second) out.push_back(path.points()[i]);
  for (int i = second_count; i >= 1; --i)
    out.push_back(mixer.mix(plan.to.s, -1, second, static_cast<double>(i) / second_count));
  out.push_back(plan.to.point);
  return out;
}

std::optional<OversketchPlan> cut_overshoot(const ClosedCurve& curve, const OversketchPlan& plan, double tolerance) {
  const double kept_length = curve.length() - plan.part_length;
  const auto start = cut_start(curve, plan.stroke, join_length(plan.from.gap, tolerance), plan.to.s, kept_length);
  OversketchPlan cut = plan;
  if (start) cut.from = start->join, cut.stroke = start->rest;
  const auto end = cut_start(curve, reversed(cut.stroke), join_length(plan.to.gap, tolerance), plan.to.s, kept_length);
  if (end) cut.to = end->join, cut.stroke = reversed(end->rest);
  if (!start && !end) return std::nullopt;
  // Both cuts eat into the kept part from its two sides; beyond each other nothing of it would be left.
  const double from_left = start ? curve.forward(plan.to.s, cut.from.s) : kept_length;
  const double to_left = end ? curve.forward(plan.to.s, cut.to.s) : 0.0;
  if (from_left <= to_left || path_length(cut.stroke) == 0) return std::nullopt;
  cut.part_length = curve.length() - (from_left - to_left);
  return cut;
}

} // namespace oversketch
