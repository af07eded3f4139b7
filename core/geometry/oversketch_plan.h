#pragma once

// Inner parts of oversketch.h; nothing else includes this.

#include "core/geometry/oversketch.h"

namespace oversketch {

/// Where an end of the stroke meets the curve.
struct StrokeJoin {
  double s = 0;
  Point point;
  int segment = 0;
  /// From the stroke's end to the curve, px.
  double gap = 0;
};

/// One of the two ways to replace: the part that runs forwards from `from` to `to`, and the stroke turned the same way.
struct OversketchPlan {
  StrokeJoin from;
  StrokeJoin to;
  /// Arc length of the part replaced, px.
  double part_length = 0;
  Points stroke;
};

/// The vertices of the curve strictly between two arc lengths, going forwards from a place on `segment`.
Points vertices_between(const ClosedCurve& curve, double begin, int segment, double length);

/// The cost of the plan as oversketch() tells it; smaller is better.
double score_plan(const ClosedCurve& curve, const OversketchPlan& plan, std::span<const double> pin_s);

/// The line that takes the part's place, both joins' points included.
Points make_path(const ClosedCurve& curve, const OversketchPlan& plan, double tolerance, bool smooth);

/// The plan with the stroke cut where it last meets the kept part near its ends; none when it does not.
std::optional<OversketchPlan> cut_overshoot(const ClosedCurve& curve, const OversketchPlan& plan, double tolerance);

} // namespace oversketch
