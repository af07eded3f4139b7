#pragma once

#include "core/document/command.h"
#include "ui/state/view_state.h"

#include <optional>
#include <string>

namespace oversketch {

struct StrokeAsk {
  /// The outline is drawn on the source, the sketch on the target.
  Side side = Side::kTarget;
  /// How near to the curve an end must be, pixels of that side's picture; > 0.
  double tolerance_px = 10;
  bool other_side = false;
  bool sharp = false;
  /// The line is to be closed even if its ends are apart: a polygon that was finished.
  bool close = false;
};

/// What a stroke would do.
struct StrokePlan {
  /// region.set, region.edit, sketch.set or sketch.edit, with the layer named; none when it would do nothing.
  std::optional<Command> command;
  /// Why it would not, as a sentence.
  std::string why_not;
  /// The part that would be replaced, as an open line; the line closes itself instead: a whole curve.
  Points ghost;
  bool closes = false;
};

/// What a stroke means to a layer ("Oversketch, exactly"): a part of its curve drawn over again when both ends are near
/// it, or one is and the other within three times the tolerance; else the whole curve anew when the stroke closes
/// itself.  The first outline is always closed.
///
/// Closing: the ends are within three times the tolerance of each other, or the gap is at most a tenth of the line:
/// nothing but a closed curve can be meant.  Where the ends have run past each other they are cut where they cross, or
/// else where they come nearest.
/// @param stroke  pixels of the side's picture, already within it (clamp_to_picture()) where it is an outline.
/// @cost that of oversketch(), twice.
StrokePlan plan_stroke(const Layer& layer, const Points& stroke, const StrokeAsk& ask);

/// The part that a stroke still being drawn would replace if it ended at the curve's nearest point, whether that can be
/// done or not; empty when it does not begin near the curve.
Points forecast_ghost(const Layer& layer, const Points& stroke, const StrokeAsk& ask);

/// The ends of a line brought together: what is left when the loose ends beyond its crossing, or beyond its nearest
/// approach over the last `reach` px, are cut off.
Points close_line(const Points& line, double reach);

/// The line with what lies outside the picture led along the picture's edge, the shorter way round.  Nothing is left
/// of a line that lies outside wholly.
/// @param size    of the picture; positive.
/// @param closed  the line will be closed: where both its ends lie outside they are joined along the edge as well.
Points clamp_to_picture(const Points& line, Point size, bool closed);

} // namespace oversketch
