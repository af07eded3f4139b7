#pragma once

#include "core/geometry/point.h"
#include "ui/state/view_state.h"

#include <optional>

namespace oversketch {

/// Where the canvases are, window pixels; boxes may be a pixel small, never less.
struct CanvasLayout {
  std::optional<Box> source;
  Box target;
  /// Between the two.
  std::optional<Box> splitter;

  const Box* box(Side side) const;
  /// The canvas that holds a point of the window.
  std::optional<Side> side_at(Point window) const;
  /// What the splitter stands for when it is dragged there.
  double split_at(double window_x) const;
};

/// @param split   share of the width for the source.
/// @param two     whether there are two canvases at all.
/// @param splitter_px  its width.
CanvasLayout lay_out_canvases(const Box& area, double split, bool two, double splitter_px);

bool contains(const Box& box, Point p);

/// The least share of the width that either canvas may have.
inline constexpr double kLeastSplit = 0.1;

} // namespace oversketch
