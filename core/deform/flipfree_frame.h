#pragma once

#include "core/geometry/curve.h"

namespace oversketch {

/// The frame in which a sketch is matched and solved for: its centroid in the origin, a control cell as the unit, as
/// large as the region.
///
/// Points are rounded to kFrameGrid there, so that a sketch that was moved or scaled gives the same numbers to the last
/// bit, and not merely nearly the same ones, which many steps of a solver may drive apart.  Vertices on straight
/// lines are dropped for the same reason: a sketch that begins in the middle of a side is the same sketch.
struct SketchFrame {
  ClosedCurve curve;
  /// Side of a control cell, target px.
  double cell_px = 1;
  Point centre;
  /// Target px of arc length for one unit of it on `curve`.
  double px_per_s = 1;

  Point to_target(Point p) const { return cell_px * p + centre; }
  Point from_target(Point p) const { return (p - centre) / cell_px; }
};

/// Cells; far below what is seen (a millionth of a cell), far above rounding.
inline constexpr double kFrameGrid = 1.0 / (1 << 20);

/// The multiple of kFrameGrid nearest to v.
double snap_to_frame(double v);

/// @param cell  side of a control cell, source px.
SketchFrame make_sketch_frame(const ClosedCurve& outline, double cell, const ClosedCurve& sketch);

} // namespace oversketch
