#pragma once

#include "core/geometry/curve.h"

#include <optional>
#include <vector>

namespace oversketch {

/// Where each of `points` lies on `curve`, if one similarity lays all of them on it.
///
/// Gauss-Newton on Σ (n_i · (S(z_i) − γ(s_i)))² over the similarities S, from the places `s`, at most ten rounds;
/// γ(s_i) is the nearest point.  A match by samples is exact to half a sample; this makes it exact where the sketch is
/// the region's own outline, moved, turned and scaled.
///
/// @param points     handles, in order.
/// @param tolerance  largest distance that counts as lying on the curve, the curve's unit.
/// @returns arc lengths, increasing and not wrapped, near `s`; nothing when the points do not fit or would change
/// order.
/// @cost O(points · log n) a round; one round where the shapes differ.
std::optional<std::vector<double>> align_similar(const Points& points, const ClosedCurve& curve,
                                                 const std::vector<double>& s, double tolerance);

} // namespace oversketch
