#include "ui/panels/side_panel.h"

#include "ui/panels/blend_panel.h"
#include "ui/panels/tool_panel.h"
#include "ui/widgets/section.h"

#include <algorithm>

namespace oversketch {

namespace {

void draw_sections(const SidePanelScene& scene, const DrawContext& context) {
  if (scene.snapshot == nullptr) return draw_note(context, "\nNothing is open.");
  const Snapshot& snapshot = *scene.snapshot;
  WindowState::Parts& parts = scene.parts;
  draw_layers_panel(make_layers_model(snapshot), parts.layers, scene.entries, scene.pictures, context);
  draw_tool_panel(make_tool_model(scene.state, snapshot), scene.entries, context);
  draw_deform_panel(make_deform_model(snapshot), parts.deform, scene.state.tab()->session.get(), scene.pictures,
                    context);
  draw_blend_panel(make_blend_model(snapshot), context);
  draw_history_panel(make_history_model(snapshot), parts.history, context);
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
  const float pad = look.px(kPanelPad);
  ImGui::SetCursorScreenPos(ImVec2(area.low.x + pad, area.low.y));
  // The scroll bar stands in the right margin.
  ImGui::SetNextWindowContentSize(ImVec2(std::max(1.0F, area.width() - 2 * pad), 0));
  ImGui::BeginChild("##sections", ImVec2(area.width() - pad, area.height()));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(look.px(8), look.px(4)));
  draw_sections(scene, context);
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  register_box(context, "panel.side", area.low, area.high);
}

} // namespace oversketch
