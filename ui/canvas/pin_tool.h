#pragma once

#include "ui/canvas/tool.h"
#include "ui/canvas/tool_gesture.h"

namespace oversketch {

/// Pins a point of the outline to a point of the sketch: a click on either, then one on the other.  Either end of a pin
/// is dragged along its curve; a click selects a pin, Delete removes it.  Esc, Delete or another pin lets go of the
/// half-made one.
class PinTool : public CanvasTool {
public:
  void update(std::span<const ToolEvent> events, const ToolContext& context, ActionSink& sink) override;
  void abandon(ActionSink& sink) override;
  bool busy() const override { return half_ || drag_; }
  ToolDrawing draw(const ToolContext& context) const override;

private:
  struct End {
    Side side = Side::kSource;
    Point at;
  };
  struct Drag {
    PinId pin;
    Side side = Side::kSource;
    Point from;
    bool moved = false;
  };
  struct Hit {
    PinId pin;
    Side side = Side::kSource;
  };

  void handle(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void press(const ToolEvent& event, const ToolContext& context, ActionSink& sink);
  void set_end(const End& end, const ToolContext& context, ActionSink& sink);
  void move(const ToolContext& context, ActionSink& sink);
  void release(ActionSink& sink);
  void remove_selected(const ToolContext& context, ActionSink& sink);
  std::optional<Hit> hit(const Layer& layer, Side side, Point at, const ToolContext& context) const;
  /// The place of the curve that is meant; nothing when none is near.
  std::optional<End> nearest_end(const Layer& layer, Side side, Point at, const ToolContext& context) const;

  ToolGesture gesture_;
  std::optional<End> half_;
  std::optional<Drag> drag_;
  Point pointer_;
  Side pointer_side_ = Side::kSource;
  bool stale_ = false;
};

/// Place on the outline as a fraction of its length, 0…1: what gives a pin, and every place of both curves, its colour.
double outline_fraction(const Points& outline, Point at);

/// Where a point of one curve lies on the other one now, by the deformation; nothing when there is none.
/// @param at  source px for kSource, target px for kTarget.
std::optional<Point> opposite_place(const Layer& layer, const LayerSnapshot* derived, Side side, Point at);

} // namespace oversketch
