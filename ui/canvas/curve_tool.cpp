#include "ui/canvas/curve_tool.h"

#include "core/geometry/curve.h"

#include <algorithm>

namespace oversketch {
namespace {

/// How far a press may wander and still be a click; how near a click must be to a corner to mean it; how long a double
/// click may take.  Design px, seconds.
constexpr double kClick = 4, kOnCorner = 8, kDoubleClick_s = 0.4;

/// How far a point may be left out of the line, design px: what no eye sees.
constexpr double kSimplify = 0.25;

} // namespace

void CurveTool::update(std::span<const ToolEvent> events, const ToolContext& context, ActionSink& sink) {
  for (const ToolEvent& event : events)
    handle(event, context, sink);
  if (stale_) replan(context, sink);
}

void CurveTool::handle(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  const InputEvent& e = event.event;
  if (!is_finite(e.position)) return;
  if (sharp_ != e.modifiers.alt && busy()) stale_ = true;
  sharp_ = e.modifiers.alt;
  switch (e.kind) {
  case InputEvent::Kind::kFocusLost:
    return abandon(sink);
  case InputEvent::Kind::kPress:
    if (e.button == MouseButton::kRight) return abandon(sink);
    return press(event, context, sink);
  case InputEvent::Kind::kRelease:
    return release(event, context, sink);
  case InputEvent::Kind::kKeyDown:
    return press_key(e, context, sink);
  case InputEvent::Kind::kMove:
    if (stroke_ || event.side == side_) pointer_ = e.position;
    if (!stroke_) return;
    stroke_->add(e.position, e.time_s);
    drawn_ = drawn_ || distance(e.position, pressed_at_) > context.picture_px(kClick, side_);
    // One corner alone is a click that went astray.
    if (drawn_ && corners_.size() == 1) corners_.clear();
    stale_ = true;
    return;
  default:
    return;
  }
}

void CurveTool::press(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  if (event.event.button != MouseButton::kLeft) return;
  if (event.side != side_)
    return sink.emit(action::Say{side_ == Side::kSource ? "The outline is drawn in the source picture"
                                                        : "The sketch is drawn in the target picture"});
  if (selected_layer(gesture_.base(context.snapshot)) == nullptr)
    return sink.emit(action::Say{"Add a source picture first: drop one on the canvas"});
  const bool again = !corners_.empty() && event.event.time_s - pressed_s_ < kDoubleClick_s &&
                     distance(event.event.position, pressed_at_) < context.picture_px(kClick, side_);
  if (again) return finish(true, context, sink);
  if (!busy()) other_side_ = false;
  pressed_at_ = pointer_ = event.event.position;
  pressed_s_ = event.event.time_s;
  drawn_ = false;
  stroke_.emplace(context.preferences.smoothing, context.view(side_).zoom / context.scale);
  stroke_->add(pressed_at_, pressed_s_);
  stale_ = true;
}

void CurveTool::release(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  if (event.event.button != MouseButton::kLeft || !stroke_) return;
  pointer_ = event.event.position;
  stroke_->add(pointer_, event.event.time_s);
  drawn_ = drawn_ || distance(pointer_, pressed_at_) > context.picture_px(kClick, side_);
  if (!drawn_) return click(event, context, sink);
  if (corners_.size() < 2) {
    corners_.clear();
    return finish(false, context, sink);
  }
  const Points drawn = stroke_->smoothed();
  corners_.insert(corners_.end(), drawn.begin(), drawn.end());
  stroke_.reset();
  stale_ = true;
}

void CurveTool::click(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  stroke_.reset();
  stale_ = true;
  const Point at = event.event.position;
  const bool on_first = corners_.size() > 2 && distance(at, corners_.front()) <= context.picture_px(kOnCorner, side_);
  if (on_first) return finish(true, context, sink);
  corners_.push_back(at);
}

void CurveTool::press_key(const InputEvent& event, const ToolContext& context, ActionSink& sink) {
  if (!busy()) return;
  if (event.key == Key::kEscape) return abandon(sink);
  if (event.key == Key::kEnter) return finish(true, context, sink);
  if (event.key == key_of('X') && !event.modifiers.ctrl) other_side_ = !other_side_;
  if (event.key == Key::kBackspace && !corners_.empty()) corners_.pop_back();
  stale_ = true;
}

void CurveTool::finish(bool close, const ToolContext& context, ActionSink& sink) {
  const Points drawn = line(context);
  const Layer* layer = selected_layer(gesture_.base(context.snapshot));
  StrokePlan plan;
  if (layer != nullptr && drawn.empty()) plan.why_not = "The stroke lies outside the picture: nothing was changed";
  if (layer != nullptr && !drawn.empty()) {
    StrokeAsk wish = ask(context);
    wish.close = close;
    plan = plan_stroke(*layer, drawn, wish);
  }
  if (plan.command) {
    const auto after = oversketch::apply(gesture_.base(context.snapshot), *plan.command);
    if (!after) plan.why_not = after.error().sentence, plan.command.reset();
  }
  if (plan.command && gesture_.begun() && gesture_.preview(*plan.command, context.snapshot, sink)) {
    gesture_.commit(sink);
  } else {
    gesture_.abandon(sink);
    if (plan.command) sink.emit(action::Execute{*plan.command});
  }
  if (!plan.command && !plan.why_not.empty()) sink.emit(action::Say{plan.why_not});
  forget();
}

void CurveTool::replan(const ToolContext& context, ActionSink& sink) {
  stale_ = false;
  plan_ = {};
  const Layer* layer = selected_layer(gesture_.base(context.snapshot));
  const Points drawn = busy() ? line(context) : Points();
  if (layer == nullptr || drawn.size() < 2 || (!drawn_ && corners_.size() < 2)) return;
  plan_ = plan_stroke(*layer, drawn, ask(context));
  if (!plan_.command) plan_.ghost = forecast_ghost(*layer, drawn, ask(context));
  // A new outline means a new mesh and a new match: that waits for the pen to be lifted.
  if (plan_.command && side_ == Side::kTarget && stroke_ && corners_.empty())
    (void)gesture_.preview(*plan_.command, context.snapshot, sink).ok();
}

void CurveTool::abandon(ActionSink& sink) {
  gesture_.abandon(sink);
  forget();
}

void CurveTool::forget() {
  stroke_.reset();
  corners_.clear();
  plan_ = {};
  drawn_ = false;
  other_side_ = false;
  stale_ = false;
}

Points CurveTool::line(const ToolContext& context) const {
  Points all = corners_;
  if (stroke_ && drawn_) {
    const Points drawn = stroke_->smoothed();
    all.insert(all.end(), drawn.begin(), drawn.end());
  }
  const Document& document = gesture_.base(context.snapshot);
  const Layer* layer = selected_layer(document);
  if (layer != nullptr && side_ == Side::kSource)
    all = clamp_to_picture(all, picture_size(document), layer->outline.empty());
  if (all.size() < 3) return all;
  return simplify(all, context.picture_px(kSimplify, side_), false);
}

StrokeAsk CurveTool::ask(const ToolContext& context) const {
  StrokeAsk ask;
  ask.side = side_;
  // What a command takes.
  ask.tolerance_px = std::clamp(context.picture_px(context.preferences.tolerance_px, side_), 0.01, 10'000.0);
  ask.other_side = other_side_;
  ask.sharp = sharp_;
  return ask;
}

Point CurveTool::picture_size(const Document& document) const {
  const Layer* layer = selected_layer(document);
  const Image& image = side_ == Side::kSource && layer != nullptr ? layer->source.image : document.target.image;
  return {static_cast<double>(image.width()), static_cast<double>(image.height())};
}

ToolDrawing CurveTool::draw(const ToolContext& context) const {
  ToolDrawing drawing;
  drawing.cursor = CursorShape::kCross;
  drawing.hint_side = side_;
  const Layer* layer = selected_layer(gesture_.base(context.snapshot));
  const bool has_curve = layer != nullptr && !layer->outline.empty();
  if (!busy()) {
    if (layer == nullptr) {
      drawing.hint = kNoLayerHint;
      drawing.hint_side = Side::kTarget;
    } else {
      drawing.hint = has_curve ? "Draw over a part to change it  [X] other side  [Alt] sharp ends  [Esc] cancel"
                     : side_ == Side::kSource ? "Draw round the part that you want; the line closes itself"
                                              : kNoOutlineHint;
    }
    return drawing;
  }
  Points drawn = corners_;
  if (stroke_) {
    const Points by_hand = stroke_->smoothed();
    drawn.insert(drawn.end(), by_hand.begin(), by_hand.end());
  }
  if (!plan_.ghost.empty() && !plan_.closes)
    drawing.lines.push_back({side_, ToolLine::Kind::kGhost, plan_.ghost, false});
  drawing.lines.push_back({side_, ToolLine::Kind::kStroke, drawn, false});
  if (!stroke_ && !drawn.empty())
    drawing.lines.push_back({side_, ToolLine::Kind::kRubber, {drawn.back(), pointer_}, false});
  if (plan_.closes || !has_curve) {
    drawing.lines.push_back({side_, ToolLine::Kind::kRubber, {pointer_, drawn.front()}, false});
    if (plan_.closes) drawing.marks.push_back({side_, ToolMark::Kind::kClose, drawn.front()});
  }
  for (const Point corner : corners_)
    if (corners_.size() < 40) drawing.marks.push_back({side_, ToolMark::Kind::kVertex, corner});
  drawing.hint = !corners_.empty() ? "Click on for straight lines  [Enter] done  [Backspace] one back  [Esc] cancel"
                 : has_curve       ? "[X] other side  [Alt] sharp ends  [Esc] cancel"
                                   : "Let go to close the line  [Esc] cancel";
  return drawing;
}

} // namespace oversketch
