#pragma once

#include "ui/canvas/stroke.h"
#include "ui/canvas/stroke_plan.h"
#include "ui/canvas/tool.h"
#include "ui/canvas/tool_gesture.h"

namespace oversketch {

/// Outline (on the source) and Sketch (on the target): draws the curve anew or a part of it over again, freehand or in
/// straight lines.
///
/// Freehand: press, draw, release.  Straight lines: each click sets a corner; Enter, a double click or a click on the
/// first corner ends it, Backspace takes the last corner back; a line drawn in between by hand becomes part of it.
/// While a line is in hand, X chooses the other part to replace and Alt makes sharp joins.  What the sketch would
/// become is previewed as soon as it is a valid one; the end is one command, one step.  A stroke that means nothing
/// says why.
class CurveTool : public CanvasTool {
public:
  explicit CurveTool(Side side) : side_(side) {}

  void update(std::span<const ToolEvent> events, const ToolContext& context, ActionSink& sink) override;
  void abandon(ActionSink& sink) override;
  bool busy() const override { return stroke_ || !corners_.empty(); }
  ToolDrawing draw(const ToolContext& context) const override;

private:
  void handle(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void press(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void release(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void click(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void press_key(const InputEvent& event, const ToolContext& context, ActionSink& sink);
  /// Carries out what has been drawn.
  void finish(bool close, const ToolContext& context, ActionSink& sink);
  void replan(const ToolContext& context, ActionSink& sink);
  void forget();

  /// All that is drawn so far as one line, simplified, within the picture.
  Points line(const ToolContext& context) const;
  StrokeAsk ask(const ToolContext& context) const;
  Point picture_size(const Document& document) const;

  Side side_;
  ToolGesture gesture_;
  /// The line under a pressed button, and whether it has gone further than a click.
  std::optional<Stroke> stroke_;
  bool drawn_ = false;
  Point pressed_at_;
  double pressed_s_ = -1;
  Points corners_;
  Point pointer_;
  bool other_side_ = false;
  bool sharp_ = false;
  /// Something has changed since the plan was made.
  bool stale_ = false;
  StrokePlan plan_;
};

} // namespace oversketch
