#pragma once

// Dear ImGui 1.86, 1.90 and 1.92 under one set of names: what moved between them, and nothing else.

#include <imgui.h>
#include <imgui_internal.h>

#include <cstdint>

namespace oversketch::compat {

/// A texture's name on the graphics hardware as Dear ImGui passes it about: a pointer until 1.91.4, a number since.
inline ImTextureID to_texture_id(std::uint32_t texture) {
#if IMGUI_VERSION_NUM < 19140
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)); // NOLINT: what the backend expects
#else
  return static_cast<ImTextureID>(texture);
#endif
}

/// A font at the size it was loaded with; ended by ImGui::PopFont().
inline void push_font(ImFont* font) {
#if IMGUI_VERSION_NUM < 19200
  ImGui::PushFont(font);
#else
  ImGui::PushFont(font, font->LegacySize);
#endif
}

/// The size a font was loaded with, screen pixels.
inline float font_size(const ImFont* font) {
#if IMGUI_VERSION_NUM < 19200
  return font->FontSize;
#else
  return font->LegacySize;
#endif
}

/// A button that shows a picture; `id` names it.
inline bool image_button(const char* id, ImTextureID texture, ImVec2 size, ImVec2 uv0 = {0, 0}, ImVec2 uv1 = {1, 1}) {
#if IMGUI_VERSION_NUM < 18900
  ImGui::PushID(id);
  const bool pressed = ImGui::ImageButton(texture, size, uv0, uv1);
  ImGui::PopID();
  return pressed;
#else
  return ImGui::ImageButton(id, texture, size, uv0, uv1);
#endif
}

/// Later items may lie over an item and are asked first: the one is called before the item, the other after it.
inline void before_overlapped_item() {
#if IMGUI_VERSION_NUM >= 18970
  ImGui::SetNextItemAllowOverlap();
#endif
}
inline void after_overlapped_item() {
#if IMGUI_VERSION_NUM < 18970
  ImGui::SetItemAllowOverlap();
#endif
}

/// Between the two, entries of a menu or popup leave it open when they are clicked: for switches.
inline void begin_switches() {
#if IMGUI_VERSION_NUM < 19100
  ImGui::PushItemFlag(ImGuiItemFlags_SelectableDontClosePopup, true);
#else
  ImGui::PushItemFlag(ImGuiItemFlags_AutoClosePopups, false);
#endif
}
inline void end_switches() {
  ImGui::PopItemFlag();
}

/// In the next frame the arrow keys move among the items of a menu or popup, and Enter chooses; or they do not.
inline void let_keys_move(bool yes) {
  ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
  flags = yes ? flags | ImGuiConfigFlags_NavEnableKeyboard : flags & ~ImGuiConfigFlags_NavEnableKeyboard;
}
/// Whether a menu is open that no frame has drawn yet.
inline bool is_menu_coming() {
  const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
  return open.Size > 0 && open.back().Window == nullptr;
}
/// To be called before a frame begins, after the backend's own part: in Dear ImGui 1.86 Enter opens fields alone, and
/// Esc follows the null pointer that a menu has for a window until it is drawn.  One that the pointer opened in a menu
/// that Esc closed never is: it would keep the keyboard from everything else.
inline void prepare_keys() {
#if IMGUI_VERSION_NUM < 18700
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  while (is_menu_coming() && context.OpenPopupStack.back().OpenFrameCount + 1 < context.FrameCount)
    ImGui::ClosePopupToLevel(context.OpenPopupStack.Size - 1, false);
  if (is_menu_coming()) let_keys_move(false);
  ImGuiIO& io = ImGui::GetIO();
  const int enter = io.KeyMap[ImGuiKey_Enter];
  const bool down = (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) != 0 && enter >= 0 && io.KeysDown[enter];
  io.NavInputs[ImGuiNavInput_Activate] = down ? 1.0F : 0.0F;
#endif
}
/// Whether an arrow key asks in this frame to move that way, and nothing has taken it yet.
inline bool wants_key_move(ImGuiDir way) {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return context.NavMoveSubmitted && context.NavMoveDir == way;
}
/// What an arrow key would have moved in this frame stays where it is.
inline void drop_key_move() {
  ImGui::NavMoveRequestCancel();
}
/// Where the keys are is shown although none has moved yet.
inline void show_keyboard_cursor() {
#if IMGUI_VERSION_NUM < 19100
  ImGui::GetCurrentContext()->NavDisableHighlight = false;
#elif IMGUI_VERSION_NUM >= 19140
  ImGui::SetNavCursorVisible(true);
#endif
}

/// Whether a key went down in this frame, for keys that Dear ImGui 1.86 has names for.
inline bool is_key_pressed(ImGuiKey key, bool repeat = true) {
#if IMGUI_VERSION_NUM < 18700
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
#else
  return ImGui::IsKeyPressed(key, repeat);
#endif
}

} // namespace oversketch::compat
