#include "ui/canvas/canvas_input.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// How far from the splitter or the slider a press still takes it, how far one notch of the wheel scrolls; design px.
constexpr double kGrasp = 4, kScroll = 60;
constexpr double kWheelZoom = 1.2;

} // namespace

void CanvasInput::update(const InputEvents& events, const CanvasFrame& frame, ActionSink& sink) {
  begin(frame, sink);
  if (frame.covered && (hold_ != Hold::kNone || space_ || before_ || held_key_)) lose_focus(frame, sink);
  for (const InputEvent& event : events)
    handle(event, frame, sink);
  flush(frame, sink);
  if (return_to_ && hold_ == Hold::kNone && (tool_in_hand() == nullptr || !tool_in_hand()->busy()))
    pick(*std::exchange(return_to_, std::nullopt), frame, sink);
  for (const Side side : {Side::kSource, Side::kTarget})
    if (view_changed_[static_cast<std::size_t>(side)]) sink.emit(action::SetView{side, view(side)});
}

void CanvasInput::begin(const CanvasFrame& frame, ActionSink& sink) {
  const Tab* tab = frame.state.tab();
  const LiveSession* session = tab != nullptr ? tab->session.get() : nullptr;
  if (session != session_) {
    // Another document: there is nobody left to tell.
    ActionSink nobody;
    for (CanvasTool* tool : {static_cast<CanvasTool*>(&outline_), static_cast<CanvasTool*>(&sketch_),
                             static_cast<CanvasTool*>(&pin_), static_cast<CanvasTool*>(&move_)})
      tool->abandon(nobody);
    hold_ = Hold::kNone;
    session_ = session;
  }
  if (frame.state.tool != tool_) {
    if (tool_in_hand() != nullptr) tool_in_hand()->abandon(sink);
    if (hold_ == Hold::kTool) hold_ = Hold::kNone;
    tool_ = frame.state.tool;
    return_to_.reset();
  }
  views_ = {frame.view.source.view, frame.view.target.view};
  view_changed_ = {};
  tolerance_px_ = frame.state.preferences.tolerance_px;
}

void CanvasInput::handle(InputEvent event, const CanvasFrame& frame, ActionSink& sink) {
  const bool down = event.kind != InputEvent::Kind::kKeyUp;
  // The system leaves a modifier out of its own press.
  if (event.kind >= InputEvent::Kind::kKeyDown && event.kind <= InputEvent::Kind::kKeyUp) {
    if (event.key == Key::kAlt) event.modifiers.alt = down;
    if (event.key == Key::kShift) event.modifiers.shift = down;
    if (event.key == Key::kCtrl) event.modifiers.ctrl = down;
  }
  switch (event.kind) {
  case InputEvent::Kind::kPress:
    pointer_ = event.position;
    return press(event, frame, sink);
  case InputEvent::Kind::kMove:
    move(event, frame, sink);
    pointer_ = event.position;
    return;
  case InputEvent::Kind::kRelease:
    pointer_ = event.position;
    return release(event, frame, sink);
  case InputEvent::Kind::kWheel:
    pointer_ = event.position;
    return turn_wheel(event, frame);
  case InputEvent::Kind::kKeyDown:
  case InputEvent::Kind::kKeyRepeat:
    if (frame.keys_free) press_key(event, frame, sink);
    return;
  case InputEvent::Kind::kKeyUp:
    return release_key(event, frame, sink);
  case InputEvent::Kind::kFocusLost:
    return lose_focus(frame, sink);
  }
}

void CanvasInput::press(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink) {
  if (hold_ == Hold::kTool) return forward(event, hold_side_, frame);
  if (hold_ != Hold::kNone || !frame.mouse_free) return;
  const auto hold = [&](Hold what, Side side) { hold_ = what, hold_side_ = side, hold_button_ = event.button; };
  const bool left = event.button == MouseButton::kLeft;
  if (left && on_splitter(event.position, frame)) return hold(Hold::kSplitter, Side::kSource);
  const auto side = frame.layout.side_at(event.position);
  if (!side) return;
  if (event.button == MouseButton::kMiddle || (left && pans())) {
    if (held_key_) held_key_->used = true;
    return hold(Hold::kPan, *side);
  }
  if (left && on_slider(event.position, frame)) return hold(Hold::kCompare, Side::kTarget);
  if (tool_in_hand() == nullptr || frame.snapshot.document.empty()) return;
  if (held_key_) held_key_->used = true;
  if (left) hold(Hold::kTool, *side);
  forward(event, *side, frame);
  flush(frame, sink);
}

void CanvasInput::move(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink) {
  switch (hold_) {
  case Hold::kTool:
    return forward(event, hold_side_, frame);
  case Hold::kPan:
    return set_view(hold_side_, panned(view(hold_side_), event.position - pointer_));
  case Hold::kSplitter:
    if (frame.layout.source) sink.emit(action::SetSplit{frame.layout.split_at(event.position.x)});
    return;
  case Hold::kCompare: {
    const Box& box = frame.layout.target;
    const double split = std::clamp((event.position.x - box.low.x) / box.size().x, 0.0, 1.0);
    return sink.emit(action::SetCompare{frame.view.compare, split});
  }
  case Hold::kNone:
    break;
  }
  const auto side = frame.layout.side_at(event.position);
  if (side && frame.mouse_free && !pans()) forward(event, *side, frame);
}

void CanvasInput::release(const InputEvent& event, const CanvasFrame& frame, ActionSink& sink) {
  if (hold_ == Hold::kTool) forward(event, hold_side_, frame);
  if (hold_ == Hold::kNone || event.button != hold_button_) return;
  hold_ = Hold::kNone;
  flush(frame, sink);
}

void CanvasInput::turn_wheel(const InputEvent& event, const CanvasFrame& frame) {
  const auto side = frame.layout.side_at(event.position);
  if (!side || !frame.mouse_free || !is_finite(event.scroll)) return;
  const bool zooms = event.modifiers.ctrl || (frame.state.preferences.wheel_zooms && !event.modifiers.shift);
  if (zooms) {
    const double factor = std::pow(kWheelZoom, std::clamp(event.scroll.y, -20.0, 20.0));
    return set_view(*side, zoomed(view(*side), in_canvas(event.position, *side, frame), factor));
  }
  const Point by = event.modifiers.shift ? Point{event.scroll.y + event.scroll.x, 0} : event.scroll;
  set_view(*side, panned(view(*side), kScroll * frame.scale * by));
}

void CanvasInput::lose_focus(const CanvasFrame& frame, ActionSink& sink) {
  InputEvent event;
  event.kind = InputEvent::Kind::kFocusLost;
  forward(event, hold_side_, frame);
  flush(frame, sink);
  hold_ = Hold::kNone;
  space_ = false;
  if (std::exchange(before_, false)) sink.emit(action::HoldBefore{false});
  if (held_key_ && held_key_->used) pick(held_key_->before, frame, sink);
  held_key_.reset();
}

CanvasTool* CanvasInput::tool_in_hand() {
  switch (tool_) {
  case Tool::kOutline:
    return &outline_;
  case Tool::kSketch:
    return &sketch_;
  case Tool::kPin:
    return &pin_;
  case Tool::kMove:
    return &move_;
  case Tool::kPan:
    return nullptr;
  }
  return nullptr;
}

const CanvasTool* CanvasInput::tool_in_hand() const {
  return const_cast<CanvasInput*>(this)->tool_in_hand();
}

Side CanvasInput::told_side(Side side, const CanvasFrame& frame) const {
  return frame.one_canvas() && tool_ == Tool::kOutline ? Side::kSource : side;
}

void CanvasInput::forward(const InputEvent& event, Side side, const CanvasFrame& frame) {
  if (tool_in_hand() == nullptr) return;
  ToolEvent told{event, told_side(side, frame)};
  told.event.position = view(side).to_picture(in_canvas(event.position, side, frame));
  kept_.push_back(told);
}

void CanvasInput::flush(const CanvasFrame& frame, ActionSink& sink) {
  const auto events = std::exchange(kept_, {});
  if (CanvasTool* tool = tool_in_hand()) tool->update(events, context(frame), sink);
}

ToolContext CanvasInput::context(const CanvasFrame& frame) const {
  const bool one = frame.one_canvas();
  return {frame.snapshot,
          frame.state.preferences,
          view(one ? Side::kTarget : Side::kSource),
          view(Side::kTarget),
          one,
          frame.view.selected_pin,
          frame.scale};
}

ToolDrawing CanvasInput::draw(const CanvasFrame& frame) const {
  if (tool_in_hand() == nullptr || frame.snapshot.document.empty()) return {};
  ToolDrawing drawing = tool_in_hand()->draw(context(frame));
  // What stands beside the pointer goes where the pointer goes.
  const bool away = hold_ == Hold::kNone && (!frame.mouse_free || !frame.layout.side_at(pointer_));
  if (away) std::erase_if(drawing.marks, [](const ToolMark& mark) { return mark.kind == ToolMark::Kind::kTurn; });
  return drawing;
}

std::optional<CursorShape> CanvasInput::cursor(const CanvasFrame& frame, const ToolDrawing& drawing) const {
  const bool sideways = hold_ == Hold::kSplitter || hold_ == Hold::kCompare;
  if (sideways) return CursorShape::kResizeEw;
  if (hold_ == Hold::kPan) return CursorShape::kGrab;
  if (hold_ == Hold::kNone) {
    if (!frame.mouse_free) return std::nullopt;
    if (on_splitter(pointer_, frame)) return CursorShape::kResizeEw;
    if (!frame.layout.side_at(pointer_)) return std::nullopt;
    if (pans()) return CursorShape::kHand;
    if (on_slider(pointer_, frame)) return CursorShape::kResizeEw;
  }
  return drawing.cursor.value_or(CursorShape::kArrow);
}

bool CanvasInput::on_slider(Point window, const CanvasFrame& frame) const {
  if (frame.view.compare == LiveSession::Compare::kOff) return false;
  const Box& box = frame.layout.target;
  const double at = box.low.x + frame.view.compare_split * box.size().x;
  return contains(box, window) && std::abs(window.x - at) <= kGrasp * frame.scale;
}

bool CanvasInput::on_splitter(Point window, const CanvasFrame& frame) const {
  if (!frame.layout.splitter) return false;
  Box box = *frame.layout.splitter;
  box.low.x -= kGrasp * frame.scale;
  box.high.x += kGrasp * frame.scale;
  return contains(box, window);
}

Point CanvasInput::in_canvas(Point window, Side side, const CanvasFrame& frame) const {
  const Box* box = frame.layout.box(side);
  return window - (box != nullptr ? *box : frame.layout.target).low;
}

void CanvasInput::set_view(Side side, const View& view) {
  views_[static_cast<std::size_t>(side)] = view;
  view_changed_[static_cast<std::size_t>(side)] = true;
}

} // namespace oversketch
