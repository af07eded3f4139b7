#include "ui/panels/history_panel.h"

#include "ui/widgets/section.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// So many steps are seen at once, as many as there is room for in the panel; the list scrolls beyond.
constexpr float kLeastRows = 5, kMostRows = 30;
constexpr float kHistoryRow = 24;
/// Of the section around the steps: its title, and the space below.
constexpr float kHistoryTitle = 38, kBelowSteps = 22;

void draw_step(const HistoryModel& model, std::size_t index, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const std::string id = "history." + std::to_string(index);
  const IdScope scope(id);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + std::max(1.0F, ImGui::GetContentRegionAvail().x), at.y + look.px(kHistoryRow));
  const bool present = index == model.cursor, undone = index > model.cursor;
  if (ImGui::InvisibleButton("##step", ImVec2(end.x - at.x, end.y - at.y)) && !present)
    context.sink.emit(action::Jump{index});
  const bool hovered = ImGui::IsItemHovered();
  if (present || hovered)
    ImGui::GetWindowDrawList()->AddRectFilled(at, end, present ? look.selected : mixed(look.panel, look.raised, 0.6F),
                                              look.px(4));
  draw_text(ImVec2(at.x + look.px(8), at.y), ImVec2(end.x - look.px(8), end.y),
            undone ? faded(look.ink_quiet, 0.7F) : look.ink, model.labels[index]);
  finish_item(context, id,
              {present  ? model.labels[index] + ". This is what is shown."
               : undone ? model.labels[index] + ". Click does the steps up to here again."
                        : model.labels[index] + ". Click goes back to this step.",
               {}});
  ImGui::SetCursorScreenPos(ImVec2(at.x, end.y));
}

} // namespace

HistoryModel make_history_model(const Snapshot& snapshot) {
  return {snapshot.history, snapshot.cursor};
}

float least_history_height(const HistoryModel& model, const HistoryPanelState& state, const ThemeLook& look) {
  if (!state.open || model.labels.empty()) return look.px(kHistoryTitle);
  const float rows = std::min(static_cast<float>(model.labels.size()), kLeastRows);
  return look.px(kHistoryTitle + kBelowSteps) + look.px(kHistoryRow) * rows;
}

void draw_history_panel(const HistoryModel& model, HistoryPanelState& state, const DrawContext& context) {
  const std::string summary = model.labels.empty() ? std::string() : std::to_string(model.labels.size() - 1);
  const Section section(context, "panel.history", "History", summary,
                        "Every step since the document was opened. Click one to go there.");
  state.open = section.open();
  if (!section.open() || model.labels.empty()) return;
  const float row = context.look.px(kHistoryRow);
  const float room = (ImGui::GetContentRegionAvail().y - context.look.px(kBelowSteps)) / row;
  const float rows = std::min(static_cast<float>(model.labels.size()), std::clamp(room, 1.0F, kMostRows));
  ImGui::BeginChild("##steps", ImVec2(0, std::floor(row * rows)));
  // A new step, or one that was jumped to, is brought into sight, also in a list of another height; after that the hand
  // scrolls.
  if (state.shown_cursor != model.cursor || state.shown_count != model.labels.size() || state.shown_rows != rows) {
    const float middle = row * (static_cast<float>(model.cursor) - rows / 2 + 0.5F);
    ImGui::SetScrollY(std::max(0.0F, middle));
    state.shown_cursor = model.cursor;
    state.shown_count = model.labels.size();
    state.shown_rows = rows;
  }
  const float top = ImGui::GetCursorScreenPos().y;
  const float x = ImGui::GetCursorScreenPos().x;
  const auto first = static_cast<std::size_t>(std::max(0.0F, ImGui::GetScrollY() / row));
  const std::size_t last = std::min(model.labels.size(), first + static_cast<std::size_t>(rows) + 3);
  for (std::size_t i = first; i < last; ++i) {
    ImGui::SetCursorScreenPos(ImVec2(x, top + row * static_cast<float>(i)));
    draw_step(model, i, context);
  }
  ImGui::SetCursorScreenPos(ImVec2(x, top + row * static_cast<float>(model.labels.size())));
  ImGui::Dummy(ImVec2(1, 0));
  ImGui::EndChild();
}

} // namespace oversketch
