#include "ui/canvas/pin_tool.h"

#include "core/geometry/curve.h"

#include <algorithm>

namespace oversketch {
namespace {

/// How near the pointer must be to a pin's end; how far a press may wander and still be a click.  Design px.
constexpr double kOnPin = 10, kPinClick = 3;
/// How near to a curve a click must be to mean it, in tolerances.
constexpr double kReach = 3;

Point end_of(const Layer& layer, const Pin& pin, Side side) {
  return side == Side::kSource ? pin.outline : layer.placement.to_target()(pin.sketch);
}

Side other(Side side) {
  return side == Side::kSource ? Side::kTarget : Side::kSource;
}

} // namespace

void PinTool::update(std::span<const ToolEvent> events, const ToolContext& context, ActionSink& sink) {
  for (const ToolEvent& event : events)
    handle(event, context, sink);
  if (stale_) move(context, sink);
  stale_ = false;
}

void PinTool::handle(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  const InputEvent& e = event.event;
  if (!is_finite(e.position)) return;
  switch (e.kind) {
  case InputEvent::Kind::kFocusLost:
    return abandon(sink);
  case InputEvent::Kind::kPress:
    if (e.button == MouseButton::kRight) return abandon(sink);
    if (e.button == MouseButton::kLeft) press(event, context, sink);
    return;
  case InputEvent::Kind::kRelease:
    if (e.button != MouseButton::kLeft || !drag_) return;
    pointer_ = e.position;
    move(context, sink);
    return release(sink);
  case InputEvent::Kind::kMove:
    pointer_ = e.position;
    pointer_side_ = event.side;
    stale_ = drag_.has_value();
    return;
  case InputEvent::Kind::kKeyDown:
    if (e.key == Key::kEscape && busy()) return abandon(sink);
    if (e.key == Key::kEscape && context.selected_pin) return sink.emit(action::SelectPin{std::nullopt});
    if (e.key != Key::kDelete && e.key != Key::kBackspace) return;
    if (half_) return abandon(sink);
    remove_selected(context, sink);
    return;
  default:
    return;
  }
}

void PinTool::press(const ToolEvent& event, const ToolContext& context, ActionSink& sink) {
  pointer_ = event.event.position;
  pointer_side_ = event.side;
  const Layer* layer = selected_layer(context.snapshot.document);
  if (layer == nullptr || layer->outline.empty())
    return sink.emit(action::Say{"Outline the part in the source picture first"});
  // Two pins cannot share a point: whoever presses one means that one.
  if (const auto on = hit(*layer, event.side, pointer_, context)) {
    half_.reset();
    drag_ = Drag{on->pin, on->side, pointer_, false};
    return sink.emit(action::SelectPin{on->pin});
  }
  const auto end = nearest_end(*layer, event.side, pointer_, context);
  if (!end)
    return sink.emit(action::Say{!half_                         ? "Click on the outline to begin a pin"
                                 : half_->side == Side::kSource ? "Click on the sketch, where the pin belongs"
                                                                : "Click on the outline, where the pin belongs"});
  set_end(*end, context, sink);
}

void PinTool::set_end(const End& end, const ToolContext& context, ActionSink& sink) {
  if (!half_ || half_->side == end.side) {
    half_ = end;
    return sink.emit(action::SelectPin{std::nullopt});
  }
  const Document& document = context.snapshot.document;
  const End& source = end.side == Side::kSource ? end : *half_;
  const End& target = end.side == Side::kSource ? *half_ : end;
  const Command add = PinAdd{document.selected, source.at, target.at};
  if (const auto after = oversketch::apply(document, add); !after)
    return sink.emit(action::Say{after.error().sentence});
  sink.emit(action::Execute{add});
  sink.emit(action::SelectPin{PinId{document.next_pin}});
  half_.reset();
}

void PinTool::move(const ToolContext& context, ActionSink& sink) {
  if (!drag_) return;
  drag_->moved = drag_->moved || distance(pointer_, drag_->from) > context.picture_px(kPinClick, drag_->side);
  if (!drag_->moved) return;
  PinMove command{gesture_.base(context.snapshot).selected, drag_->pin, {}, {}};
  (drag_->side == Side::kSource ? command.outline : command.sketch) = pointer_;
  if (const auto accepted = gesture_.preview(command, context.snapshot, sink); !accepted)
    sink.emit(action::Say{accepted.error().sentence});
}

void PinTool::release(ActionSink& sink) {
  gesture_.commit(sink);
  drag_.reset();
}

void PinTool::abandon(ActionSink& sink) {
  gesture_.abandon(sink);
  half_.reset();
  drag_.reset();
  stale_ = false;
}

void PinTool::remove_selected(const ToolContext& context, ActionSink& sink) {
  const Layer* layer = selected_layer(context.snapshot.document);
  if (busy() || layer == nullptr || !context.selected_pin) return;
  const auto is_it = [&](const Pin& pin) { return pin.id == *context.selected_pin; };
  if (std::none_of(layer->pins.begin(), layer->pins.end(), is_it)) return;
  sink.emit(action::Execute{PinRemove{layer->id, *context.selected_pin}});
  sink.emit(action::SelectPin{std::nullopt});
}

std::optional<PinTool::Hit> PinTool::hit(const Layer& layer, Side side, Point at, const ToolContext& context) const {
  std::optional<Hit> best;
  double nearest = context.picture_px(kOnPin, side);
  const auto look = [&](Side on) {
    for (const Pin& pin : layer.pins)
      if (const double away = distance(at, end_of(layer, pin, on)); away <= nearest)
        nearest = away, best = {pin.id, on};
  };
  look(side);
  if (context.one_canvas) look(other(side));
  return best;
}

std::optional<PinTool::End> PinTool::nearest_end(const Layer& layer, Side side, Point at,
                                                 const ToolContext& context) const {
  const auto look = [&](Side on) { return ClosedCurve(curve_on(layer, on)).nearest(at); };
  Side on = side;
  if (context.one_canvas && half_) on = other(half_->side);
  if (context.one_canvas && !half_)
    on = look(Side::kSource).distance <= look(Side::kTarget).distance ? Side::kSource : Side::kTarget;
  const CurvePosition place = look(on);
  if (place.distance > kReach * context.picture_px(context.preferences.tolerance_px, side)) return std::nullopt;
  return End{on, place.point};
}

ToolDrawing PinTool::draw(const ToolContext& context) const {
  ToolDrawing drawing;
  const Layer* layer = selected_layer(context.snapshot.document);
  if (layer == nullptr || layer->outline.empty()) {
    drawing.hint = layer == nullptr ? kNoLayerHint : kNoOutlineHint;
    return drawing;
  }
  const auto mark = [&](ToolMark::Kind kind, Side side, Point at, double fraction) {
    drawing.marks.push_back({side, kind, at, fraction});
  };
  if (drag_) {
    drawing.cursor = CursorShape::kGrab;
    drawing.hint = "Drag along the curve  [Esc] cancel";
    drawing.hint_side = drag_->side;
    return drawing;
  }
  const auto end = nearest_end(*layer, pointer_side_, pointer_, context);
  const bool on_pin = !half_ && hit(*layer, pointer_side_, pointer_, context);
  drawing.cursor = on_pin ? CursorShape::kHand : end ? CursorShape::kCross : CursorShape::kArrow;
  const LayerSnapshot* derived = context.snapshot.find(layer->id);
  const auto fraction = [&](Side side, Point at) {
    if (side == Side::kSource) return outline_fraction(layer->outline, at);
    const auto place = opposite_place(*layer, derived, side, at);
    return place ? outline_fraction(layer->outline, *place) : 0.0;
  };
  if (half_) {
    const double f = fraction(half_->side, half_->at);
    mark(ToolMark::Kind::kPin, half_->side, half_->at, f);
    // Where the point has gone by itself: from there it is not far to where it belongs.
    if (const auto place = opposite_place(*layer, derived, half_->side, half_->at))
      mark(ToolMark::Kind::kPlace, other(half_->side), *place, f);
    if (end && end->side != half_->side) mark(ToolMark::Kind::kPin, end->side, end->at, f);
  } else if (end && !on_pin) {
    mark(ToolMark::Kind::kPlace, end->side, end->at, fraction(end->side, end->at));
  }
  drawing.hint_side = half_ ? other(half_->side) : Side::kSource;
  drawing.hint = half_ && half_->side == Side::kSource ? "Now click where it belongs on the sketch  [Esc] cancel"
                 : half_ ? "Now click the point of the outline that belongs here  [Esc] cancel"
                         : "Click a point of the outline, then its place on the sketch  [Del] remove";
  return drawing;
}

double outline_fraction(const Points& outline, Point at) {
  if (outline.size() < 3) return 0;
  const ClosedCurve curve(outline);
  return curve.nearest(at).s / curve.length();
}

std::optional<Point> opposite_place(const Layer& layer, const LayerSnapshot* derived, Side side, Point at) {
  if (derived == nullptr || derived->deformation == nullptr) return std::nullopt;
  const Points& deformed = derived->deformation->outline;
  if (deformed.size() != layer.outline.size() || deformed.size() < 3) return std::nullopt;
  const Similarity placed = layer.placement.to_target();
  const Points from = side == Side::kSource ? layer.outline : transformed(deformed, placed);
  const Points to = side == Side::kSource ? transformed(deformed, placed) : layer.outline;
  const CurvePosition place = ClosedCurve(from).nearest(at);
  const auto i = static_cast<std::size_t>(place.segment), next = (i + 1) % from.size();
  const double piece = distance(from[i], from[next]);
  return lerp(to[i], to[next], piece > 0 ? distance(from[i], place.point) / piece : 0.0);
}

} // namespace oversketch
