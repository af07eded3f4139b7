#include "core/document/redraw.h"

#include "core/document/pins.h"
#include "core/geometry/segment_tree.h"

#include <algorithm>
#include <optional>

namespace oversketch {
namespace {

/// The part of a closed curve as an open line, its ends included.
Points part_of(const ClosedCurve& curve, const ArcInterval& part) {
  Points line{curve.at(part.begin)};
  std::vector<std::pair<double, Point>> inside;
  for (int i = 0; i < curve.size(); ++i) {
    const double ahead = curve.forward(part.begin, curve.s_at(i));
    if (ahead > 0 && ahead < part.length) inside.emplace_back(ahead, curve.points()[static_cast<std::size_t>(i)]);
  }
  std::sort(inside.begin(), inside.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [ahead, point] : inside)
    line.push_back(point);
  line.push_back(curve.at(part.begin + part.length));
  return line;
}

Point nearest_on(const Points& line, Point p) {
  Point best = line.front();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point candidate = nearest_on_segment(line[i], line[i + 1], p).point;
    if (distance(p, candidate) < distance(p, best)) best = candidate;
  }
  return best;
}

/// Where a pin's end stands after the redraw; nothing when it is lost.
std::optional<Point> carried(Point end, double old_s, const OversketchResult& redrawn, const Points& drawn) {
  if (redrawn.moved(old_s)) return end;
  const Point near = nearest_on(drawn, end);
  if (distance(near, end) > kPinReach * redrawn.new_length) return std::nullopt;
  return near;
}

} // namespace

Result<void> redraw(Layer& layer, Points Layer::*curve, Point Pin::*end, const Points& stroke,
                    OversketchOptions options) {
  const ClosedCurve before(layer.*curve);
  std::vector<double> pin_s;
  for (const Pin& pin : layer.pins)
    pin_s.push_back(before.nearest(pin.*end).s);
  options.pin_s = pin_s;
  auto redrawn = oversketch(before, stroke, options);
  if (!redrawn) return redrawn.error();

  const ClosedCurve after(redrawn->curve);
  const Points drawn = redrawn->whole_new ? Points() : part_of(after, redrawn->drawn);
  std::vector<Pin> kept;
  std::vector<Pin> moved;
  for (std::size_t i = 0; i < layer.pins.size(); ++i) {
    Pin pin = layer.pins[i];
    std::optional<Point> place;
    if (redrawn->whole_new) {
      const CurvePosition near = after.nearest(pin.*end);
      if (near.distance <= kPinReach * after.length()) place = near.point;
    } else {
      place = carried(pin.*end, pin_s[i], *redrawn, drawn);
    }
    if (!place) continue;
    const bool stays = *place == pin.*end;
    pin.*end = *place;
    (stays ? kept : moved).push_back(pin);
  }
  layer.*curve = std::move(redrawn->curve);
  layer.pins = std::move(kept);
  for (const Pin& pin : moved) {
    layer.pins.push_back(pin);
    if (!check_pin_order(layer)) layer.pins.pop_back();
  }
  std::sort(layer.pins.begin(), layer.pins.end(), [](const Pin& a, const Pin& b) { return a.id < b.id; });
  return {};
}

} // namespace oversketch
