#include "core/geometry/oversketch.h"

#include "core/geometry/oversketch_plan.h"
#include "core/geometry/point_text.h"

#include <cstddef>
#include <string>
#include <utility>

namespace oversketch {

namespace {

/// A join nearer than this to a vertex is that vertex: shorter segments carry no shape, only rounding.  Curve px.
constexpr double kSnap_px = 1e-6;
/// The free end of a stroke is led to the curve from at most this many tolerances.
constexpr double kExtension = 3;

Result<void> check_input(const Points& stroke, const OversketchOptions& options) {
  if (!(options.tolerance_px > 0) || !std::isfinite(options.tolerance_px))
    return Error{"oversketch.tolerance", "the tolerance must be a positive number of pixels", ""};
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (!is_finite(stroke[i]))
      return Error{"oversketch.not-finite", "the stroke has a coordinate that is not a finite number",
                   "stroke point " + std::to_string(i)};
  if (!(path_length(stroke) > 0))
    return Error{"oversketch.stroke-too-short", "the stroke has no length: draw along the part that is to change",
                 "stroke"};
  return {};
}

StrokeJoin project(const ClosedCurve& curve, Point end) {
  const CurvePosition place = curve.nearest(end);
  for (const int vertex : {place.segment, (place.segment + 1) % curve.size()}) {
    const Point p = curve.points()[static_cast<std::size_t>(vertex)];
    if (distance(p, place.point) < kSnap_px) return {curve.s_at(vertex), p, vertex, place.distance};
  }
  return {place.s, place.point, place.segment, place.distance};
}

/// Both ways to replace, the one that starts at the smaller s first: nothing here depends on the stroke's direction.
std::pair<OversketchPlan, OversketchPlan> plans(const ClosedCurve& curve, const Points& stroke, const StrokeJoin& first,
                                                const StrokeJoin& last) {
  const Points back(stroke.rbegin(), stroke.rend());
  // Both ends at one place: only the whole curve can be meant, so the stroke is to run as the curve does.
  const bool in_order = first.s != last.s ? first.s < last.s : signed_area(stroke) * curve.signed_area() < 0;
  const StrokeJoin& low = in_order ? first : last;
  const StrokeJoin& high = in_order ? last : first;
  const double rest = low.s == high.s ? curve.length() : curve.forward(high.s, low.s);
  return {OversketchPlan{low, high, curve.forward(low.s, high.s), in_order ? stroke : back},
          OversketchPlan{high, low, rest, in_order ? back : stroke}};
}

/// The kept part and the path put together, and where in it the drawn part begins and ends.
struct Assembly {
  Points points;
  std::size_t drawn_begin = 0;
  std::size_t drawn_end = 0;
};

Assembly assemble(const ClosedCurve& curve, const OversketchPlan& plan, const Points& path) {
  Points ring;
  const auto push = [&](Point p) {
    if (ring.empty() || !(ring.back() == p)) ring.push_back(p);
  };
  push(plan.to.point);
  for (const Point p : vertices_between(curve, plan.to.s, plan.to.segment, curve.length() - plan.part_length))
    push(p);
  push(plan.from.point);
  const std::size_t begin = ring.size() - 1;
  for (const Point p : path)
    push(p);
  if (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  // From the old first vertex on, where it was kept.
  const auto kept_end = ring.begin() + static_cast<std::ptrdiff_t>(begin) + 1;
  const auto old_first = std::find(ring.begin(), kept_end, curve.points().front());
  const std::size_t start = old_first == kept_end ? 0 : static_cast<std::size_t>(old_first - ring.begin());
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(start), ring.end());
  const std::size_t n = ring.size();
  return {std::move(ring), (begin + n - start) % n, (n - start) % n};
}

Result<Points> check_result(const ClosedCurve& curve, const Points& points) {
  auto checked = check_closed_curve(points, "curve");
  if (!checked && checked.error().code == "curve.crosses-itself") {
    const auto crossing = find_self_crossing(points, true);
    const std::string place = point_text(crossing->point);
    return Error{"oversketch.crosses", "the curve would cross itself at " + place + ": nothing was changed", place};
  }
  if (checked && signed_area(*checked) * curve.signed_area() < 0)
    return Error{
        "oversketch.inside-out",
        "the curve would turn inside out: nothing was changed; try the other side or draw the whole curve anew", ""};
  return checked;
}

OversketchResult make_result(const ClosedCurve& curve, const OversketchPlan& plan, Assembly assembly) {
  OversketchResult result;
  const ClosedCurve drawn(assembly.points);
  result.old_length = curve.length();
  result.new_length = drawn.length();
  const double begin = drawn.s_at(static_cast<int>(assembly.drawn_begin));
  const double end = drawn.s_at(static_cast<int>(assembly.drawn_end));
  const bool all = assembly.drawn_begin == assembly.drawn_end;
  result.drawn = {begin, all ? drawn.length() : drawn.forward(begin, end)};
  result.replaced = {plan.from.s, plan.part_length};
  result.ghost = vertices_between(curve, plan.from.s, plan.from.segment, plan.part_length);
  result.ghost.insert(result.ghost.begin(), plan.from.point);
  result.ghost.push_back(plan.to.point);
  result.curve = std::move(assembly.points);
  return result;
}

/// The plan carried out, in the first of the ways to join that leaves the curve simple; the first way's error
/// otherwise.
Result<OversketchResult> carry_out(const ClosedCurve& curve, const OversketchPlan& plan,
                                   const OversketchOptions& options) {
  std::optional<Error> first_error;
  std::optional<OversketchResult> result;
  const auto attempt = [&](const OversketchPlan& way, bool smooth) {
    Assembly assembly = assemble(curve, way, make_path(curve, way, options.tolerance_px, smooth));
    const auto checked = check_result(curve, assembly.points);
    if (checked)
      result = make_result(curve, way, std::move(assembly));
    else if (!first_error)
      first_error = checked.error();
    return checked.ok();
  };
  if (attempt(plan, !options.sharp)) return *std::move(result);
  const auto cut = cut_overshoot(curve, plan, options.tolerance_px);
  if (cut && attempt(*cut, !options.sharp)) return *std::move(result);
  if (!options.sharp && ((cut && attempt(*cut, false)) || attempt(plan, false))) return *std::move(result);
  return *first_error;
}

/// The stroke up to where it comes nearest to its start again, looked for over the last `window` px: what goes round a
/// whole curve mostly runs on a little past its start.
Points without_overlap(const Points& stroke, double window) {
  std::size_t end = stroke.size();
  double nearest = HUGE_VAL, walked = 0;
  for (std::size_t i = stroke.size(); i-- > 1 && walked <= window;) {
    const double apart = distance(stroke[i], stroke[0]);
    if (apart < nearest) nearest = apart, end = i + 1;
    walked += distance(stroke[i], stroke[i - 1]);
  }
  return {stroke.begin(), stroke.begin() + static_cast<std::ptrdiff_t>(end)};
}

Result<OversketchResult> replace_whole(const ClosedCurve& curve, const Points& stroke) {
  const auto checked = check_closed_curve(stroke, "stroke");
  if (!checked && checked.error().code == "curve.crosses-itself")
    return Error{"oversketch.crosses", checked.error().sentence, checked.error().where};
  if (!checked) return checked.error();
  OversketchResult result;
  result.curve = *checked;
  if (signed_area(result.curve) * curve.signed_area() < 0) std::reverse(result.curve.begin(), result.curve.end());
  result.whole_new = true;
  result.old_length = curve.length();
  result.new_length = perimeter(result.curve);
  result.replaced = {0, result.old_length};
  result.drawn = {0, result.new_length};
  result.ghost = curve.points();
  result.ghost.push_back(curve.points().front());
  return result;
}

} // namespace

Points vertices_between(const ClosedCurve& curve, double begin, int segment, double length) {
  Points out;
  for (int k = 1; k <= curve.size(); ++k) {
    const int i = (segment + k) % curve.size();
    const double ahead = curve.forward(begin, curve.s_at(i));
    if (ahead >= length) break;
    if (ahead > 0) out.push_back(curve.points()[static_cast<std::size_t>(i)]);
  }
  return out;
}

std::optional<double> OversketchResult::moved(double old_s) const {
  const auto forward = [](double from, double to, double whole) { return to >= from ? to - from : to - from + whole; };
  const double past_begin = forward(replaced.begin, old_s, old_length);
  if (whole_new || (past_begin > 0 && past_begin < replaced.length)) return std::nullopt;
  if (past_begin == 0) return drawn.begin;
  const double drawn_end = drawn.begin + drawn.length;
  const double s = drawn_end + (past_begin - replaced.length);
  return s < new_length ? s : std::max(0.0, s - new_length);
}

Result<OversketchResult> oversketch(const ClosedCurve& curve, const Points& stroke, const OversketchOptions& options) {
  if (const auto input = check_input(stroke, options); !input) return input.error();
  const double tolerance = options.tolerance_px;
  const StrokeJoin first = project(curve, stroke.front()), last = project(curve, stroke.back());
  const bool near =
      std::min(first.gap, last.gap) <= tolerance && std::max(first.gap, last.gap) <= kExtension * tolerance;
  if (!near) {
    if (distance(stroke.front(), stroke.back()) <= tolerance) return replace_whole(curve, stroke);
    return Error{
        "oversketch.not-near",
        "start and end the stroke near the curve to redraw a part of it, or end it where it began to draw a new one",
        std::string("stroke ") + (first.gap > last.gap ? "start" : "end")};
  }
  const auto [one, two] = plans(curve, stroke, first, last);
  const bool one_better = score_plan(curve, one, options.pin_s) <= score_plan(curve, two, options.pin_s);
  const bool take_one = one_better == (options.side == OversketchSide::kAuto);
  const auto carry_out_or_whole = [&](const OversketchPlan& plan) {
    auto result = carry_out(curve, plan, options);
    const bool most = plan.part_length > 0.5 * curve.length();
    if (result || !most || distance(stroke.front(), stroke.back()) > kExtension * tolerance) return result;
    auto whole = replace_whole(curve, without_overlap(stroke, 2 * kExtension * tolerance));
    return whole ? whole : result;
  };
  auto result = carry_out_or_whole(take_one ? one : two);
  if (result) result->other_side_possible = carry_out_or_whole(take_one ? two : one).ok();
  return result;
}

} // namespace oversketch
