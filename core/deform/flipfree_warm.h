#pragma once

#include "core/geometry/curve.h"

#include <optional>
#include <vector>

namespace oversketch {

/// How the places of an old curve carry over to a new one of which a part was redrawn: the longest run of points that
/// both have in common, and of the segments before and after it as far as both go the same way, keeps its places; the
/// rest is mapped by arc length.
struct CurveRemap {
  double old_from = 0;
  double new_from = 0;
  /// Length of what is the same, px.
  double common = 0;
  double old_length = 0;
  double new_length = 0;

  /// Arc length on the new curve, not wrapped; increases with s over rounds.
  double operator()(double s) const;
  /// Whether s of the old curve lies on the part that was redrawn.
  bool redrawn(double s) const;
};

/// Least part of the new length that must be the same.
inline constexpr double kLeastCommon = 0.3;

/// @returns nothing when less than kLeastCommon of either length is the same points.
/// @cost O(n).
std::optional<CurveRemap> find_remap(const ClosedCurve& before, const ClosedCurve& after);

} // namespace oversketch
