#include "ui/widgets/section.h"

#include "ui/theme/icons.h"

#include <algorithm>

namespace oversketch {
namespace {

/// Whether what is drawn is unfolded, after a click on it.  Nothing refers into Dear ImGui's storage afterwards: that
/// moves when the next item keeps something in it.
bool read_switch(bool at_first, bool clicked) {
  int& open = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("##open"), at_first ? 1 : 0);
  if (clicked) open = 1 - open;
  return open != 0;
}

} // namespace

Section::Section(const DrawContext& context, std::string_view id, std::string_view title, std::string_view summary,
                 std::string_view tip, bool open_at_first)
    : context_(context), id_(id) {
  const ThemeLook& look = context.look;
  ImGui::PushID(id_.c_str());
  corner_ = ImGui::GetCursorScreenPos();
  width_ = std::max(1.0F, ImGui::GetContentRegionAvail().x);
  const float height = look.px(38);
  const bool clicked = ImGui::InvisibleButton("##title", ImVec2(width_, height));
  open_ = read_switch(open_at_first, clicked);
  const bool hovered = ImGui::IsItemHovered();
  finish_item(context, id_ + ".title", {std::string(tip), "Click folds and unfolds it"});

  const ImVec2 end(corner_.x + width_, corner_.y + height);
  float used = 0;
  {
    const FontScope bold(look.bold);
    used = ImGui::CalcTextSize(title.data(), title.data() + title.size()).x;
    draw_text(corner_, end, hovered || open_ ? look.ink : look.ink_quiet, title);
  }
  draw_text(ImVec2(corner_.x + used + look.px(12), corner_.y), end, look.ink_quiet, summary, 1);
  ImGui::SetCursorScreenPos(ImVec2(corner_.x, open_ ? end.y : end.y - look.px(4)));
}

Section::~Section() {
  const ThemeLook& look = context_.look;
  ImGui::Dummy(ImVec2(width_, look.px(open_ ? 9 : 3)));
  const ImVec2 end(corner_.x + width_, ImGui::GetItemRectMax().y);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 low = list->GetClipRectMin(), high = list->GetClipRectMax();
  const float pad = look.px(kPanelPad);
  list->PushClipRect(ImVec2(corner_.x - pad, low.y), ImVec2(end.x + pad, high.y), false);
  list->AddRectFilled(ImVec2(corner_.x - pad, end.y), ImVec2(end.x + pad, end.y + look.px(1)), look.line);
  list->PopClipRect();
  ImGui::SetCursorScreenPos(ImVec2(corner_.x, end.y + look.px(1)));
  const ImVec2 shown_low(corner_.x - pad, std::max(corner_.y, low.y)), shown_high(end.x + pad, std::min(end.y, high.y));
  if (shown_high.y > shown_low.y) register_box(context_, id_, shown_low, shown_high);
  ImGui::PopID();
}

bool draw_more(const DrawContext& context, std::string_view id, const Tip& tip, bool forced) {
  const IdScope scope(id);
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + std::max(1.0F, ImGui::GetContentRegionAvail().x), at.y + look.px(20));
  const bool clicked = ImGui::InvisibleButton("##more", ImVec2(end.x - at.x, end.y - at.y));
  const bool open = read_switch(false, clicked && !forced) || forced;
  const PackedColor ink = ImGui::IsItemHovered() ? look.ink : look.ink_quiet;
  finish_item(context, id, tip);
  draw_text(at, end, ink, open ? icon::kCaretDown : icon::kCaretRight);
  draw_text(ImVec2(at.x + look.px(14), at.y), end, ink, "More");
  ImGui::SetCursorScreenPos(ImVec2(at.x, end.y + (open ? look.px(2) : 0)));
  return open;
}

} // namespace oversketch
