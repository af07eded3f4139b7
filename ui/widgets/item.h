#pragma once

#include "ui/widgets/draw_context.h"
#include "ui/widgets/imgui_compat.h"

#include <imgui.h>

#include <string>
#include <string_view>

namespace oversketch {

/// What a widget says of itself in plain words, and the keys that do the same.
struct Tip {
  std::string text;
  std::string keys = {};
};

/// Seconds for which the pointer rests on a widget before its tip appears.
inline constexpr double kTipDelay_s = 0.5;

/// To be called right after a widget's ImGui item: puts the part of it that is seen into the widget map and shows its
/// tip when the pointer has rested on it.  What is scrolled or clipped away is not registered.
void finish_item(const DrawContext& context, std::string_view id, const Tip& tip);

/// Shows the tip when the pointer has rested on something for a while.
/// @param hovered  the pointer is on it, and no button down.
void tip_at_rest(const DrawContext& context, std::string_view id, bool hovered, const Tip& tip);

/// To be called right before a text field, which is typed into from then on; nothing that is typed meanwhile is lost.
void give_keys_to_next_field(const DrawContext& context);

/// As finish_item() for a box that is no item: a panel, a picture.  Without a tip.
void register_box(const DrawContext& context, std::string_view id, ImVec2 corner, ImVec2 end);

/// Measures that all panels share, screen pixels.
struct Measures {
  float row = 0;
  float gap = 0;
  float label = 0;
};
/// @param width  of the panel's content, screen pixels.
Measures measures_of(const ThemeLook& look, float width);

/// The text as far as it fits, with an ellipsis where it does not.
std::string elided(std::string_view text, float width);

/// Draws text in the middle of the box's height: at its left, its middle or its right (0, 0.5, 1), elided to its width.
void draw_text(ImVec2 corner, ImVec2 end, PackedColor color, std::string_view text, float align = 0);

/// The colour `part` of the way to the other one.
PackedColor mixed(PackedColor color, PackedColor other, float part);

/// Screen pixels.
struct RowBox {
  ImVec2 corner;
  ImVec2 end;
  /// Of the row: where its label begins.
  float left = 0;
  float width() const { return end.x - corner.x; }
  float height() const { return end.y - corner.y; }
};
/// A row with its label at the left; gives back the box at the right, where the control goes.  The cursor stays at the
/// box's corner.
RowBox begin_row(const DrawContext& context, std::string_view label);
/// Moves the cursor to the next row.
void end_row(const DrawContext& context, const RowBox& box);

/// Whether a menu or another popup is open.
bool is_popup_open();

/// Within an open menu or popup: Esc closes it, which Dear ImGui does only while its own navigation is on.
void close_popup_on_escape();

/// A line of quiet text that wraps at the panel's width.
void draw_note(const DrawContext& context, std::string_view text);

/// An ImGui id for a scope.
class IdScope {
public:
  explicit IdScope(std::string_view id) { ImGui::PushID(id.data(), id.data() + id.size()); }
  ~IdScope() { ImGui::PopID(); }
  IdScope(const IdScope&) = delete;
  IdScope& operator=(const IdScope&) = delete;
};
/// Null keeps the font there is.
class FontScope {
public:
  explicit FontScope(ImFont* font) : pushed_(font != nullptr) {
    if (pushed_) compat::push_font(font);
  }
  ~FontScope() {
    if (pushed_) ImGui::PopFont();
  }
  FontScope(const FontScope&) = delete;
  FontScope& operator=(const FontScope&) = delete;

private:
  bool pushed_;
};
/// What is drawn in it is pale and takes no clicks.
class DisabledScope {
public:
  explicit DisabledScope(bool disabled) { ImGui::BeginDisabled(disabled); }
  ~DisabledScope() { ImGui::EndDisabled(); }
  DisabledScope(const DisabledScope&) = delete;
  DisabledScope& operator=(const DisabledScope&) = delete;
};

} // namespace oversketch
