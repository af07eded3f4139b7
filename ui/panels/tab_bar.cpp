#include "ui/panels/tab_bar.h"

#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

constexpr float kLeastTab = 70, kMostTab = 220;

std::string shown_name(const TabRow& tab) {
  return tab.name + (tab.modified ? " *" : "");
}

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
            front || over ? look.ink : look.ink_quiet, shown_name(tab));
}

void draw_tab_list(const TabBarModel& model, const DrawContext& context) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (draw_icon_button(context, "tab.list", icon::kArrowDown, {"All that is open.", {}}, {.quiet = true}))
    ImGui::OpenPopup("##list");
  ImGui::SetNextWindowPos(ImVec2(at.x, at.y + context.look.px(27)));
  if (!ImGui::BeginPopup("##list")) return;
  close_popup_on_escape();
  for (std::size_t i = 0; i < model.tabs.size(); ++i) {
    const TabRow& tab = model.tabs[i];
    const std::string id = "tab.list." + std::to_string(i);
    const IdScope scope(id);
    if (ImGui::Selectable((shown_name(tab) + "##tab").c_str(), i == model.front))
      context.sink.emit(action::SelectTab{i});
    finish_item(context, id, {tab.tip});
  }
  ImGui::EndPopup();
}

/// What a tab's tip says: its whole name, for the tab may show less, and where it is.
std::string tip_of(const Tab& tab, bool modified) {
  if (tab.path.empty()) return tab.name + (modified ? "\nNot saved yet" : "");
  return tab.path.string() + (tab.read_only ? ": can only be saved under another name" : "");
}

} // namespace

TabBarModel make_tab_bar_model(const EditorState& state) {
  TabBarModel model;
  model.front = state.front;
  for (const Tab& tab : state.tabs) {
    const bool modified = tab.session != nullptr && tab.session->snapshot()->modified;
    model.tabs.push_back({tab.name + (tab.read_only ? " (read only)" : ""), tip_of(tab, modified), modified});
  }
  return model;
}

TabRun scroll_tabs(TabBarState& state, std::size_t tabs, std::size_t front, std::size_t room, float wheel) {
  const std::size_t count = std::min(tabs, std::max<std::size_t>(room, 1));
  if (count == 0) return {};
  const auto shown = static_cast<float>(count), at = static_cast<float>(front);
  float first = state.first - wheel;
  if (state.front != front || state.tabs != tabs || state.room != room)
    first = std::clamp(state.first, at - shown + 1, at);
  first = std::clamp(first, 0.0F, static_cast<float>(tabs - count));
  state = {first, front, tabs, room};
  return {static_cast<std::size_t>(std::lround(first)), count};
}

void draw_tab_bar(const TabBarModel& model, TabBarState& state, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, area.high, look.window);
  const float button = look.px(24), gap = look.px(5);
  const auto fitting = [&](float width) {
    return static_cast<std::size_t>(std::max(1.0F, width / look.px(kLeastTab)));
  };
  float avail = std::max(1.0F, area.width() - button - 2 * gap);
  const bool crowded = fitting(avail) < model.tabs.size();
  if (crowded) avail = std::max(1.0F, avail - button);
  const float wheel = ImGui::IsWindowHovered() ? ImGui::GetIO().MouseWheel + ImGui::GetIO().MouseWheelH : 0;
  const TabRun run = scroll_tabs(state, model.tabs.size(), model.front, fitting(avail), wheel);
  const float most = run.count == 0 ? 0 : avail / static_cast<float>(run.count);
  float x = area.low.x;
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
    const float natural = ImGui::CalcTextSize((model.tabs[i].name + " *").c_str()).x + look.px(46);
    const float width = std::min({natural, look.px(kMostTab), most});
    draw_tab(model.tabs[i], i, i == model.front, ImVec2(x, area.low.y), ImVec2(x + width, area.high.y), context);
    x += width;
  }
  const float top = area.low.y + (area.height() - button) / 2;
  ImGui::SetCursorScreenPos(ImVec2(x + gap, top));
  if (draw_icon_button(context, "tab.open", icon::kPlus,
                       {"Opens a picture, a project or a script in a new tab.", "Ctrl+O"}, {.quiet = true}))
    context.sink.emit(action::Open{});
  if (crowded) {
    ImGui::SetCursorScreenPos(ImVec2(x + gap + button, top));
    draw_tab_list(model, context);
  }
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(area.low.x, area.high.y - look.px(1)), area.high, look.line);
}

} // namespace oversketch
