#include "ui/panels/recovery_bar.h"

#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"

namespace oversketch {

RecoveryBarModel make_recovery_bar_model(const EditorState& state, bool beside_work) {
  RecoveryBarModel model;
  if (!beside_work || state.recovered_left || state.recovered.empty()) return model;
  model.documents = state.recovered.size();
  model.text = "Not saved when the program last ended: ";
  for (std::size_t i = 0; i < state.recovered.size(); ++i)
    model.text += (i == 0 ? "" : ", ") + state.recovered[i].name + " (" + state.recovered[i].when + ")";
  return model;
}

void draw_recovery_bar(const RecoveryBarModel& model, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(area.low, area.high, mixed(look.panel, look.accent, 0.18F));
  list->AddRectFilled(ImVec2(area.low.x, area.high.y - look.px(1)), area.high, look.line);
  register_box(context, "panel.recovery", area.low, area.high);
  const float height = look.px(24), top = area.low.y + (area.height() - height) / 2;
  float right = area.high.x - look.px(8);
  const auto button = [&](const char* id, const char* label, const Tip& tip, float width, bool on) {
    right -= look.px(width);
    ImGui::SetCursorScreenPos(ImVec2(right, top));
    const bool clicked = draw_button(context, id, label, tip, {.on = on, .width = width, .height = 24});
    right -= look.px(6);
    return clicked;
  };
  if (button("recovery.later", "Later", {"Kept for a week, and offered again at the next start.", {}}, 60, false))
    context.sink.emit(action::LeaveRecovered{});
  if (button("recovery.take", "Continue",
             {"Opens it in a tab, as it was before the program ended: pictures and history.", {}}, 80, true))
    for (std::size_t i = 0; i < model.documents; ++i)
      context.sink.emit(action::Recover{0});
  draw_text(ImVec2(area.low.x + look.px(14), area.low.y), ImVec2(right - look.px(8), area.high.y), look.ink,
            model.text);
}

} // namespace oversketch
