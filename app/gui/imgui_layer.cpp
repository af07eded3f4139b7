#include "app/gui/imgui_layer.h"

#include "ui/render/screen.h"
#include "ui/theme/fonts.h"
#include "ui/widgets/imgui_compat.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cfloat>

namespace oversketch::gui {

ImGuiLayer::ImGuiLayer(Window& window) : window_(window) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  // A blinking caret would draw a frame twice a second for nothing else.
  io.ConfigInputTextCursorBlink = false;
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  ImGui_ImplGlfw_InitForOpenGL(window_.handle(), false);
  ImGui_ImplOpenGL3_Init("#version 330");
}

ImGuiLayer::~ImGuiLayer() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

Result<void> ImGuiLayer::set_look(Theme theme, float scale, const std::filesystem::path& assets) {
  const bool same_fonts = look_.text != nullptr && look_.scale == scale;
  if (same_fonts && look_.theme == theme) return {};
  ThemeLook look = make_look(theme, scale);
  if (same_fonts) {
    look.text = look_.text;
    look.bold = look_.bold;
    look.icons_large = look_.icons_large;
  } else {
    if (auto loaded = load_fonts(look, assets); !loaded) return loaded;
#if IMGUI_VERSION_NUM < 19200
    // Made anew when the next frame begins.
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
#endif
  }
  look_ = look;
  apply_style(look_);
  return {};
}

void ImGuiLayer::forward(const RawEvent& event) {
  GLFWwindow* handle = window_.handle();
  switch (event.kind) {
  case RawEvent::Kind::kMove:
    inside_ = true;
#if IMGUI_VERSION_NUM >= 18700
    ImGui_ImplGlfw_CursorPosCallback(handle, event.event.position.x, event.event.position.y);
#endif
    break;
  case RawEvent::Kind::kButton:
    buttons_[static_cast<std::size_t>(event.code)] = event.is_down();
    ImGui_ImplGlfw_MouseButtonCallback(handle, event.code, event.action, event.mods);
    break;
  case RawEvent::Kind::kWheel:
    ImGui_ImplGlfw_ScrollCallback(handle, event.event.scroll.x, event.event.scroll.y);
    break;
  case RawEvent::Kind::kKey:
    ImGui_ImplGlfw_KeyCallback(handle, event.code, event.scancode, event.action, event.mods);
    break;
  case RawEvent::Kind::kText:
    ImGui_ImplGlfw_CharCallback(handle, static_cast<unsigned>(event.code));
    break;
  case RawEvent::Kind::kEnter:
    inside_ = event.is_down();
    ImGui_ImplGlfw_CursorEnterCallback(handle, event.action);
    break;
  case RawEvent::Kind::kFocus:
    buttons_ = {};
    ImGui_ImplGlfw_WindowFocusCallback(handle, event.action);
    break;
  }
  pointer_ = event.event.position;
}

/// Dear ImGui 1.86's backend asks the system where the pointer is by now: put right to where it was in this batch.
void ImGuiLayer::set_pointer() {
#if IMGUI_VERSION_NUM < 18700
  ImGuiIO& io = ImGui::GetIO();
  bool any_down = false;
  for (std::size_t i = 0; i < buttons_.size(); ++i) {
    io.MouseDown[i] = buttons_[i];
    any_down |= buttons_[i];
  }
  io.MousePos = {static_cast<float>(pointer_.x), static_cast<float>(pointer_.y)};
  if (!inside_ && !any_down) io.MousePos = {-FLT_MAX, -FLT_MAX};
#endif
}

void ImGuiLayer::begin_frame(const std::vector<RawEvent>& batch) {
  for (const RawEvent& event : batch)
    forward(event);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  set_pointer();
  compat::prepare_keys();
  ImGui::NewFrame();
}

CursorShape ImGuiLayer::cursor() const {
  switch (ImGui::GetMouseCursor()) {
  case ImGuiMouseCursor_TextInput:
    return CursorShape::kText;
  case ImGuiMouseCursor_ResizeAll:
    return CursorShape::kMove;
  case ImGuiMouseCursor_ResizeNS:
    return CursorShape::kResizeNs;
  case ImGuiMouseCursor_ResizeEW:
    return CursorShape::kResizeEw;
  case ImGuiMouseCursor_ResizeNESW:
    return CursorShape::kResizeNesw;
  case ImGuiMouseCursor_ResizeNWSE:
    return CursorShape::kResizeNwse;
  case ImGuiMouseCursor_Hand:
    return CursorShape::kHand;
  case ImGuiMouseCursor_None:
    return CursorShape::kNone;
  default:
    return CursorShape::kArrow;
  }
}

void ImGuiLayer::paint() const {
  const WindowSize size = window_.picture_size();
  clear_screen(look_.window, size.width, size.height);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void ImGuiLayer::drop_frame() {
  ImGui::EndFrame();
}

void ImGuiLayer::end_frame() {
  ImGui::Render();
  paint();
  window_.show_picture();
}

Raster<Rgba8> ImGuiLayer::read_last_frame() const {
  paint();
  const WindowSize size = window_.picture_size();
  return read_screen(size.width, size.height);
}

} // namespace oversketch::gui
