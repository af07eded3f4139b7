#pragma once

#include "core/base/result.h"
#include "core/geometry/curve.h"

#include <vector>

namespace oversketch {

/// A hand-drawn sketch made fit for matching and solving.
///
/// `curve` is closed, without repeated points and without crossings, runs in the direction asked for, and starts at a
/// point chosen by its shape alone: the vertex furthest in a fixed, generic direction.  So sketches that differ only in
/// direction or first point give the same curve.
struct CleanSketch {
  ClosedCurve curve;
  /// For each point of `curve`: arc length (px) along the given points, run in the direction of `curve` from the given
  /// first point, where it is come to, and where it is left.  They differ where a loop was cut.  Increasing but for one
  /// wrap.
  std::vector<double> given_s;
  std::vector<double> left_s;
  /// Length of the given curve, px, cut loops included.
  double given_length = 0;
  /// The given points ran the other way.
  bool reversed = false;
  int loops_cut = 0;
  /// Length of the loops that were cut, px.
  double cut_length = 0;

  /// Arc length along the given points, run in the direction of `curve`, of the place `s` on `curve`; in [0,
  /// given_length). O(log n).
  double to_given(double s) const;
};

/// Longest loop that is cut, as a part of what remains of the curve.  A longer one is no slip of the pen: nobody can
/// tell which side was meant.
inline constexpr double kLargestLoop = 0.25;

/// Drops exact repeats, cuts small loops where the sketch crosses itself (the shorter side of every crossing, shortest
/// first), and orients it.
///
/// @param given        target pixels, >= 3 points, first joined to last; a closing repeat is allowed.
/// @param orientation  > 0: the result has positive signed_area() (clockwise on the screen), < 0: negative.
/// @errors sketch.too-few-points, sketch.not-finite, sketch.too-far (|coordinate| >= kMaskCoordinateLimit),
///         sketch.no-area (area < 1 px² or < 0.1 % of the square on its perimeter's quarter),
///         sketch.crosses-itself (both sides of a crossing are long, as in a figure eight; the point is in the
///         sentence), sketch.tangled (more than 10 crossings a point).
/// @cost O((n + crossings) log) on ordinary curves.
/// @threads pure.
Result<CleanSketch> clean_sketch(const Points& given, double orientation);

} // namespace oversketch
