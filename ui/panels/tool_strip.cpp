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

/// Where the next button goes.
class StripCursor {
public:
  StripCursor(const Area& area, int columns, float side, const ThemeLook& look)
      : look_(look), columns_(columns), side_(side), y_(ImGui::GetCursorScreenPos().y + look.px(9)) {
    const float pitch = look.px(side + 6);
    const float used = pitch * static_cast<float>(columns) - look.px(6);
    x_ = area.low.x + (area.width() - used) / 2;
  }
  ButtonLook place(bool on = false) {
    const float pitch = look_.px(side_ + 6);
    ImGui::SetCursorScreenPos(ImVec2(x_ + pitch * static_cast<float>(column_), y_));
    if (++column_ == columns_) {
      column_ = 0;
      y_ += pitch;
    }
    return {.on = on, .quiet = true, .width = side_, .height = side_, .large = true};
  }
  /// A gap between groups; one column alone has the room.
  void skip() { y_ += columns_ == 1 ? look_.px(side_ * 0.55F) : 0; }
  void finish() {
    ImGui::SetCursorScreenPos(ImVec2(x_, y_ + (column_ > 0 ? look_.px(side_) : 0)));
    ImGui::Dummy(ImVec2(1, look_.px(4)));
  }

private:
  const ThemeLook& look_;
  int columns_;
  float side_;
  float x_ = 0;
  float y_;
  int column_ = 0;
};

void draw_tools(const EntryContext& entries, StripCursor& cursor, const DrawContext& context) {
  for (const ToolRow& row : tool_rows()) {
    const Entry& entry = entry_of("tool." + std::string(row.id));
    const ButtonLook button = cursor.place(entries.state.tool == row.tool);
    const Tip tip{std::string(entry.label) + ": " + std::string(entry.help), keys_of(entry) + ", held: for that long"};
    if (draw_icon_button(context, entry.id, icon_of(row.tool), tip, button)) entry.act(entries);
  }
}

void draw_overlays_button(const EntryContext& entries, const Area& area, StripCursor& cursor,
                          const DrawContext& context) {
  const bool shown = entries.state.overlays.shown;
  const Tip tip{"What is drawn over the pictures. Tab hides and shows all of it.", "Tab, Ctrl+H"};
  if (draw_icon_button(context, "strip.overlays", shown ? icon::kEye : icon::kEyeOff, tip, cursor.place()))
    ImGui::OpenPopup("##overlays");
  place_beside(ImVec2(area.high.x, ImGui::GetItemRectMin().y), context);
  if (!ImGui::BeginPopup("##overlays")) return;
  close_popup_on_escape();
  const Entry& all = entry_of("view.overlays");
  if (ImGui::MenuItem("All overlays", "Tab", shown)) all.act(entries);
  finish_item(context, "strip.overlays.all", {std::string(all.help), keys_of(all)});
  ImGui::Separator();
  draw_overlay_entries(entries, "strip.overlays", context);
  ImGui::EndPopup();
}

void draw_compare_button(const EntryContext& entries, const Area& area, StripCursor& cursor,
                         const DrawContext& context) {
  const Tab* tab = entries.state.tab();
  const bool compares = tab != nullptr && tab->view.compare != LiveSession::Compare::kOff;
  const Tip tip{"Compares the result with another method, a plain paste, or the target alone.",
                "\\ held: the target without the layer"};
  if (draw_icon_button(context, "strip.compare", icon::kCompare, tip, cursor.place(compares)))
    ImGui::OpenPopup("##compare");
  place_beside(ImVec2(area.high.x, ImGui::GetItemRectMin().y), context);
  if (!ImGui::BeginPopup("##compare")) return;
  close_popup_on_escape();
  draw_compare_popup(entries, context);
  ImGui::EndPopup();
}

/// Where the panel is not there of itself.
void draw_side_button(const EntryContext& entries, StripCursor& cursor, const DrawContext& context) {
  if (!entries.flags.narrow && entries.flags.side_panel) return;
  const Entry& entry = entry_of("view.side_panel");
  const ButtonLook button = cursor.place(entries.flags.side_shown());
  if (draw_icon_button(context, "strip.side_panel", icon::kColumns,
                       {std::string(entry.label) + ": " + std::string(entry.help), keys_of(entry)}, button))
    entry.act(entries);
}

} // namespace

void draw_tool_strip(const EntryContext& entries, const Area& area, int columns, const DrawContext& context) {
  const float room = area.height() / context.look.scale - 16, width = area.width() / context.look.scale;
  // Eight buttons and a gap fit; smaller ones before the strip has to scroll.
  const float rows = columns == 2 ? 4.6F : 8.7F;
  const float fits = std::min(width / static_cast<float>(columns) - 8, room / rows - 5);
  StripCursor cursor(area, columns, std::clamp(fits, 24.0F, 38.0F), context.look);
  draw_tools(entries, cursor, context);
  cursor.skip();
  draw_overlays_button(entries, area, cursor, context);
  draw_compare_button(entries, area, cursor, context);
  draw_side_button(entries, cursor, context);
  cursor.finish();
}

} // namespace oversketch
