#pragma once

#include "ui/canvas/canvas_layout.h"
#include "ui/canvas/curve_tool.h"
#include "ui/canvas/move_tool.h"
#include "ui/canvas/pin_tool.h"
#include "ui/state/editor_state.h"

#include <array>

namespace oversketch {

/// One frame as the canvases' input sees it.
struct CanvasFrame {
  const EditorState& state;
  const DocumentView& view;
  const Snapshot& snapshot;
  CanvasLayout layout;
  /// Of both pictures; 0 where there is none.
  Point source_size;
  Point target_size;
  /// Nothing lies over the canvases, and nobody is typing.
  bool mouse_free = true;
  bool keys_free = true;
  /// A menu or a dialog is open: events go there, and the end of what is held would never be told.
  bool covered = false;
  /// Screen pixels per design pixel.
  double scale = 1;

  Point picture_size(Side side) const { return side == Side::kSource ? source_size : target_size; }
  bool one_canvas() const { return !layout.source; }
};

/// Deals out the window's events: to the splitter and the comparison's slider, to panning and zooming, to the tool in
/// hand; and knows which tool that is while a key is held.
///
/// A press belongs to where it began until it is released, wherever the pointer goes.  What changes a view is at work
/// at once for the events after it, and told as SetView at the end.
class CanvasInput {
public:
  void update(const InputEvents& events, const CanvasFrame& frame, ActionSink& sink);

  /// After update(): the views as they are now, what the tool shows, and the pointer's shape where it is over a canvas.
  const View& view(Side side) const { return views_[static_cast<std::size_t>(side)]; }
  ToolDrawing draw(const CanvasFrame& frame) const;
  std::optional<CursorShape> cursor(const CanvasFrame& frame, const ToolDrawing& drawing) const;
  /// The pointer is on the splitter or drags it.
  bool over_splitter(const CanvasFrame& frame) const {
    return hold_ == Hold::kSplitter || (hold_ == Hold::kNone && frame.mouse_free && on_splitter(pointer_, frame));
  }
  /// A drag is under way.
  bool held() const { return hold_ != Hold::kNone; }

  ToolContext context(const CanvasFrame& frame) const;

private:
  enum class Hold { kNone, kTool, kPan, kSplitter, kCompare };
  /// A tool's key that is down, and what was in hand before.
  struct HeldKey {
    Key key = Key::kNone;
    Tool before = Tool::kSketch;
    bool used = false;
  };

  void begin(const CanvasFrame& frame, ActionSink& sink);
  void handle(InputEvent event, const CanvasFrame& frame, ActionSink& sink);
  void press(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink);
  void move(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink);
  void release(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink);
  void turn_wheel(const InputEvent& event, const CanvasFrame& frame);
  void press_key(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink);
  void release_key(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink);
  void lose_focus(const CanvasFrame& frame, ActionSink& sink);
  bool zoom_by_key(const InputEvent& event, const CanvasFrame& frame);
  bool set_by_key(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink);
  void pick(Tool tool, const CanvasFrame& frame, ActionSink& sink);

  CanvasTool* tool_in_hand();
  const CanvasTool* tool_in_hand() const;
  bool pans() const { return space_ || tool_ == Tool::kPan; }
  /// Which side the tool is told that an event was on.
  Side told_side(Side side, const CanvasFrame& frame) const;
  /// Keeps an event for the tool; flush() hands over what was kept.
  void forward(const InputEvent& event, Side side, const CanvasFrame& frame);
  void flush(const CanvasFrame& frame, ActionSink& sink);
  bool on_slider(Point window, const CanvasFrame& frame) const;
  bool on_splitter(Point window, const CanvasFrame& frame) const;
  Point in_canvas(Point window, Side side, const CanvasFrame& frame) const;
  void set_view(Side side, const View& view);

  CurveTool outline_{Side::kSource};
  CurveTool sketch_{Side::kTarget};
  PinTool pin_;
  MoveTool move_;
  Tool tool_ = Tool::kOutline;
  std::optional<HeldKey> held_key_;
  /// The tool to go back to as soon as nothing is in hand.
  std::optional<Tool> return_to_;

  Hold hold_ = Hold::kNone;
  Side hold_side_ = Side::kTarget;
  MouseButton hold_button_ = MouseButton::kLeft;
  Point pointer_;
  bool space_ = false;
  bool before_ = false;
  std::array<View, 2> views_;
  std::array<bool, 2> view_changed_{};
  std::vector<ToolEvent> kept_;
  double tolerance_px_ = 10;
  /// Whose document the tools work on; only ever compared.
  const LiveSession* session_ = nullptr;
};

} // namespace oversketch
