#pragma once

#include "core/geometry/curve.h"
#include "core/geometry/point.h"
#include "core/mesh/quad_mesh.h"

#include <span>
#include <vector>

namespace oversketch {

/// How far a deformed mesh is from a similarity.
///
/// The ratio and the spread are taken from the Jacobian J at each counted cell's centre, which is its mean over the
/// cell and over the four corners: with e1 = ((p1 − p0) + (p2 − p3)) / 2h, e2 = ((p3 − p0) + (p2 − p1)) / 2h and, as
/// complex numbers, a = (e1 − i e2)/2, b = (e1 + i e2)/2: σ1 = |a| + |b|, σ2 = ||a| − |b||, det J = |a|² − |b|². Cells
/// covered by at most kLeastCoverageCounted do not count; flipped cells are looked for in all.
struct DistortionMetrics {
  /// Cells with det J ≤ 0 at any corner, where J maps the two source edges at the corner to the deformed ones.
  int flipped_cells = 0;
  /// σ1/σ2 ≥ 1 over the cells that count; infinite where a cell's σ2 is 0; 1 when no cell counts.
  double sigma_ratio_mean = 1;
  double sigma_ratio_p95 = 1;
  double sigma_ratio_max = 1;
  /// 95th by 5th percentile of det J over the cells that count, ≥ 1; infinite when the latter is not positive; 1 when
  /// no cell counts.
  double area_spread = 1;
  int cells_counted = 0;
};

inline constexpr double kLeastCoverageCounted = 0.3;

/// @param source    a mesh in its source shape, for its cells, their size and their coverage.
/// @param deformed  a position for each vertex.
/// Percentiles are linear between neighbouring ranks: the p-th of n sorted values lies at rank p/100 · (n − 1).
/// @cost linear: about 20 ns a cell.
DistortionMetrics measure_distortion(const QuadMesh& source, const Points& deformed);

/// The same of one cell.
struct CellDistortion {
  double sigma_ratio = 1;
  double det = 1;
  bool flipped = false;
};

/// One for each cell, those that do not count included.
std::vector<CellDistortion> measure_cells(const QuadMesh& source, const Points& deformed);

/// Distance between two closed curves, px.
struct SketchDistance {
  /// Mean over both curves' lengths of the distance to the other curve, each curve with weight one half.
  double mean = 0;
  /// Largest distance of a sample of either curve to the other one (Hausdorff distance).
  double max = 0;
};

/// Samples each curve at least kLeastDistanceSamples times, equally spaced by arc length, for the mean; its points
/// count for the maximum too.
/// @cost samples · ClosedCurve::nearest: about 1 ms.
SketchDistance measure_sketch_distance(const ClosedCurve& deformed_outline, const ClosedCurve& sketch);

inline constexpr int kLeastDistanceSamples = 1000;

/// Mean distance between where the outline's points went and where they belong, as a part of the sketch's length.
/// @param positions, truth  of one size, not empty.
/// @param sketch_length     px, > 0.
double truth_error(const Points& positions, const Points& truth, double sketch_length);

/// How often a correspondence that must increase strictly, modulo 1, once round, does not.
///
/// With each step taken forwards, modulo 1, the last one back to the first value: the number of whole turns beyond one,
/// plus the number of steps that stand still.  A step backwards costs one more turn, so each counts once.
///
/// @param fractions  finite; fractions of the sketch's length, any whole turns added.
int count_order_violations(std::span<const double> fractions);

} // namespace oversketch
