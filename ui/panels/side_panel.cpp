#include "ui/panels/side_panel.h"

#include "ui/widgets/section.h"

#include <algorithm>

namespace oversketch {

void draw_side_panel(const SidePanelScene& scene, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  (void)scene;
  // A child of its own: over narrow canvases it must lie on top of theirs.
  ImGui::SetCursorScreenPos(area.low);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, look.panel);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::BeginChild("##side", ImVec2(area.width(), area.height()), false, ImGuiWindowFlags_NoScrollbar);
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, ImVec2(area.low.x + look.px(1), area.high.y), look.line);
  const float pad = look.px(kPanelPad);
  ImGui::SetCursorScreenPos(ImVec2(area.low.x + pad, area.low.y));
  // The scroll bar stands in the right margin.
  ImGui::SetNextWindowContentSize(ImVec2(std::max(1.0F, area.width() - 2 * pad), 0));
  ImGui::BeginChild("##sections", ImVec2(area.width() - pad, area.height()));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(look.px(8), look.px(4)));
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  register_box(context, "panel.side", area.low, area.high);
}

} // namespace oversketch
