#pragma once

#include "core/base/result.h"
#include "core/geometry/point.h"

#include <string>

namespace oversketch {

/// A correspondence fixed by the user: this point of the outline (source pixels) goes to that point of the sketch
/// (target pixels).  Solvers take the nearest point of each curve.
struct PinPair {
  Point outline;
  Point sketch;

  bool operator==(const PinPair&) const = default;
};

/// deform.pins-cross: the pins stand in one order along the outline and in another along the sketch, so that no map of
/// the one curve onto the other can meet both.
/// @param first, second  indices into the solver's pins, from 0.  `where` names them from 1: "pins 1 and 3"; whoever
///   knows their ids puts those in its stead.
inline Error pins_cross(int first, int second) {
  const std::string names = std::to_string(first + 1) + " and " + std::to_string(second + 1);
  return {
      "deform.pins-cross",
      "pins P" + std::to_string(first + 1) + " and P" + std::to_string(second + 1) +
          " contradict each other: they follow each other in one order on the outline and in another on the sketch; "
          "move or remove one of them",
      "pins " + names};
}

} // namespace oversketch
