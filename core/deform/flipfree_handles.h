#pragma once

#include "core/deform/linear_start.h"
#include "core/geometry/curve.h"

#include <vector>

namespace oversketch {

/// A sample of the outline.
struct Handle {
  /// Arc length on the outline, px.
  double outline_s = 0;
  MeshTie tie;
  /// Length of outline that it stands for, cells.
  double span = 0;
  bool pinned = false;
};

/// Places of ordered handles on a closed curve: s[i] strictly increasing over one round, not wrapped.
struct HandlePlaces {
  std::vector<double> s;
  /// Point of the curve and its unit tangent averaged over ± kTangentReach cells, at each handle.
  Points points;
  Points tangents;
};

/// Half the length over which a tangent is averaged, cells.
inline constexpr double kTangentReach = 0.35;

/// Fills points and tangents at `s`.  `cell` is a cell's side in the curve's unit.
void place_handles(const ClosedCurve& curve, double cell, HandlePlaces& places);

/// Brings s into order with the least change in the sum of squares: the isotonic regression round the circle (pool
/// adjacent violators), then a least gap of 2 % of the mean one, less where pinned handles stand closer.  Pinned
/// handles stay.
/// @param s       pinned entries must increase, the last less than the first plus `length`.
/// @param pinned  as long as s.
/// @cost O(n).
void order_handles(std::vector<double>& s, const std::vector<Handle>& handles, double length);

} // namespace oversketch
