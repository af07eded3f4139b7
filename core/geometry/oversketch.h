#pragma once

#include "core/base/result.h"
#include "core/geometry/curve.h"

#include <optional>
#include <span>

namespace oversketch {

/// Which of the two parts between the stroke's ends is replaced: the better scored one, or the other.
enum class OversketchSide { kAuto, kOther };

struct OversketchOptions {
  /// How near to the curve a stroke's end must be, curve px; also the scale of the joins.  Finite, > 0.
  double tolerance_px = 10;
  OversketchSide side = OversketchSide::kAuto;
  /// Straight joins with corners instead of smooth ones.
  bool sharp = false;
  /// Arc lengths of the curve's pins: the part that loses fewer of them scores better.
  std::span<const double> pin_s = {};
};

/// Part of a closed curve: forwards from `begin` over `length` px of arc length.
struct ArcInterval {
  double begin = 0;
  double length = 0;
};

/// A curve with a part of it drawn over again.
struct OversketchResult {
  /// Closed and simple, same orientation as before.  Points of the kept part are the old ones, bit by bit; the first
  /// point is the old first one where that was kept, else the kept part's first.
  Points curve;
  /// True when the stroke closed itself away from the curve and took its place whole: nothing was kept.
  bool whole_new = false;
  double old_length = 0;
  double new_length = 0;
  /// What was replaced, in the old curve's arc length, and what took its place, in the new one's.  The joins belong to
  /// it.
  ArcInterval replaced;
  ArcInterval drawn;
  /// The replaced part as an open line, both ends included (the closed old curve when whole_new).
  Points ghost;
  /// Whether the same stroke with the side changed would be taken too.
  bool other_side_possible = false;

  /// The new arc length, in [0, new_length), of a place on the kept part; none on the replaced part's inside.
  /// @param old_s  in [0, old_length).
  std::optional<double> moved(double old_s) const;
};

/// Replaces a part of a closed curve by an open stroke.
///
/// Both ends of the stroke are projected to the curve.  Both within the tolerance, or one and the other within three
/// times it: the curve's part between the two projections is replaced.  Otherwise the stroke is a new curve if its ends
/// are within the tolerance of each other.
///
/// Which part: for both, cost = 2 d / l + ½ |ln(part / l)| (that at most 1½) + ¼ (1 − mean cosine of tangents) + ¼ pins
/// lost / pins, with d the mean distance between part and stroke, both ways, and l the stroke's length.  The stroke's
/// direction does not enter: it is turned to run with the part.
///
/// Joins: smooth ones mix the replaced part with the stroke, both at the same arc length u from the join, by
/// w = 3t² − 2t³, t = u / (gap + 2 tolerance), at most half the stroke: the curve's tangent is kept where the join
/// begins and the stroke is followed point by point from t = 1 on.  Sharp ones lead straight from the curve to the
/// stroke's end.  Where the curve would cross itself, the stroke's overshoot is cut off at the kept part, and failing
/// that a smooth join is made sharp.
///
/// @param curve   simple; the result's checks say so otherwise.
/// @param stroke  at least two different points; curve px.
/// @errors oversketch.stroke-too-short (fewer than two different points), oversketch.not-finite, oversketch.tolerance,
///   oversketch.not-near (with a hint), oversketch.crosses (where: the place), oversketch.inside-out (what was inside
///   along the kept part would be outside), and those of check_closed_curve().  Nothing is changed then.
/// @cost O((n + m) log(n + m)); about 1 ms for 1000 points each.
/// @threads pure.
Result<OversketchResult> oversketch(const ClosedCurve& curve, const Points& stroke, const OversketchOptions& options);

} // namespace oversketch
