#include "ui/widgets/item.h"

#include "core/base/text.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// The time since when the pointer has rested on the last item; negative while it does not.  Kept by ImGui, by window
/// and id.
float rest_since(const DrawContext& context, std::string_view id, bool hovered) {
  const IdScope scope(id);
  float& since = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("##rest"), -1.0F);
  if (!hovered)
    since = -1;
  else if (since < 0)
    since = static_cast<float>(context.now_s);
  return since;
}

/// Whether it is time for a tip; otherwise asks for a frame when it will be.
bool has_rested(const DrawContext& context, std::string_view id, bool hovered, const Tip& tip) {
  const float since = rest_since(context, id, hovered);
  if (since < 0 || tip.text.empty()) return false;
  const bool rested = context.now_s - since >= kTipDelay_s - 1e-3;
  if (!rested) context.reply.ask_frame_at(since + kTipDelay_s);
  return rested;
}

/// @param corner  where; null is at the pointer.
void show_tip(const DrawContext& context, const Tip& tip, const ImVec2* corner) {
  if (corner != nullptr) ImGui::SetNextWindowPos(*corner);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(context.look.px(10), context.look.px(7)));
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(context.look.px(300));
  ImGui::TextUnformatted(tip.text.data(), tip.text.data() + tip.text.size());
  ImGui::PopTextWrapPos();
  if (!tip.keys.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, context.look.ink_quiet);
    ImGui::TextUnformatted(tip.keys.data(), tip.keys.data() + tip.keys.size());
    ImGui::PopStyleColor();
  }
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

} // namespace

void register_box(const DrawContext& context, std::string_view id, ImVec2 corner, ImVec2 end) {
  context.widgets.add(id, {corner.x, corner.y, end.x - corner.x, end.y - corner.y});
}

void give_keys_to_next_field(const DrawContext& context) {
  ImGui::SetKeyboardFocusHere();
  context.reply.field_awaits_keys = true;
}

void finish_item(const DrawContext& context, std::string_view id, const Tip& tip) {
  const ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 clip_low = list->GetClipRectMin(), clip_high = list->GetClipRectMax();
  const float x = std::max(low.x, clip_low.x), y = std::max(low.y, clip_low.y);
  const float w = std::min(high.x, clip_high.x) - x, h = std::min(high.y, clip_high.y) - y;
  if (w <= 0 || h <= 0) return;
  context.widgets.add(id, {x, y, w, h}, tip.text);

  const bool busy = ImGui::IsMouseDown(0) || ImGui::IsItemActive();
  const bool hovered = !busy && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled);
  // Where the keyboard goes, what its keys reach next stays in sight: beside the menu, not over it.
  const bool by_keys = hovered && !ImGui::IsMouseHoveringRect(low, high);
  const ImVec2 beside(ImGui::GetWindowPos().x + ImGui::GetWindowWidth() + context.look.px(6), low.y);
  if (has_rested(context, id, hovered, tip)) show_tip(context, tip, by_keys ? &beside : nullptr);
}

void tip_at_rest(const DrawContext& context, std::string_view id, bool hovered, const Tip& tip) {
  if (has_rested(context, id, hovered, tip)) show_tip(context, tip, nullptr);
}

Measures measures_of(const ThemeLook& look, float width) {
  return {look.px(24), look.px(4), std::min(look.px(112), std::floor(width * 0.42F))};
}

std::string elided(std::string_view text, float width) {
  const auto measure = [](std::string_view part) {
    return ImGui::CalcTextSize(part.data(), part.data() + part.size()).x;
  };
  // No letter has more than four bytes or is narrower than a pixel: what is beyond is not even measured.
  const std::size_t most = 4 * static_cast<std::size_t>(std::max(0.0F, width)) + 4;
  if (text.size() <= most && measure(text) <= width) return std::string(text);
  const std::string_view dots = "…";
  const float room = width - measure(dots);
  // The most bytes that fit.
  std::size_t keep = 0, beyond = std::min(text.size(), most) + 1;
  while (keep + 1 < beyond) {
    const std::size_t middle = (keep + beyond) / 2;
    (measure(text.substr(0, middle)) <= room ? keep : beyond) = middle;
  }
  const std::string_view head = head_of(text, keep);
  return head.empty() ? std::string() : std::string(head) + std::string(dots);
}

void draw_text(ImVec2 corner, ImVec2 end, PackedColor color, std::string_view text, float align) {
  const std::string shown = elided(text, end.x - corner.x);
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  const ImVec2 at(std::floor(corner.x + align * (end.x - corner.x - size.x)),
                  std::floor(corner.y + (end.y - corner.y - size.y) / 2));
  ImGui::GetWindowDrawList()->AddText(at, faded(color, ImGui::GetStyle().Alpha), shown.c_str());
}

PackedColor mixed(PackedColor color, PackedColor other, float part) {
  PackedColor result = 0;
  for (const int shift : {0, 8, 16, 24}) {
    const auto a = static_cast<float>(color >> shift & 0xFF), b = static_cast<float>(other >> shift & 0xFF);
    result |= static_cast<PackedColor>(std::lround(a + (b - a) * part)) << shift;
  }
  return result;
}

RowBox begin_row(const DrawContext& context, std::string_view label) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const Measures m = measures_of(context.look, width);
  const float left = label.empty() ? 0 : m.label;
  draw_text(at, ImVec2(at.x + left - m.gap, at.y + m.row), context.look.ink_quiet, label);
  const RowBox box{ImVec2(at.x + left, at.y), ImVec2(at.x + std::max(width, left + 1), at.y + m.row), at.x};
  ImGui::SetCursorScreenPos(box.corner);
  return box;
}

void end_row(const DrawContext& context, const RowBox& box) {
  ImGui::SetCursorScreenPos(ImVec2(box.left, box.end.y + context.look.px(4)));
}

bool is_popup_open() {
  return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void close_popup_on_escape() {
  if (compat::is_key_pressed(ImGuiKey_Escape, false)) ImGui::CloseCurrentPopup();
}

void draw_note(const DrawContext& context, std::string_view text) {
  ImGui::PushStyleColor(ImGuiCol_Text, context.look.ink_quiet);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

} // namespace oversketch
