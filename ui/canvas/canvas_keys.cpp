// The keys that CanvasInput takes.

#include "ui/canvas/canvas_input.h"

#include "ui/state/settings.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

constexpr double kKeyZoom = 1.25;

std::optional<Tool> tool_of(Key key) {
  if (key == key_of('L')) return Tool::kOutline;
  if (key == key_of('S')) return Tool::kSketch;
  if (key == key_of('P')) return Tool::kPin;
  if (key == key_of('V')) return Tool::kMove;
  if (key == key_of('H')) return Tool::kPan;
  return std::nullopt;
}

} // namespace

void CanvasInput::press_key(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink) {
  if (zoom_by_key(event, frame)) return;
  const bool plain = !event.modifiers.ctrl && !event.modifiers.alt;
  const bool first = event.kind == InputEvent::Kind::kKeyDown;
  if (event.key == Key::kSpace && plain) {
    space_ = true;
    return;
  }
  if (plain && set_by_key(event, frame, sink)) return;
  if (const auto tool = tool_of(event.key); tool && plain && !event.modifiers.shift) {
    if (!first || hold_ != Hold::kNone || held_key_) return;
    held_key_ = HeldKey{event.key, tool_, false};
    return_to_.reset();
    return pick(*tool, frame, sink);
  }
  const auto side = hold_ == Hold::kTool ? hold_side_ : frame.layout.side_at(pointer_).value_or(Side::kTarget);
  InputEvent at_pointer = event;
  at_pointer.position = pointer_;
  forward(at_pointer, side, frame);
}

void CanvasInput::release_key(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink) {
  if (event.key == Key::kSpace) space_ = false;
  if (event.key == key_of('\\') && std::exchange(before_, false)) sink.emit(action::HoldBefore{false});
  if (held_key_ && held_key_->key == event.key) {
    if (held_key_->used) return_to_ = held_key_->before;
    held_key_.reset();
  }
  InputEvent at_pointer = event;
  at_pointer.position = pointer_;
  forward(at_pointer, hold_side_, frame);
}

bool CanvasInput::zoom_by_key(const InputEvent& event, const CanvasFrame& frame) {
  if (event.modifiers.alt) return false;
  const Side side = frame.layout.side_at(pointer_).value_or(Side::kTarget);
  const Box& box = *frame.layout.box(side);
  const Point fixed = contains(box, pointer_) ? pointer_ - box.low : 0.5 * box.size();
  const auto zoom = [&](double factor) {
    set_view(side, zoomed(view(side), fixed, factor));
    return true;
  };
  if (event.key == key_of('+') || event.key == key_of('=')) return zoom(kKeyZoom);
  if (event.key == key_of('-')) return zoom(1 / kKeyZoom);
  if (!event.modifiers.ctrl) return false;
  if (event.key == key_of('1')) return zoom(1 / view(side).zoom);
  if (event.key != key_of('0')) return false;
  for (const Side each : {Side::kSource, Side::kTarget})
    if (const Box* canvas = frame.layout.box(each); canvas != nullptr && frame.picture_size(each).x > 0)
      set_view(each, fitted(frame.picture_size(each), canvas->size()));
  return true;
}

bool CanvasInput::set_by_key(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink) {
  const bool more = event.key == key_of(']');
  if (more || event.key == key_of('[')) {
    Preferences preferences = frame.state.preferences;
    tolerance_px_ = stepped_tolerance(tolerance_px_, more);
    preferences.tolerance_px = tolerance_px_;
    sink.emit(action::SetPreferences{preferences});
    sink.emit(action::Say{"Strokes take hold within " + std::to_string(std::lround(tolerance_px_)) + " px of a curve"});
    return true;
  }
  if (event.key != key_of('\\')) return false;
  if (!std::exchange(before_, true)) sink.emit(action::HoldBefore{true});
  return true;
}

void CanvasInput::pick(Tool tool, const CanvasFrame& frame, ActionSink& sink) {
  flush(frame, sink);
  if (tool == tool_) return;
  if (CanvasTool* before = tool_in_hand(); before != nullptr && before->busy()) before->abandon(sink);
  tool_ = tool;
  sink.emit(action::PickTool{tool});
}

} // namespace oversketch
