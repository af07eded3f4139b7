#pragma once

#include "core/session/snapshot.h"
#include "ui/canvas/input.h"
#include "ui/canvas/view.h"
#include "ui/state/action.h"
#include "ui/widgets/frame_reply.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oversketch {

/// Something that happened on a canvas: the event's position is in pixels of that side's picture.
struct ToolEvent {
  InputEvent event;
  Side side = Side::kTarget;
};

/// What a tool sees of the world, for one frame.
struct ToolContext {
  const Snapshot& snapshot;
  const Preferences& preferences;
  View source_view;
  View target_view;
  /// The target is its own source: both sides are the same picture on the same canvas.
  bool one_canvas = false;
  std::optional<PinId> selected_pin;
  /// Screen pixels per design pixel.
  double scale = 1;

  const View& view(Side side) const { return side == Side::kSource ? source_view : target_view; }
  /// A length on the screen in pixels of that side's picture.
  double picture_px(double design_px, Side side) const { return design_px * scale / view(side).zoom; }
};

/// A line that a tool shows while it works, in pixels of its side's picture.
struct ToolLine {
  enum class Kind { kStroke, kGhost, kRubber, kFrame };
  Side side = Side::kTarget;
  Kind kind = Kind::kStroke;
  Points points;
  bool closed = false;
};

/// A place that a tool marks: where a stroke closes, a corner to pull, the end of a pin that is being made; beside the
/// pointer, that a drag will turn.
struct ToolMark {
  enum class Kind { kClose, kVertex, kCorner, kPin, kPlace, kTurn };
  Side side = Side::kTarget;
  Kind kind = Kind::kVertex;
  Point at;
  /// Of a pin: its place on the outline, 0…1, which decides its colour.
  double fraction = 0;
};

/// All that a tool adds to the picture.
struct ToolDrawing {
  std::vector<ToolLine> lines;
  std::vector<ToolMark> marks;
  std::optional<CursorShape> cursor;
  /// For the pill at the canvas's lower edge; keys stand in brackets: "[Esc] cancel".
  std::string hint;
  /// The canvas that it is for.
  Side hint_side = Side::kTarget;
};

/// A tool as a state machine: events in, actions out.  Knows no window.
///
/// Whatever is in hand ends by itself at Esc, a right click and when the focus is lost; nothing of the document has
/// changed then.
class CanvasTool {
public:
  virtual ~CanvasTool() = default;
  /// Takes the events of one frame, in order, and asks for the preview that they lead to.
  virtual void update(std::span<const ToolEvent> events, const ToolContext& context, ActionSink& sink) = 0;
  virtual void abandon(ActionSink& sink) = 0;
  /// Whether something is in hand: then the tool is not changed under it.
  virtual bool busy() const = 0;
  virtual ToolDrawing draw(const ToolContext& context) const = 0;
};

/// Of every tool as long as there is no layer.
inline constexpr const char* kNoLayerHint = "[Ctrl+Shift+O] adds the picture that the part comes from; or drop it here";
inline constexpr const char* kNoOutlineHint = "[L] outline the part in the source picture first";

/// The layer that tools work on: the selected one; null when there is none.
const Layer* selected_layer(const Document& document);

} // namespace oversketch
