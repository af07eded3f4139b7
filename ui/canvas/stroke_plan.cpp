#include "ui/canvas/stroke_plan.h"

#include "core/geometry/curve.h"
#include "core/geometry/oversketch.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

constexpr double kClosingReach = 3, kClosingShare = 0.1;

Result<OversketchResult> redraw_part(const Layer& layer, const Points& stroke, const StrokeAsk& ask, double tolerance) {
  const ClosedCurve curve(curve_on(layer, ask.side));
  const Similarity placed = layer.placement.to_target();
  std::vector<double> pin_s;
  for (const Pin& pin : layer.pins)
    pin_s.push_back(curve.nearest(ask.side == Side::kSource ? pin.outline : placed(pin.sketch)).s);
  OversketchOptions options;
  options.tolerance_px = tolerance;
  options.side = ask.other_side ? OversketchSide::kOther : OversketchSide::kAuto;
  options.sharp = ask.sharp;
  options.pin_s = pin_s;
  return oversketch(curve, stroke, options);
}

/// The part of the curve as an open line.
Points line_along(const ClosedCurve& curve, const ArcInterval& part) {
  Points line{curve.at(part.begin)};
  const int first = curve.segment_at(part.begin);
  for (int k = 1; k <= curve.size(); ++k) {
    const int i = (first + k) % curve.size();
    if (curve.forward(part.begin, curve.s_at(i)) >= part.length) break;
    line.push_back(curve.points()[static_cast<std::size_t>(i)]);
  }
  line.push_back(curve.at(part.begin + part.length));
  return line;
}

template <class Edit>
Edit edit_command(const Layer& layer, const Points& stroke, const StrokeAsk& ask) {
  return {layer.id, stroke, ask.other_side ? StrokeSide::kOther : StrokeSide::kAuto, ask.tolerance_px, ask.sharp};
}

bool closes_itself(const Points& stroke, const StrokeAsk& ask) {
  const double gap = distance(stroke.front(), stroke.back());
  return ask.close || gap <= kClosingReach * ask.tolerance_px || gap <= kClosingShare * path_length(stroke);
}

/// The whole curve drawn anew.
StrokePlan plan_closed(const Layer& layer, const Points& stroke, const StrokeAsk& ask) {
  StrokePlan plan;
  const bool outline = ask.side == Side::kSource;
  const auto closed =
      check_closed_curve(close_line(stroke, kClosingReach * ask.tolerance_px), outline ? "outline" : "sketch");
  if (!closed) {
    plan.why_not = closed.error().sentence;
    return plan;
  }
  plan.closes = true;
  if (outline)
    plan.command = RegionSet{layer.id, *closed};
  else
    plan.command = SketchSet{layer.id, *closed};
  return plan;
}

/// Place on the picture's edge, walked clockwise from its top left corner.
double edge_place(Point p, Point size) {
  const double to_left = p.x, to_right = size.x - p.x, to_top = p.y, to_bottom = size.y - p.y;
  const double nearest = std::min({to_left, to_right, to_top, to_bottom});
  if (nearest == to_top) return p.x;
  if (nearest == to_right) return size.x + p.y;
  if (nearest == to_bottom) return size.x + size.y + (size.x - p.x);
  return 2 * size.x + size.y + (size.y - p.y);
}

/// The picture's corners between two places on its edge, the shorter way.
Points corners_between(double from, double to, Point size) {
  const double round = 2 * (size.x + size.y);
  const double ahead = std::fmod(to - from + round, round);
  const bool forwards = ahead <= round / 2;
  const double at[] = {0, size.x, size.x + size.y, 2 * size.x + size.y};
  const Point corner[] = {{0, 0}, {size.x, 0}, size, {0, size.y}};
  std::vector<std::pair<double, Point>> passed;
  for (int i = 0; i < 4; ++i) {
    const double way = std::fmod((forwards ? at[i] - from : from - at[i]) + round, round);
    if (way > 0 && way < (forwards ? ahead : round - ahead)) passed.emplace_back(way, corner[i]);
  }
  std::sort(passed.begin(), passed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Points out;
  for (const auto& [way, point] : passed)
    out.push_back(point);
  return out;
}

/// The part of a segment within the box from the origin to `size`, as parameters; nothing when it misses it.
std::optional<std::pair<double, double>> part_inside(Point a, Point b, Point size) {
  double low = 0, high = 1;
  const auto cut = [&](double from, double step, double limit) {
    if (step == 0) return from >= 0 && from <= limit;
    const double one = -from / step, two = (limit - from) / step;
    low = std::max(low, std::min(one, two));
    high = std::min(high, std::max(one, two));
    return low <= high;
  };
  if (!cut(a.x, b.x - a.x, size.x) || !cut(a.y, b.y - a.y, size.y)) return std::nullopt;
  return std::pair(low, high);
}

} // namespace

StrokePlan plan_stroke(const Layer& layer, const Points& stroke, const StrokeAsk& ask) {
  StrokePlan plan;
  if (stroke.size() < 2) {
    plan.why_not = "A single point changes nothing: draw a line";
    return plan;
  }
  if (ask.side == Side::kTarget && layer.outline.empty()) {
    plan.why_not = "Outline the part in the source picture first";
    return plan;
  }
  if (curve_on(layer, ask.side).empty()) {
    StrokeAsk first = ask;
    first.close = true;
    return plan_closed(layer, stroke, first);
  }
  const auto redrawn = redraw_part(layer, stroke, ask, ask.tolerance_px);
  if (redrawn && redrawn->whole_new) {
    if (StrokePlan closed = plan_closed(layer, stroke, ask); closed.command) return closed;
  }
  if (redrawn) {
    plan.ghost = redrawn->ghost;
    plan.closes = redrawn->whole_new;
    if (ask.side == Side::kSource)
      plan.command = edit_command<RegionEdit>(layer, stroke, ask);
    else
      plan.command = edit_command<SketchEdit>(layer, stroke, ask);
    return plan;
  }
  if (redrawn.error().code == "oversketch.not-near" && closes_itself(stroke, ask))
    return plan_closed(layer, stroke, ask);
  plan.why_not = redrawn.error().sentence;
  return plan;
}

Points forecast_ghost(const Layer& layer, const Points& stroke, const StrokeAsk& ask) {
  const Points points = curve_on(layer, ask.side);
  if (points.empty() || stroke.size() < 2) return {};
  const ClosedCurve curve(points);
  const CurvePosition first = curve.nearest(stroke.front()), last = curve.nearest(stroke.back());
  if (first.distance > ask.tolerance_px) return {};
  StrokeAsk likelier = ask;
  likelier.other_side = false;
  const auto redrawn = redraw_part(layer, stroke, likelier, std::max(ask.tolerance_px, 1.01 * last.distance));
  ArcInterval part{first.s, curve.forward(first.s, last.s)};
  const auto rest_of = [&](const ArcInterval& arc) {
    return ArcInterval{curve.wrap(arc.begin + arc.length), curve.length() - arc.length};
  };
  if (redrawn && !redrawn->whole_new) {
    part = redrawn->replaced;
  } else {
    // What comes of it is no curve; then the part that lies nearer to the stroke's middle is meant.
    const Point middle = stroke[stroke.size() / 2];
    const ArcInterval rest = rest_of(part);
    if (distance(curve.at(rest.begin + rest.length / 2), middle) <
        distance(curve.at(part.begin + part.length / 2), middle))
      part = rest;
  }
  return line_along(curve, ask.other_side ? rest_of(part) : part);
}

Points close_line(const Points& line, double reach) {
  if (line.size() < 4) return line;
  const double whole = path_length(line);
  if (const auto crossing = find_self_crossing(line, false)) {
    const auto first = line.begin() + crossing->first + 1, last = line.begin() + crossing->second + 1;
    Points loop{crossing->point};
    loop.insert(loop.end(), first, last);
    // What hangs out must be loose ends and not the greater part of a drawing that crosses itself.
    if (path_length(loop) > 0.8 * whole) return loop;
    return line;
  }
  std::size_t end = line.size();
  double nearest = distance(line.front(), line.back()), walked = 0;
  for (std::size_t i = line.size() - 1; i > line.size() / 2 && walked <= reach; --i) {
    if (distance(line[i], line.front()) < nearest) nearest = distance(line[i], line.front()), end = i + 1;
    walked += distance(line[i], line[i - 1]);
  }
  return {line.begin(), line.begin() + static_cast<std::ptrdiff_t>(end)};
}

Points clamp_to_picture(const Points& line, Point size, bool closed) {
  const auto inside = [&](Point p) { return p.x >= 0 && p.y >= 0 && p.x <= size.x && p.y <= size.y; };
  Points out;
  Point left_at;
  bool outside = false;
  const auto push = [&](Point p) {
    const Point held{std::clamp(p.x, 0.0, size.x), std::clamp(p.y, 0.0, size.y)};
    if (out.empty() || !(out.back() == held)) out.push_back(held);
  };
  const auto enter = [&](Point p) {
    if (outside)
      for (const Point corner : corners_between(edge_place(left_at, size), edge_place(p, size), size))
        push(corner);
    outside = false;
    push(p);
  };
  if (line.size() == 1 && inside(line[0])) push(line[0]);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto part = part_inside(line[i], line[i + 1], size);
    if (!part) continue;
    enter(lerp(line[i], line[i + 1], part->first));
    push(lerp(line[i], line[i + 1], part->second));
    if (part->second < 1) left_at = out.back(), outside = true;
  }
  if (closed && out.size() > 1 && !inside(line.front()) && !inside(line.back()))
    for (const Point corner : corners_between(edge_place(out.back(), size), edge_place(out.front(), size), size))
      push(corner);
  return out;
}

} // namespace oversketch
