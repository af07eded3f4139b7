#pragma once

#include "ui/panels/panel_parts.h"
#include "ui/theme/theme.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oversketch::testing {

/// Draws nothing; a texture's name is not null, so that pictures are laid out.
class NoPictures : public Pictures {
public:
  ImTextureID small(const std::shared_ptr<const Raster<Rgba8>>&) override { return compat::to_texture_id(1); }
  void draw(ImDrawList&, const ShownPicture&, const View&, ImVec2, ImVec2) override {}
  void draw_result(ImDrawList&, const LiveSession&, const View&, ImVec2, ImVec2) override {}
  void update_result(LiveSession&) override {}
};

/// A Dear ImGui context without graphics hardware, a hand that moves its mouse and types, and what was asked for.
class Headless : public ::testing::Test {
protected:
  explicit Headless(ImVec2 size = ImVec2(400, 900), float scale = 1) : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = size;
    io.DeltaTime = 1.0F / 60;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.MousePos = ImVec2(-1, -1);
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
#if IMGUI_VERSION_NUM < 18700
    for (const ImGuiKey key : {ImGuiKey_Escape, ImGuiKey_Enter, ImGuiKey_Tab, ImGuiKey_Backspace, ImGuiKey_Space,
                               ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow, ImGuiKey_DownArrow})
      io.KeyMap[key] = static_cast<int>(key) + 1;
#endif
    look_ = make_look(Theme::kDark, scale);
    apply_style(look_);
  }
  ~Headless() override {
    ImGui::DestroyContext(context_);
  }

  /// What is drawn in each frame: within a window of the display's size, or as it is.
  void show(std::function<void(const DrawContext&)> draw, bool bare = false) {
    draw_ = std::move(draw);
    bare_ = bare;
    frame();
    frame();
  }

  void frame(double seconds = 1.0 / 60) {
    now_s_ += seconds;
    ImGui::GetIO().DeltaTime = static_cast<float>(seconds);
    compat::prepare_keys();
    ImGui::NewFrame();
    widgets_.clear();
    reply_ = {};
    const DrawContext context{look_, widgets_, sink_, reply_, now_s_};
    if (bare_) {
      draw_(context);
    } else {
      ImGui::SetNextWindowPos(ImVec2(0, 0));
      ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
      ImGui::Begin("##test", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
      draw_(context);
      ImGui::End();
    }
    ImGui::Render();
    events.clear();
  }

  void move_to(ImVec2 at) {
    ImGui::GetIO().MousePos = at;
    frame();
  }
  void set_button(bool down, int button = 0) {
    ImGui::GetIO().MouseDown[button] = down;
    frame();
  }
  /// A place in a widget, by shares of its width and height.
  ImVec2 at(std::string_view id, float x = 0.5F, float y = 0.5F) const {
    const auto found = widgets_.boxes().find(id);
    if (found == widgets_.boxes().end()) {
      ADD_FAILURE() << "no widget " << id << "; there are: " << names();
      return ImVec2(-1, -1);
    }
    const WidgetMap::Box& box = found->second;
    return ImVec2(box.x + x * box.w, box.y + y * box.h);
  }
  bool has(std::string_view id) const {
    return widgets_.boxes().contains(id);
  }
  std::string names() const {
    std::string all;
    for (const auto& [name, box] : widgets_.boxes())
      all += name + " ";
    return all;
  }

  void click(std::string_view id, float x = 0.5F, float y = 0.5F) {
    click_at(at(id, x, y));
  }
  void click_at(ImVec2 place, int button = 0) {
    move_to(place);
    set_button(true, button);
    set_button(false, button);
  }
  /// Far enough from the last click that it is none of a double click.
  void wait(double seconds = 1) {
    frame(seconds);
  }
  void double_click(std::string_view id) {
    wait();
    click(id);
    click(id);
  }
  void drag(std::string_view id, float from, float to) {
    const ImVec2 end = at(id, to);
    move_to(at(id, from));
    set_button(true);
    move_to(end);
    set_button(false);
  }
  void type(const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    frame();
  }
  void press(ImGuiKey key, int frames = 1) {
    set_key(key, true);
    for (int i = 0; i < frames; ++i)
      frame();
    set_key(key, false);
    frame();
  }
  void hold_ctrl(bool down) {
#if IMGUI_VERSION_NUM < 18700
    ImGui::GetIO().KeyCtrl = down;
#else
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, down);
#endif
  }

  std::vector<Action> take() {
    return sink_.take();
  }
  /// The actions of that kind, in order; the others are dropped.
  template <class A>
  std::vector<A> take_all() {
    std::vector<A> all;
    for (const Action& action : sink_.take())
      if (const A* one = std::get_if<A>(&action)) all.push_back(*one);
    return all;
  }
  template <class A>
  A take_one() {
    const auto all = take_all<A>();
    EXPECT_EQ(all.size(), 1U);
    return all.empty() ? A{} : all.front();
  }
  /// The one command that was executed, of that kind.
  template <class C>
  C take_command() {
    const auto executed = take_one<action::Execute>();
    const C* command = std::get_if<C>(&executed.command);
    EXPECT_NE(command, nullptr);
    return command == nullptr ? C{} : *command;
  }

  /// Every widget that is no panel says what it is for.
  void expect_tips() const {
    for (const auto& [name, box] : widgets_.boxes()) {
      if (name.starts_with("panel.") && !name.ends_with(".title")) continue;
      EXPECT_TRUE(widgets_.tips().contains(name)) << name << " has no tip";
      EXPECT_GT(box.w, 0) << name;
      EXPECT_GT(box.h, 0) << name;
    }
  }

  static InputEvent key_event(Key key, Modifiers modifiers = {}, InputEvent::Kind kind = InputEvent::Kind::kKeyDown) {
    InputEvent event;
    event.kind = kind;
    event.key = key;
    event.modifiers = modifiers;
    return event;
  }

  /// What happened since the last frame; gone after the next.
  InputEvents events;
  NoPictures pictures;
  ThemeLook look_;
  WidgetMap widgets_;
  ActionSink sink_;
  FrameReply reply_;
  double now_s_ = 0;

private:
  static void set_key(ImGuiKey key, bool down) {
#if IMGUI_VERSION_NUM < 18700
    ImGui::GetIO().KeysDown[ImGui::GetIO().KeyMap[key]] = down;
#else
    ImGui::GetIO().AddKeyEvent(key, down);
#endif
  }

  ImGuiContext* context_;
  std::function<void(const DrawContext&)> draw_;
  bool bare_ = false;
};

} // namespace oversketch::testing
