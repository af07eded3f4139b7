#pragma once

#include "ui/canvas/tool.h"
#include "ui/canvas/tool_gesture.h"

#include <array>

namespace oversketch {

/// The pasted part's frame in the target: the box of its sketch, turned and scaled as the layer is.
using LayerFrame = std::array<Point, 4>;
std::optional<LayerFrame> frame_of(const Layer& layer);

/// Moves, turns and scales the pasted part: a drag inside moves it by whole pixels, one outside its frame turns it, one
/// at a corner scales it, about the frame's middle; Shift keeps to an axis, to 15°, to steps of 5 %.  Arrows nudge it
/// by a pixel, with Shift by ten; as long as one is held it is one step.  A press on another layer's part selects that.
class MoveTool : public CanvasTool {
public:
  void update(std::span<const ToolEvent> events, const ToolContext& context, ActionSink& sink) override;
  void abandon(ActionSink& sink) override;
  bool busy() const override { return drag_ != Drag::kNone || nudging_; }
  ToolDrawing draw(const ToolContext& context) const override;

private:
  enum class Drag { kNone, kMove, kTurn, kScale };
  /// What a press at a place would begin.
  struct Grip {
    Drag drag = Drag::kNone;
    /// Another layer, to be selected.
    std::optional<LayerId> layer;
    /// Of kScale: the corner's direction on the screen decides the pointer's shape.
    Point corner;
  };

  void handle(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void press(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void press_key(const InputEvent& event, const ToolContext& context, ActionSink& sink);
  void preview_drag(const ToolContext& context, ActionSink& sink);
  void finish(ActionSink& sink);
  Grip grip_at(Point at, const ToolContext& context) const;
  /// The command of the drag so far; nothing when it would change nothing.
  std::optional<Command> command() const;
  CursorShape cursor(const ToolContext& context) const;

  ToolGesture gesture_;
  Drag drag_ = Drag::kNone;
  std::optional<LayerId> layer_;
  Point from_;
  Point pointer_;
  Point centre_;
  /// Unrolled: turning on and on goes past 360°.
  double turned_rad_ = 0;
  bool shift_ = false;
  bool dragged_ = false;
  bool nudging_ = false;
  WholeOffset nudge_;
  Side pointer_side_ = Side::kTarget;
  bool stale_ = false;
};

} // namespace oversketch
