#pragma once

#include "core/geometry/curve.h"

#include <optional>
#include <vector>

namespace oversketch {

/// Places on a curve that a similarity lays some points on.
struct Alignment {
  /// Arc lengths, increasing and not wrapped.
  std::vector<double> s;
  /// Of the points from the curve, the largest, and how the similarity turns them, −π…π.
  double distance = 0;
  double turn = 0;
};

/// Where each of `points` lies on `curve`, if one similarity lays all of them on it.
///
/// Gauss-Newton on Σ (n_i · (S(z_i) − γ(s_i)))² over the similarities S, from the places `s`, at most ten rounds;
/// γ(s_i) is the nearest point.  A match by samples is exact to half a sample; this makes it exact where the sketch is
/// the region's own outline, moved, turned and scaled.
///
/// @param points     handles, in order.
/// @param tolerance  largest distance that counts as lying on the curve, the curve's unit.
/// @returns places near `s`; nothing when the points do not fit or would change order.
/// @cost O(points · log n) a round; one round where the shapes differ.
std::optional<Alignment> align_similar(const Points& points, const ClosedCurve& curve, const std::vector<double>& s,
                                       double tolerance);

/// The same without places to begin from: of the similarities that lay the points on the curve the one that turns them
/// least.  A match is drawn to little turning, and where a shape is nearly symmetric that outweighs the last few
/// percent of shape: this finds the turn that fits exactly.
///
/// Correlates the points with the curve at every shift of 512, and aligns at the best of them.
///
/// @param outline  what the points are of.
/// @param s        arc lengths of the points on it, increasing.
/// @cost 2 µs where length and area tell that the shapes differ, else about 0.5 ms, and align_similar() for up to 16
/// shifts.
std::optional<Alignment> find_similar(const Points& points, const ClosedCurve& outline, const std::vector<double>& s,
                                      const ClosedCurve& curve, double tolerance);

} // namespace oversketch
