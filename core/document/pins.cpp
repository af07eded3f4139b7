#include "core/document/pins.h"

#include "core/geometry/curve.h"

#include <algorithm>

namespace oversketch {
namespace {

struct PinParameters {
  PinId id;
  double outline;
  double sketch;
};

Error pins_contradict(PinId a, PinId b) {
  return {"pin.order",
          "pins " + to_string(a) + " and " + to_string(b) +
              " contradict each other: their order round the sketch is not their order round the outline",
          ""};
}

Error pins_meet(PinId a, PinId b, const char* curve) {
  return {"pin.same-place",
          "pins " + to_string(a) + " and " + to_string(b) + " stand on the same point of the " + curve, ""};
}

/// Brings one end of a pin to the curve; false when it is too far away.
bool carry(const ClosedCurve& curve, Point& end) {
  const CurvePosition near = curve.nearest(end);
  if (near.distance > kPinReach * curve.length()) return false;
  end = near.point;
  return true;
}

} // namespace

Point snap_to(const Points& curve, Point p) {
  return ClosedCurve(curve).nearest(p).point;
}

void carry_pins(Layer& layer) {
  if (layer.pins.empty()) return;
  const ClosedCurve outline(layer.outline), sketch(layer.sketch);
  std::erase_if(layer.pins, [&](Pin& pin) { return !carry(outline, pin.outline) || !carry(sketch, pin.sketch); });
}

Result<void> check_pin_order(const Layer& layer) {
  if (layer.pins.size() < 2) return {};
  const ClosedCurve outline(layer.outline), sketch(layer.sketch);
  const bool reversed = (outline.signed_area() > 0) != (sketch.signed_area() > 0);
  std::vector<PinParameters> pins;
  for (const Pin& pin : layer.pins) {
    const double s = sketch.nearest(pin.sketch).s;
    pins.push_back({pin.id, outline.nearest(pin.outline).s, reversed ? sketch.wrap(-s) : s});
  }
  std::sort(pins.begin(), pins.end(), [](const auto& a, const auto& b) { return a.outline < b.outline; });
  int descents = 0;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const PinParameters &a = pins[i], &b = pins[(i + 1) % pins.size()];
    if (a.outline == b.outline) return pins_meet(a.id, b.id, "outline");
    if (a.sketch == b.sketch) return pins_meet(a.id, b.id, "sketch");
    // Round a closed curve a cyclic order goes down exactly once.
    if (b.sketch < a.sketch && ++descents == 2) return pins_contradict(a.id, b.id);
  }
  return {};
}

Error unknown_pin(const Layer& layer, PinId pin) {
  std::string known;
  for (const Pin& p : layer.pins)
    known += (known.empty() ? "" : ", ") + to_string(p.id);
  return {"pin.unknown",
          "layer " + to_string(layer.id) + " has no pin " + to_string(pin) +
              (known.empty() ? ": it has none" : ": it has " + known),
          ""};
}

} // namespace oversketch
