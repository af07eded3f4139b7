#include "ui/panels/empty_state.h"

#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"

#include <algorithm>

namespace oversketch {
namespace {

constexpr std::size_t kMostRecentShown = 6;

void draw_heading(const DrawContext& context, std::string_view text) {
  const FontScope bold(context.look.bold);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

void draw_paragraph(const DrawContext& context, std::string_view text, float width) {
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  ImGui::PushStyleColor(ImGuiCol_Text, context.look.ink_quiet);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
}

void draw_recovered(const EmptyStateModel& model, float width, const DrawContext& context) {
  if (model.recovered.empty()) return;
  draw_heading(context, "Recovered work");
  for (std::size_t i = 0; i < model.recovered.size(); ++i) {
    const RecoveredWork& work = model.recovered[i];
    const std::string id = "empty.recovered." + std::to_string(i);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw_text(at, ImVec2(at.x + width - context.look.px(170), at.y + context.look.px(26)), context.look.ink,
              work.name + " · " + work.when + " · " + std::to_string(work.steps) +
                  (work.steps == 1 ? " step" : " steps"));
    ImGui::SetCursorScreenPos(ImVec2(at.x + width - context.look.px(160), at.y));
    if (draw_button(context, id + ".take", "Continue", {"Opens it as it was before the program ended.", {}},
                    {.on = true, .width = 80}))
      context.sink.emit(action::Recover{i});
    ImGui::SetCursorScreenPos(ImVec2(at.x + width - context.look.px(75), at.y));
    if (draw_button(context, id + ".discard", "Discard", {"Throws it away for good.", {}}, {.width = 75}))
      context.sink.emit(action::DiscardRecovered{i});
    ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + context.look.px(32)));
  }
  ImGui::Dummy(ImVec2(1, context.look.px(10)));
}

void draw_recent(const EmptyStateModel& model, float width, const DrawContext& context) {
  if (model.recent.empty()) return;
  draw_heading(context, "Recent");
  const ThemeLook& look = context.look;
  for (std::size_t i = 0; i < std::min(model.recent.size(), kMostRecentShown); ++i) {
    const std::string id = "empty.recent." + std::to_string(i);
    const IdScope scope(id);
    const ImVec2 at = ImGui::GetCursorScreenPos(), end(at.x + width, at.y + look.px(26));
    if (ImGui::InvisibleButton("##recent", ImVec2(width, look.px(26))))
      context.sink.emit(action::Open{model.recent[i]});
    if (ImGui::IsItemHovered()) ImGui::GetWindowDrawList()->AddRectFilled(at, end, look.raised, look.px(4));
    finish_item(context, id, {"Opens " + model.recent[i].string(), {}});
    const std::string name = model.recent[i].filename().string();
    const float used = std::min(ImGui::CalcTextSize(name.c_str()).x, width * 0.6F);
    draw_text(ImVec2(at.x + look.px(8), at.y), ImVec2(at.x + width * 0.65F, end.y), look.ink, name);
    draw_text(ImVec2(at.x + used + look.px(22), at.y), ImVec2(end.x - look.px(8), end.y), look.ink_quiet,
              model.recent[i].parent_path().string(), 1);
    ImGui::SetCursorScreenPos(ImVec2(at.x, end.y + look.px(1)));
  }
  ImGui::Dummy(ImVec2(1, 1));
}

} // namespace

EmptyStateModel make_empty_state_model(const EditorState& state) {
  return {state.recovered, state.preferences.recent_files};
}

void draw_empty_state(const EmptyStateModel& model, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const float width = std::min(look.px(460), area.width() - look.px(32));
  if (width < look.px(60)) return;
  const auto recent = static_cast<float>(std::min(model.recent.size(), kMostRecentShown));
  const auto recovered = static_cast<float>(model.recovered.size());
  const float height = look.px(210 + (recent > 0 ? 40 + 27 * recent : 0) + (recovered > 0 ? 50 + 32 * recovered : 0));
  const float x = area.low.x + (area.width() - width) / 2;
  ImGui::SetCursorScreenPos(ImVec2(x, area.low.y + std::max(look.px(16), (area.height() - height) / 2)));
  ImGui::BeginGroup();
  draw_recovered(model, width, context);
  draw_heading(context, "Put part of one photograph into another");
  ImGui::Dummy(ImVec2(1, look.px(2)));
  draw_paragraph(
      context,
      "Open the picture that something goes into, or drop it here. Add the picture it comes from as a source, "
      "draw round the part, and sketch the outline it shall have.",
      width);
  ImGui::Dummy(ImVec2(1, look.px(8)));
  if (draw_button(context, "empty.open", "Open…", {"A picture to paste into, a project or a script.", "Ctrl+O"},
                  {.on = true, .width = 96, .height = 30}))
    context.sink.emit(action::Open{});
  ImGui::SameLine(0, look.px(8));
  if (draw_button(context, "empty.sample", "Try the sample", {"A puffer fish in the sea, ready to be drawn over.", {}},
                  {.width = 130, .height = 30}))
    context.sink.emit(action::OpenSample{});
  ImGui::Dummy(ImVec2(1, look.px(16)));
  draw_recent(model, width, context);
  ImGui::EndGroup();
  register_box(context, "panel.empty", ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}

} // namespace oversketch
