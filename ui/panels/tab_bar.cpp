#include "ui/panels/tab_bar.h"

#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"

#include <algorithm>

namespace oversketch {
namespace {

constexpr float kLeastTab = 70, kMostTab = 220;

void draw_tab(const TabRow& tab, std::size_t index, bool front, ImVec2 corner, ImVec2 end, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const std::string id = "tab." + std::to_string(index);
  const IdScope scope(id);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool over =
      ImGui::IsWindowHovered() && mouse.x >= corner.x && mouse.x < end.x && mouse.y >= corner.y && mouse.y < end.y;
  if (front || over) list->AddRectFilled(corner, end, front ? look.panel : mixed(look.window, look.panel, 0.6F));
  list->AddRectFilled(ImVec2(end.x - look.px(1), corner.y), end, look.line);

  // The close button comes first, so that it takes the pointer from the tab that lies under it.
  const float side = look.px(18), right = end.x - look.px(6);
  const bool closable = front || over;
  if (closable) {
    ImGui::SetCursorScreenPos(ImVec2(right - side, corner.y + (end.y - corner.y - side) / 2));
    if (draw_icon_button(context, id + ".close", icon::kClose,
                         {"Closes the document; asks when it is not saved.", front ? "Ctrl+W" : ""},
                         {.quiet = true, .width = 18, .height = 18}))
      context.sink.emit(action::CloseTab{index});
  }
  ImGui::SetCursorScreenPos(corner);
  const bool clicked = ImGui::InvisibleButton("##tab", ImVec2(end.x - corner.x, end.y - corner.y));
  if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Middle))
    context.sink.emit(action::CloseTab{index});
  else if (clicked && !front)
    context.sink.emit(action::SelectTab{index});
  finish_item(context, id, {tab.tip});
  draw_text(ImVec2(corner.x + look.px(14), corner.y), ImVec2(closable ? right - side : right, end.y),
            front || over ? look.ink : look.ink_quiet, tab.name + (tab.modified ? " *" : ""));
}

} // namespace

TabBarModel make_tab_bar_model(const EditorState& state) {
  TabBarModel model;
  model.front = state.front;
  for (const Tab& tab : state.tabs)
    model.tabs.push_back({tab.name + (tab.read_only ? " (read only)" : ""),
                          tab.path.empty() ? "Not saved yet"
                          : tab.read_only  ? tab.path.string() + ": can only be saved under another name"
                                           : tab.path.string(),
                          tab.session != nullptr && tab.session->snapshot()->modified});
  return model;
}

TabRun run_of_tabs(std::size_t tabs, std::size_t front, std::size_t room) {
  const std::size_t count = std::min(tabs, std::max<std::size_t>(room, 1));
  const std::size_t first = front < count ? 0 : std::min(front + 1, tabs) - count;
  return {first, count};
}

void draw_tab_bar(const TabBarModel& model, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, area.high, look.window);
  const float plus = look.px(34), avail = std::max(1.0F, area.width() - plus);
  const TabRun run =
      run_of_tabs(model.tabs.size(), model.front, static_cast<std::size_t>(std::max(1.0F, avail / look.px(kLeastTab))));
  const float most = run.count == 0 ? 0 : avail / static_cast<float>(run.count);
  float x = area.low.x;
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
    const std::string shown = model.tabs[i].name + " *";
    const float natural = ImGui::CalcTextSize(shown.c_str()).x + look.px(46);
    const float width = std::min({natural, look.px(kMostTab), most});
    draw_tab(model.tabs[i], i, i == model.front, ImVec2(x, area.low.y), ImVec2(x + width, area.high.y), context);
    x += width;
  }
  ImGui::SetCursorScreenPos(ImVec2(x + look.px(5), area.low.y + (area.height() - look.px(24)) / 2));
  if (draw_icon_button(context, "tab.open", icon::kPlus,
                       {"Opens a picture, a project or a script in a new tab.", "Ctrl+O"}, {.quiet = true}))
    context.sink.emit(action::Open{});
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(area.low.x, area.high.y - look.px(1)), area.high, look.line);
}

} // namespace oversketch
