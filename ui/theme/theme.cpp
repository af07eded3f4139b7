#include "ui/theme/theme.h"

#include <imgui.h>

#include <algorithm>

namespace oversketch {
namespace {

constexpr PackedColor rgb(std::uint32_t hex, std::uint32_t alpha = 255) {
  return alpha << 24 | (hex & 0xff) << 16 | (hex & 0xff00) | hex >> 16;
}

void set_dark(ThemeLook& look) {
  look.window = rgb(0x202227);
  look.panel = rgb(0x26282d);
  look.raised = rgb(0x33363d);
  look.sunken = rgb(0x1f2126);
  look.line = rgb(0x15161a);
  look.canvas = rgb(0x131417);
  look.hovered = rgb(0x3d4149);
  look.filled = rgb(0x46536b);
  look.selected = rgb(0x34415a);
  look.ink = rgb(0xe3e5e8);
  look.ink_quiet = rgb(0x8d929b);
  look.accent = rgb(0x3972d6);
  look.accent_ink = rgb(0xffffff);
  look.plot = rgb(0x7aa7f5);
}

void set_light(ThemeLook& look) {
  look.window = rgb(0xe3e4e7);
  look.panel = rgb(0xf3f4f5);
  look.raised = rgb(0xe0e2e6);
  look.sunken = rgb(0xe8e9ec);
  look.line = rgb(0xcfd1d6);
  look.canvas = rgb(0xc4c6ca);
  look.hovered = rgb(0xd3d6dc);
  look.filled = rgb(0xb3c6e8);
  look.selected = rgb(0xcddcf5);
  look.ink = rgb(0x23262b);
  look.ink_quiet = rgb(0x5b6069);
  look.accent = rgb(0x2f6bd0);
  look.accent_ink = rgb(0xffffff);
  look.plot = rgb(0x2f6bd0);
}

void set_measures(ImGuiStyle& style, const ThemeLook& look) {
  const float s = look.scale;
  style.WindowPadding = {12 * s, 10 * s};
  style.FramePadding = {8 * s, 4 * s};
  style.CellPadding = {4 * s, 2 * s};
  style.ItemSpacing = {8 * s, 6 * s};
  style.ItemInnerSpacing = {6 * s, 4 * s};
  style.IndentSpacing = 16 * s;
  style.ScrollbarSize = 11 * s;
  style.GrabMinSize = 10 * s;
  style.WindowRounding = style.ChildRounding = 0;
  style.PopupRounding = 6 * s;
  style.FrameRounding = style.GrabRounding = 4 * s;
  style.ScrollbarRounding = 6 * s;
  style.TabRounding = 0;
  style.WindowBorderSize = style.ChildBorderSize = style.FrameBorderSize = style.TabBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowTitleAlign = {0.5f, 0.5f};
  style.DisabledAlpha = 0.45f;
  style.MouseCursorScale = s;
}

} // namespace

PackedColor faded(PackedColor color, float alpha) {
  const float opacity = static_cast<float>(color >> 24) * std::clamp(alpha, 0.0f, 1.0f);
  return (color & 0xffffffu) | static_cast<std::uint32_t>(opacity + 0.5f) << 24;
}

ThemeLook make_look(Theme theme, float scale) {
  ThemeLook look;
  look.theme = theme;
  look.scale = scale;
  if (theme == Theme::kDark)
    set_dark(look);
  else
    set_light(look);
  look.warning = rgb(0xe8a33d);
  look.danger = rgb(0xe5534b);
  look.curve = rgb(0xffffff);
  look.curve_halo = rgb(0x1b2a4a, 230);
  look.stroke = rgb(0xffab40);
  look.ghost = rgb(0xffab40, 170);
  return look;
}

void apply_style(const ThemeLook& look) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_measures(style, look);
  const auto set = [&](ImGuiCol which, PackedColor color) {
    style.Colors[which] = ImGui::ColorConvertU32ToFloat4(color);
  };
  const PackedColor clear = 0;
  for (const ImGuiCol which : {ImGuiCol_Text, ImGuiCol_CheckMark})
    set(which, look.ink);
  for (const ImGuiCol which : {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_MenuBarBg, ImGuiCol_TitleBg,
                               ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed})
    set(which, look.panel);
  for (const ImGuiCol which : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_TableHeaderBg})
    set(which, look.raised);
  for (const ImGuiCol which : {ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive, ImGuiCol_ButtonHovered,
                               ImGuiCol_HeaderHovered, ImGuiCol_ScrollbarGrabHovered, ImGuiCol_SeparatorHovered})
    set(which, look.hovered);
  for (const ImGuiCol which : {ImGuiCol_Header, ImGuiCol_HeaderActive, ImGuiCol_TextSelectedBg})
    set(which, look.selected);
  for (const ImGuiCol which : {ImGuiCol_ButtonActive, ImGuiCol_SliderGrab})
    set(which, look.filled);
  for (const ImGuiCol which : {ImGuiCol_SliderGrabActive, ImGuiCol_NavHighlight, ImGuiCol_DragDropTarget,
                               ImGuiCol_PlotHistogram, ImGuiCol_PlotHistogramHovered, ImGuiCol_SeparatorActive,
                               ImGuiCol_PlotLinesHovered, ImGuiCol_ScrollbarGrabActive})
    set(which, look.accent);
  for (const ImGuiCol which :
       {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderStrong, ImGuiCol_TableBorderLight})
    set(which, look.line);
  for (const ImGuiCol which :
       {ImGuiCol_ChildBg, ImGuiCol_BorderShadow, ImGuiCol_ScrollbarBg, ImGuiCol_TableRowBg, ImGuiCol_ResizeGrip})
    set(which, clear);
  set(ImGuiCol_TextDisabled, look.ink_quiet);
  set(ImGuiCol_PlotLines, look.plot);
  set(ImGuiCol_ScrollbarGrab, look.raised);
  set(ImGuiCol_ResizeGripHovered, look.hovered);
  set(ImGuiCol_ResizeGripActive, look.accent);
  set(ImGuiCol_Tab, look.window);
  set(ImGuiCol_TabHovered, look.hovered);
  set(ImGuiCol_TabActive, look.panel);
  set(ImGuiCol_TabUnfocused, look.window);
  set(ImGuiCol_TabUnfocusedActive, look.panel);
  set(ImGuiCol_TableRowBgAlt, faded(look.raised, 0.3f));
  set(ImGuiCol_ModalWindowDimBg, rgb(0x000000, look.theme == Theme::kDark ? 130 : 70));
  set(ImGuiCol_NavWindowingDimBg, rgb(0x000000, 90));
}

} // namespace oversketch
