#include "ui/widgets/slider.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace oversketch {
namespace {

constexpr float kDragThreshold_px = 3;
/// For how long a slider shows what was set while the model has not said so yet.
constexpr double kCatchUp_s = 3;

/// What a slider remembers from frame to frame; ImGui keeps it, by window and id.
class Memory {
public:
  explicit Memory() : storage_(ImGui::GetStateStorage()) {}
  float& real(const char* name, float initial = 0) { return *storage_->GetFloatRef(ImGui::GetID(name), initial); }
  int& whole(const char* name) { return *storage_->GetIntRef(ImGui::GetID(name), 0); }

  enum Drag { kNone, kGoing, kGivenUp };
  int& drag() { return whole("##drag"); }

  /// Shown in place of the model's value until that has changed.
  void show(double value, double instead_of, double now_s) {
    real("##shown") = static_cast<float>(value);
    real("##instead") = static_cast<float>(instead_of);
    real("##until", -1) = static_cast<float>(now_s + kCatchUp_s);
  }
  void forget() { real("##until", -1) = -1; }
  double shown(double value, double now_s) {
    if (now_s > real("##until", -1)) return value;
    if (real("##instead") != static_cast<float>(value)) {
      real("##until", -1) = -1;
      return value;
    }
    return real("##shown");
  }

private:
  ImGuiStorage* storage_;
};

void draw_bar(const DrawContext& context, const RowBox& box, double value, const SliderSpec& spec, bool lively) {
  const ThemeLook& look = context.look;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float rounding = look.px(4), alpha = ImGui::GetStyle().Alpha;
  const PackedColor ground = lively ? look.hovered : look.raised;
  list->AddRectFilled(box.corner, box.end, faded(ground, alpha), rounding);
  const float fill = static_cast<float>(share_of(value, spec)) * box.width();
  if (fill >= 1) {
    const PackedColor filled = lively ? mixed(look.filled, look.ink, 0.08F) : look.filled;
    list->PushClipRect(box.corner, ImVec2(box.corner.x + fill, box.end.y), true);
    list->AddRectFilled(box.corner, box.end, faded(filled, alpha), rounding);
    list->PopClipRect();
  }
  draw_text(box.corner, ImVec2(box.end.x - look.px(8), box.end.y), look.ink, format_value(value, spec), 1);
}

SliderChange take_typed(const std::string& typed, std::string_view label, const SliderSpec& spec) {
  const auto value = parse_value(typed, spec);
  const std::string name(label);
  if (!value) return {SliderChange::Kind::kRefused, 0, name + ": \"" + typed + "\" is not a number."};
  if (*value < spec.least || *value > spec.most)
    return {SliderChange::Kind::kRefused, 0,
            name + " goes from " + format_value(spec.least, spec) + " to " + format_value(spec.most, spec) + "."};
  return {SliderChange::Kind::kSet, spec.whole ? std::round(*value) : *value};
}

/// The number as text to be typed over.  What is typed is kept as a number in the memory while it is one, since ImGui
/// forgets the text when the field loses the keyboard.
SliderChange draw_typing(const DrawContext& context, const RowBox& box, std::string_view label, double value,
                         const SliderSpec& spec, Memory& memory) {
  int& stage = memory.whole("##typing");
  char text[64];
  SliderSpec plain = spec;
  plain.unit = {};
  std::snprintf(text, sizeof text, "%s", format_value(value, plain).c_str());
  ImGui::SetCursorScreenPos(box.corner);
  ImGui::SetNextItemWidth(box.width());
  const float pad = std::max(0.0F, (box.height() - ImGui::GetFontSize()) / 2);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(context.look.px(8), pad));
  if (stage == 1) give_keys_to_next_field(context);
  const bool entered = ImGui::InputText("##text", text, sizeof text,
                                        ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopStyleVar();
  const bool active = ImGui::IsItemActive();
  float& last = memory.real("##typed");
  if (entered) {
    stage = 0;
    return take_typed(text, label, spec);
  }
  if (active) {
    stage = 3;
    const auto number = parse_value(text, spec);
    last = number ? static_cast<float>(*number) : NAN;
    context.reply.ask_frame_at(context.now_s + 0.25);
    return {};
  }
  // The keyboard comes to the field in the frame after it was asked for.
  if (stage != 3) {
    stage = stage == 1 ? 2 : 0;
    context.reply.ask_frame_at(context.now_s);
    return {};
  }
  stage = 0;
  if (compat::is_key_pressed(ImGuiKey_Escape, false)) return {};
  const bool same =
      std::isnan(last) || last == static_cast<float>(value) || format_value(last, plain) == format_value(value, plain);
  return same ? SliderChange{} : take_typed(format_value(last, plain), label, spec);
}

/// What the pointer says while it holds the bar.
SliderChange follow_drag(const RowBox& box, double value, const SliderSpec& spec, Memory& memory) {
  const ImGuiIO& io = ImGui::GetIO();
  if (memory.drag() == Memory::kGivenUp) return {};
  if (compat::is_key_pressed(ImGuiKey_Escape, false)) {
    const bool going = memory.drag() == Memory::kGoing;
    memory.drag() = Memory::kGivenUp;
    return going ? SliderChange{SliderChange::Kind::kAbandon} : SliderChange{};
  }
  if (memory.drag() == Memory::kNone) {
    if (std::abs(io.MousePos.x - io.MouseClickedPos[0].x) < kDragThreshold_px) return {};
    memory.drag() = Memory::kGoing;
    memory.real("##share") = static_cast<float>(share_of(value, spec));
  }
  float& share = memory.real("##share");
  share = io.KeyShift ? std::clamp(share + 0.1F * io.MouseDelta.x / box.width(), 0.0F, 1.0F)
                      : std::clamp((io.MousePos.x - box.corner.x) / box.width(), 0.0F, 1.0F);
  return {SliderChange::Kind::kPreview, value_at(share, spec)};
}

/// A click has been let go without a drag: it sets once no second one can come any more.
SliderChange wait_for_double_click(const DrawContext& context, Memory& memory, const SliderSpec& spec) {
  float& since = memory.real("##clicked", -1);
  if (since < 0) return {};
  const double due = since + ImGui::GetIO().MouseDoubleClickTime;
  if (context.now_s < due) {
    context.reply.ask_frame_at(due + 0.001);
    return {};
  }
  since = -1;
  return {SliderChange::Kind::kSet, value_at(memory.real("##share"), spec)};
}

/// What it is already is not set again.
SliderChange without_repeats(const SliderChange& change, double value) {
  return change.kind == SliderChange::Kind::kSet && change.value == value ? SliderChange{} : change;
}

} // namespace

SliderChange draw_slider(const DrawContext& context, std::string_view id, std::string_view label, const Tip& tip,
                         double value, const SliderSpec& spec) {
  using Kind = SliderChange::Kind;
  const IdScope scope(id);
  Memory memory;
  const RowBox box = begin_row(context, label);
  double shown = memory.shown(value, context.now_s);
  SliderChange change;
  if (memory.whole("##typing") != 0) {
    change = without_repeats(draw_typing(context, box, label, value, spec, memory), value);
    finish_item(context, id, tip);
    if (change.kind == Kind::kSet) memory.show(change.value, value, context.now_s);
    end_row(context, box);
    return change;
  }

  ImGui::InvisibleButton("##bar", ImVec2(box.width(), box.height()));
  const bool active = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActivated() && io.KeyCtrl) {
    memory.whole("##typing") = 1;
    context.reply.ask_frame_at(context.now_s);
  } else if (hovered && ImGui::IsMouseDoubleClicked(0)) {
    memory.real("##clicked", -1) = -1;
    change = {Kind::kSet, spec.initial};
  } else if (active && !io.KeyCtrl) {
    change = follow_drag(box, shown, spec, memory);
  } else if (!active && memory.drag() != Memory::kNone) {
    if (memory.drag() == Memory::kGoing) change = {Kind::kCommit, value_at(memory.real("##share"), spec)};
    memory.drag() = Memory::kNone;
  } else if (ImGui::IsItemDeactivated() && hovered && !io.KeyCtrl && memory.whole("##reset") == 0) {
    memory.real("##clicked", -1) = static_cast<float>(context.now_s);
    memory.real("##share") = std::clamp((io.MousePos.x - box.corner.x) / box.width(), 0.0F, 1.0F);
  }
  if (hovered && ImGui::IsMouseClicked(0)) memory.whole("##reset") = ImGui::IsMouseDoubleClicked(0) ? 1 : 0;
  if (change.kind == Kind::kAbandon) memory.forget();
  if (change.kind == Kind::kNone) change = wait_for_double_click(context, memory, spec);
  change = without_repeats(change, value);
  if (change.kind == Kind::kSet || change.kind == Kind::kPreview || change.kind == Kind::kCommit) {
    memory.show(change.value, value, context.now_s);
    shown = change.value;
  }
  draw_bar(context, box, shown, spec, hovered || active);
  finish_item(context, id, {tip.text, tip.keys.empty() ? "Ctrl+click types, double-click resets" : tip.keys});
  end_row(context, box);
  return change;
}

void emit_slider(ActionSink& sink, const SliderChange& change, const std::function<Command(double)>& command) {
  switch (change.kind) {
  case SliderChange::Kind::kNone:
    return;
  case SliderChange::Kind::kPreview:
    return sink.emit(action::Preview{command(change.value)});
  case SliderChange::Kind::kCommit:
    return sink.emit(action::Commit{});
  case SliderChange::Kind::kAbandon:
    return sink.emit(action::Abandon{});
  case SliderChange::Kind::kSet:
    return sink.emit(action::Execute{command(change.value)});
  case SliderChange::Kind::kRefused:
    return sink.emit(action::Say{change.text});
  }
}

} // namespace oversketch
