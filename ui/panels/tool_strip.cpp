#include "ui/panels/tool_strip.h"

#include "ui/panels/menu_bar.h"
#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"
#include "ui/widgets/slider.h"

#include <algorithm>

namespace oversketch {
namespace {

const char* icon_of(Tool tool) {
  switch (tool) {
  case Tool::kOutline:
    return icon::kOutline;
  case Tool::kSketch:
    return icon::kSketch;
  case Tool::kPin:
    return icon::kPin;
  case Tool::kMove:
    return icon::kMove;
  case Tool::kPan:
    return icon::kPan;
  }
  return icon::kHelp;
}

void place_beside(ImVec2 corner, const DrawContext& context) {
  ImGui::SetNextWindowPos(ImVec2(corner.x + context.look.px(8), corner.y), ImGuiCond_Appearing);
}

void draw_compare_popup(const EntryContext& entries, const DrawContext& context) {
  draw_compare_entries(entries, "strip.compare", context);
  const Tab* tab = entries.state.tab();
  if (tab == nullptr || tab->view.compare == LiveSession::Compare::kOff) return;
  ImGui::Separator();
  const SliderSpec spec{.low = 0, .high = 1, .least = 0, .most = 1, .initial = 0.5, .factor = 100, .unit = "%"};
  ImGui::Dummy(ImVec2(context.look.px(230), 0));
  const SliderChange change = draw_slider(context, "compare.split", "From",
                                          {"Where the comparison begins, from the canvas's left edge, %. "
                                           "Its line on the canvas can be dragged too."},
                                          tab->view.compare_split, spec);
  using Kind = SliderChange::Kind;
  if (change.kind == Kind::kPreview || change.kind == Kind::kSet || change.kind == Kind::kCommit)
    entries.sink.emit(action::SetCompare{tab->view.compare, change.value});
  ImGui::Dummy(ImVec2(0, 0));
}

} // namespace

void draw_tool_strip(const EntryContext& entries, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  // Seven buttons and a gap; smaller ones before the strip has to scroll.
  const float room = area.height() / look.scale - 16;
  const float side = std::clamp(std::min(area.width() / look.scale - 12, room / 8.2F - 5), 26.0F, 38.0F);
  const float x = area.low.x + (area.width() - look.px(side)) / 2, pitch = look.px(side + 6);
  float y = ImGui::GetCursorScreenPos().y + look.px(9);
  const auto place = [&] {
    ImGui::SetCursorScreenPos(ImVec2(x, y));
    y += pitch;
  };
  const ButtonLook still{.quiet = true, .width = side, .height = side, .large = true};

  for (const ToolRow& row : tool_rows()) {
    const Entry& entry = entry_of("tool." + std::string(row.id));
    ButtonLook button = still;
    button.on = entries.state.tool == row.tool;
    place();
    if (draw_icon_button(
            context, entry.id, icon_of(row.tool),
            {std::string(entry.label) + ": " + std::string(entry.help), keys_of(entry) + ", held: for that long"},
            button))
      entry.act(entries);
  }

  y += look.px(side * 0.55F);
  ButtonLook overlays = still;
  place();
  if (draw_icon_button(context, "strip.overlays", entries.state.overlays.shown ? icon::kEye : icon::kEyeOff,
                       {"What is drawn over the pictures. Tab hides and shows all of it.", "Tab, Ctrl+H"}, overlays))
    ImGui::OpenPopup("##overlays");
  place_beside(ImVec2(area.high.x, ImGui::GetItemRectMin().y), context);
  if (ImGui::BeginPopup("##overlays")) {
    const Entry& all = entry_of("view.overlays");
    if (ImGui::MenuItem("All overlays", "Tab", entries.state.overlays.shown)) all.act(entries);
    finish_item(context, "strip.overlays.all", {std::string(all.help), keys_of(all)});
    ImGui::Separator();
    draw_overlay_entries(entries, "strip.overlays", context);
    ImGui::EndPopup();
  }

  ButtonLook compare = still;
  compare.on = entries.state.tab() != nullptr && entries.state.tab()->view.compare != LiveSession::Compare::kOff;
  place();
  if (draw_icon_button(context, "strip.compare", icon::kCompare,
                       {"Compares the result with another method, a plain paste, or the target alone.",
                        "\\ held: the target without the layer"},
                       compare))
    ImGui::OpenPopup("##compare");
  place_beside(ImVec2(area.high.x, ImGui::GetItemRectMin().y), context);
  if (ImGui::BeginPopup("##compare")) {
    draw_compare_popup(entries, context);
    ImGui::EndPopup();
  }

  const Entry& panel = entry_of("view.side_panel");
  if (entries.flags.narrow || !entries.flags.side_panel) {
    ButtonLook button = still;
    button.on = entries.flags.side_shown();
    place();
    if (draw_icon_button(context, "strip.side_panel", icon::kColumns, {std::string(panel.help), keys_of(panel)},
                         button))
      panel.act(entries);
  }
  ImGui::SetCursorScreenPos(ImVec2(x, y));
  ImGui::Dummy(ImVec2(1, look.px(4)));
}

} // namespace oversketch
