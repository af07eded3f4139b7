#pragma once

#include "ui/state/view_state.h"
#include "ui/widgets/widget_map.h"

#include <limits>
#include <optional>
#include <string>

namespace oversketch {

/// The pointer's shape over a canvas; elsewhere Dear ImGui chooses it.
enum class CursorShape {
  kArrow,
  kNone,
  kText,
  kCross,
  kHand,
  kGrab,
  kMove,
  kResizeEw,
  kResizeNs,
  kResizeNwse,
  kResizeNesw
};

/// Where the two canvases are, window pixels; none where a side is not shown.
struct CanvasRects {
  std::optional<WidgetMap::Box> source;
  std::optional<WidgetMap::Box> target;

  std::optional<WidgetMap::Box>& at(Side side) { return side == Side::kSource ? source : target; }
  const std::optional<WidgetMap::Box>& at(Side side) const { return side == Side::kSource ? source : target; }
};

/// What the draw functions tell the window in return; made anew for each frame.
struct FrameReply {
  CanvasRects canvases;
  /// What the status bar says.
  std::string status;
  /// Set by whoever is under the pointer and wants another one than Dear ImGui's.
  std::optional<CursorShape> cursor;
  /// The next frame is due at this time (the frame clock's seconds) even if nothing happens: a caret, a line of the
  /// status bar that ends, something that moves.
  double next_frame_s = std::numeric_limits<double>::infinity();

  /// A text field has the keyboard from the next frame on: what is typed meanwhile must wait for it.
  bool field_awaits_keys = false;

  void ask_frame_at(double time_s) {
    if (time_s < next_frame_s) next_frame_s = time_s;
  }
};

} // namespace oversketch
