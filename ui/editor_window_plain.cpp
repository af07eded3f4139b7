// The window until its panels are there: the pictures side by side, and what the status bar would say.
#include "ui/editor_window.h"

#include <imgui.h>

namespace oversketch {

struct WindowState::Parts {};
WindowState::WindowState(std::function<void()>, std::unique_ptr<SystemDialog>) : parts_(std::make_unique<Parts>()) {}
WindowState::~WindowState() = default;

namespace {

void draw_side(const EditorState& state, Pictures& pictures, Side side, ImVec2 corner, ImVec2 end,
               const DrawContext& context) {
  const Tab& tab = *state.tab();
  context.reply.canvases.at(side) = WidgetMap::Box{corner.x, corner.y, end.x - corner.x, end.y - corner.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, end, context.look.canvas);
  const View& view = tab.view.canvas(side).view;
  const auto snapshot = tab.session->snapshot();
  if (side == Side::kTarget) return pictures.draw_result(list, *tab.session, view, corner, end);
  for (const LayerSnapshot& layer : snapshot->layers)
    if (layer.id == snapshot->document.selected) pictures.draw(list, layer.source, view, corner, end);
}

} // namespace

void draw_editor_window(const EditorState& state, WindowState&, Pictures& pictures, const InputEvents&,
                        const DrawContext& context) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
  context.widgets.add("window", {0, 0, size.x, size.y});
  if (const Tab* tab = state.tab()) {
    const float bar = context.look.px(30), split = size.x * static_cast<float>(tab->view.split);
    draw_side(state, pictures, Side::kSource, {0, bar}, {split, size.y - bar}, context);
    draw_side(state, pictures, Side::kTarget, {split + 4, bar}, {size.x, size.y - bar}, context);
  }
  if (context.now_s < state.said_until) ImGui::TextUnformatted(state.said.c_str());
  ImGui::End();
}

} // namespace oversketch
