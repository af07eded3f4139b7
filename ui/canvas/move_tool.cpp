#include "ui/canvas/move_tool.h"

#include "core/geometry/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oversketch {
namespace {

/// How near the pointer must be to a corner; how far a press may wander and still be a click.  Design px.
constexpr double kOnFrameCorner = 9, kMoveClick = 3;
/// Within the frame, no further from it than this part of the shorter side.
constexpr double kCornerShare = 0.25;
constexpr double kTurnStep_deg = 15, kScaleStep = 0.05;
/// Further than any command takes a layer.
constexpr double kFurthest = 1 << 22;
constexpr double kDegree = std::numbers::pi / 180;

bool is_in_frame(const LayerFrame& frame, Point p) {
  return contains(Points(frame.begin(), frame.end()), p);
}

/// The topmost visible layer whose part covers the place.
const Layer* layer_at(const Document& document, Point p) {
  for (auto layer = document.layers.rbegin(); layer != document.layers.rend(); ++layer)
    if (layer->settings.visible && !layer->sketch.empty() && contains(layer->sketch_in_target(), p)) return &*layer;
  return nullptr;
}

std::optional<WholeOffset> arrow_of(Key key) {
  switch (key) {
  case Key::kLeft:
    return WholeOffset{-1, 0};
  case Key::kRight:
    return WholeOffset{1, 0};
  case Key::kUp:
    return WholeOffset{0, -1};
  case Key::kDown:
    return WholeOffset{0, 1};
  default:
    return std::nullopt;
  }
}

/// The pointer for pulling in a direction, either way.
CursorShape pull_cursor(Point direction) {
  const double angle = std::atan2(direction.y, direction.x) / std::numbers::pi * 4;
  const int eighth = (static_cast<int>(std::lround(angle)) + 8) % 4;
  const CursorShape shapes[] = {CursorShape::kResizeEw, CursorShape::kResizeNwse, CursorShape::kResizeNs,
                                CursorShape::kResizeNesw};
  return shapes[eighth];
}

} // namespace

std::optional<LayerFrame> frame_of(const Layer& layer) {
  if (layer.sketch.empty()) return std::nullopt;
  const Box box = bounds(layer.sketch);
  const Similarity placed = layer.placement.to_target();
  return LayerFrame{placed(box.low), placed({box.high.x, box.low.y}), placed(box.high),
                    placed({box.low.x, box.high.y})};
}

void MoveTool::update(std::span<const ToolEvent> events, const ToolContext& context, ActionSink& sink) {
  for (const ToolEvent& event : events)
    handle(event, context, sink);
  if (stale_) preview_drag(context, sink);
}

void MoveTool::handle(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  const InputEvent& e = event.event;
  if (!is_finite(e.position)) return;
  if (drag_ != Drag::kNone && shift_ != e.modifiers.shift) stale_ = true;
  shift_ = e.modifiers.shift;
  switch (e.kind) {
  case InputEvent::Kind::kFocusLost:
    return abandon(sink);
  case InputEvent::Kind::kPress:
    if (e.button == MouseButton::kRight) return abandon(sink);
    if (e.button == MouseButton::kLeft && event.side == Side::kTarget) press(event, context, sink);
    return;
  case InputEvent::Kind::kMove:
  case InputEvent::Kind::kRelease:
    if (drag_ == Drag::kTurn) {
      const Point before = pointer_ - centre_, now = e.position - centre_;
      turned_rad_ += std::atan2(cross(before, now), dot(before, now));
    }
    pointer_ = e.position;
    pointer_side_ = event.side;
    if (drag_ == Drag::kNone) return;
    dragged_ = dragged_ || distance(pointer_, from_) > context.picture_px(kMoveClick, Side::kTarget);
    stale_ = dragged_;
    if (e.kind == InputEvent::Kind::kRelease && e.button == MouseButton::kLeft) {
      if (stale_) preview_drag(context, sink);
      finish(sink);
    }
    return;
  case InputEvent::Kind::kKeyDown:
  case InputEvent::Kind::kKeyRepeat:
    return press_key(e, context, sink);
  case InputEvent::Kind::kKeyUp:
    if (nudging_ && arrow_of(e.key)) finish(sink);
    return;
  default:
    return;
  }
}

void MoveTool::press(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  if (nudging_) finish(sink);
  pointer_ = from_ = event.event.position;
  pointer_side_ = event.side;
  const Grip grip = grip_at(from_, context);
  const Document& document = context.snapshot.document;
  if (grip.layer) sink.emit(action::Execute{LayerSelect{grip.layer}});
  const Layer* held = grip.layer ? document.find(*grip.layer) : selected_layer(document);
  const auto frame = held != nullptr ? frame_of(*held) : std::nullopt;
  if (!frame) return sink.emit(action::Say{"There is nothing to move yet: outline a part first"});
  layer_ = held->id;
  centre_ = 0.5 * ((*frame)[0] + (*frame)[2]);
  drag_ = grip.drag;
  turned_rad_ = 0;
  dragged_ = false;
}

void MoveTool::press_key(const InputEvent& event, const ToolContext& context, ActionSink& sink) {
  if (event.key == Key::kEscape) return abandon(sink);
  const auto arrow = arrow_of(event.key);
  const Layer* selected = selected_layer(context.snapshot.document);
  if (!arrow || drag_ != Drag::kNone || event.modifiers.ctrl || selected == nullptr) return;
  if (!nudging_) layer_ = selected->id, nudge_ = {};
  const int step = event.modifiers.shift ? 10 : 1;
  nudging_ = true;
  nudge_.x += step * arrow->x;
  nudge_.y += step * arrow->y;
  stale_ = true;
}

void MoveTool::preview_drag(const ToolContext& context, ActionSink& sink) {
  stale_ = false;
  const auto wanted = command();
  // Back at the start, with previews on their way: that is a place like any other.
  if (!wanted && !gesture_.begun()) return;
  const Command shown = wanted ? *wanted : Command(LayerMove{layer_, {}});
  if (const auto accepted = gesture_.preview(shown, context.snapshot, sink); !accepted)
    sink.emit(action::Say{accepted.error().sentence});
}

void MoveTool::finish(ActionSink& sink) {
  if (command())
    gesture_.commit(sink);
  else
    gesture_.abandon(sink);
  drag_ = Drag::kNone;
  nudging_ = false;
  stale_ = false;
}

void MoveTool::abandon(ActionSink& sink) {
  gesture_.abandon(sink);
  drag_ = Drag::kNone;
  nudging_ = false;
  stale_ = false;
}

std::optional<Command> MoveTool::command() const {
  if (nudging_ && (nudge_.x != 0 || nudge_.y != 0)) return LayerMove{layer_, nudge_};
  if (!dragged_) return std::nullopt;
  switch (drag_) {
  case Drag::kMove: {
    Point by = pointer_ - from_;
    if (shift_) (std::abs(by.x) >= std::abs(by.y) ? by.y : by.x) = 0;
    const auto whole_px = [](double x) { return static_cast<int>(std::lround(std::clamp(x, -kFurthest, kFurthest))); };
    const WholeOffset whole{whole_px(by.x), whole_px(by.y)};
    if (whole == WholeOffset{}) return std::nullopt;
    return LayerMove{layer_, whole};
  }
  case Drag::kTurn: {
    double degrees = turned_rad_ / kDegree;
    if (shift_) degrees = kTurnStep_deg * std::round(degrees / kTurnStep_deg);
    degrees = std::remainder(degrees, 360);
    if (degrees == 0) return std::nullopt;
    return LayerTransform{layer_, degrees, 1, centre_};
  }
  case Drag::kScale: {
    const double before = distance(from_, centre_), now = distance(pointer_, centre_);
    if (!(before > 0)) return std::nullopt;
    double scale = now / before;
    if (shift_) scale = kScaleStep * std::round(scale / kScaleStep);
    scale = std::clamp(scale, 0.001, 1000.0);
    if (scale == 1) return std::nullopt;
    return LayerTransform{layer_, 0, scale, centre_};
  }
  case Drag::kNone:
    return std::nullopt;
  }
  return std::nullopt;
}

MoveTool::Grip MoveTool::grip_at(Point at, const ToolContext& context) const {
  const Document& document = context.snapshot.document;
  const Layer* selected = selected_layer(document);
  const auto frame = selected != nullptr ? frame_of(*selected) : std::nullopt;
  if (frame) {
    const Point centre = 0.5 * ((*frame)[0] + (*frame)[2]);
    // The middle of a small part moves it.
    const double side = std::min(distance((*frame)[0], (*frame)[1]), distance((*frame)[1], (*frame)[2]));
    const double reach = context.picture_px(kOnFrameCorner, Side::kTarget);
    const double on_corner = is_in_frame(*frame, at) ? std::min(reach, kCornerShare * side) : reach;
    for (const Point corner : *frame)
      if (distance(at, corner) <= on_corner) return {Drag::kScale, std::nullopt, corner - centre};
    if (contains(selected->sketch_in_target(), at)) return {Drag::kMove, std::nullopt, {}};
  }
  if (const Layer* other = layer_at(document, at); other != nullptr && other != selected)
    return {Drag::kMove, other->id, {}};
  if (!frame) return {};
  return {is_in_frame(*frame, at) ? Drag::kMove : Drag::kTurn, std::nullopt, {}};
}

CursorShape MoveTool::cursor(const ToolContext& context) const {
  if (pointer_side_ == Side::kSource) return CursorShape::kArrow;
  const Grip grip = grip_at(pointer_, context);
  const Drag kind = drag_ != Drag::kNone ? drag_ : grip.drag;
  switch (kind) {
  case Drag::kMove:
    return drag_ == Drag::kNone && grip.layer ? CursorShape::kHand : CursorShape::kMove;
  case Drag::kTurn:
    return CursorShape::kArrow;
  case Drag::kScale:
    return pull_cursor(drag_ == Drag::kScale ? pointer_ - centre_ : grip.corner);
  case Drag::kNone:
    return CursorShape::kArrow;
  }
  return CursorShape::kArrow;
}

ToolDrawing MoveTool::draw(const ToolContext& context) const {
  ToolDrawing drawing;
  drawing.cursor = cursor(context);
  Document shown = gesture_.base(context.snapshot);
  // The frame goes with the pointer at once; the picture follows as fast as it can.
  const auto moved = command();
  if (moved)
    if (auto after = oversketch::apply(shown, *moved)) shown = std::move(*after);
  const Layer* layer = busy() && layer_ ? shown.find(*layer_) : selected_layer(shown);
  const auto frame = layer != nullptr ? frame_of(*layer) : std::nullopt;
  if (!frame) {
    drawing.hint = layer == nullptr ? kNoLayerHint : kNoOutlineHint;
    return drawing;
  }
  drawing.lines.push_back({Side::kTarget, ToolLine::Kind::kFrame, Points(frame->begin(), frame->end()), true});
  for (const Point corner : *frame)
    drawing.marks.push_back({Side::kTarget, ToolMark::Kind::kCorner, corner});
  const Drag kind = drag_ != Drag::kNone ? drag_ : grip_at(pointer_, context).drag;
  if (kind == Drag::kTurn && pointer_side_ == Side::kTarget)
    drawing.marks.push_back({Side::kTarget, ToolMark::Kind::kTurn, pointer_});
  drawing.hint = drag_ == Drag::kNone
                     ? "Drag to move, corners to scale, outside to turn  [Shift] constrains  [Arrows] 1 px"
                     : "[Shift] constrains  [Esc] cancel";
  return drawing;
}

} // namespace oversketch
