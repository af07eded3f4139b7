#include "ui/panels/side_panel.h"

#include "ui/panels/blend_panel.h"
#include "ui/panels/tool_panel.h"
#include "ui/widgets/section.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oversketch {

namespace {

void draw_settings_of_layer(const SidePanelScene& scene, const DrawContext& context) {
  const Snapshot& snapshot = *scene.snapshot;
  WindowState::Parts& parts = scene.parts;
  draw_layers_panel(make_layers_model(snapshot), parts.layers, scene.entries, scene.pictures, context);
  draw_tool_panel(make_tool_model(scene.state, snapshot), scene.entries, context);
  draw_deform_panel(make_deform_model(snapshot), parts.deform, scene.state.tab()->session.get(), scene.pictures,
                    context);
  draw_blend_panel(make_blend_model(snapshot), context);
}

/// Sections one below the other that scroll where they do not fit.
/// @returns the height that they need.
template <class Draw>
float draw_scrolled(const char* name, const Area& area, const DrawContext& context, const Draw& draw) {
  const float pad = context.look.px(kPanelPad);
  ImGui::SetCursorScreenPos(ImVec2(area.low.x + pad, area.low.y));
  // The scroll bar stands in the right margin.
  ImGui::SetNextWindowContentSize(ImVec2(std::max(1.0F, area.width() - 2 * pad), 0));
  ImGui::BeginChild(name, ImVec2(area.width() - pad, std::max(1.0F, area.height())));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(context.look.px(8), context.look.px(4)));
  draw();
  ImGui::PopStyleVar();
  const float needed = ImGui::GetCursorPosY();
  ImGui::EndChild();
  return needed;
}

/// The history stands below the other sections, and at the bottom of the panel when these are too long: the present
/// step is always seen.
void draw_sections(const SidePanelScene& scene, const Area& area, const DrawContext& context) {
  WindowState::Parts& parts = scene.parts;
  const HistoryModel history = make_history_model(*scene.snapshot);
  const float least = std::min(least_history_height(history, parts.history, context.look), area.height() / 2);
  const float edge = area.low.y + std::floor(std::min(parts.sections_height, area.height() - least));
  const float needed = draw_scrolled("##sections", {area.low, ImVec2(area.high.x, edge)}, context,
                                     [&] { draw_settings_of_layer(scene, context); });
  if (needed > edge - area.low.y)
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(area.low.x, edge), ImVec2(area.high.x, edge + context.look.px(1)),
                                              context.look.line);
  if (std::exchange(parts.sections_height, needed) != needed) context.reply.ask_frame_at(context.now_s);
  draw_scrolled("##history", {ImVec2(area.low.x, edge), area.high}, context,
                [&] { draw_history_panel(history, parts.history, context); });
}

} // namespace

void draw_side_panel(const SidePanelScene& scene, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  // A child of its own: over narrow canvases it must lie on top of theirs.
  ImGui::SetCursorScreenPos(area.low);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::BeginChild("##side", ImVec2(area.width(), area.height()), false, ImGuiWindowFlags_NoScrollbar);
  // Its ground by hand: Dear ImGui may put a child's into its parent, below the canvases that it lies over.
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, area.high, look.panel);
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, ImVec2(area.low.x + look.px(1), area.high.y), look.line);
  if (scene.snapshot != nullptr)
    draw_sections(scene, area, context);
  else
    draw_scrolled("##sections", area, context, [&] { draw_note(context, "\nNothing is open."); });
  ImGui::EndChild();
  ImGui::PopStyleVar();
  register_box(context, "panel.side", area.low, area.high);
}

} // namespace oversketch
