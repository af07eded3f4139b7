#pragma once

#include "core/base/result.h"
#include "core/document/document.h"

namespace oversketch {

/// The nearest point of the closed curve.
Point snap_to(const Points& curve, Point p);

/// Brings each pin's ends to the nearest points of the layer's present outline and sketch; a pin with an end further
/// away than kPinReach of that curve's length is dropped.
void carry_pins(Layer& layer);

/// How far a pin may lie from a redrawn curve and still belong to it: part of the curve's length.
inline constexpr double kPinReach = 0.05;

/// Pins must be apart and follow each other round the sketch in the order in which they follow each other round the
/// outline, in the same or, when the sketch runs the other way, in the reverse direction.
/// @errors pin.same-place, pin.order, naming the two pins.
Result<void> check_pin_order(const Layer& layer);

Error unknown_pin(const Layer& layer, PinId pin);

} // namespace oversketch
