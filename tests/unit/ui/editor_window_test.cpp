#include "ui/editor_window.h"

#include "tests/support/documents.h"
#include "tests/unit/ui/headless.h"
#include "ui/panels/window_parts.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace oversketch {
namespace {

using testing::Headless;

/// The whole window, over a real session.
class WholeWindow : public Headless {
protected:
  WholeWindow() : Headless(ImVec2(1600, 1000)) {}

  void open_document() {
    Tab tab;
    tab.name = "sea";
    tab.session = std::make_unique<LiveSession>();
    tab.session->execute(testing::new_document(200, 150));
    tab.session->execute(LayerAdd{testing::loaded_ref("fish.png", testing::wavy_image(90, 80, 1)), "fish"});
    tab.session->execute(RegionSet{{}, testing::blob({45, 40}, 25)});
    tab.session->wait_until_idle();
    state.tabs.push_back(std::move(tab));
  }
  void show_window() {
    show([this](const DrawContext& context) { draw_editor_window(state, window, pictures, events, context); }, true);
    frame();
  }
  static bool changes_something(const std::vector<Action>& actions) {
    return std::ranges::any_of(actions, [](const Action& a) {
      return std::holds_alternative<action::Execute>(a) || std::holds_alternative<action::PickTool>(a);
    });
  }
  static bool comes_of_looking(const Action& action) {
    return std::holds_alternative<action::WantAlternatives>(action) || std::holds_alternative<action::SetView>(action);
  }
  EditorState state;
  WindowState window;
};

TEST_F(WholeWindow, HasEveryPartAtEverySize) {
  open_document();
  for (const ImVec2 size : {ImVec2(1600, 1000), ImVec2(1024, 700), ImVec2(3840, 2160), ImVec2(320, 240)}) {
    ImGui::GetIO().DisplaySize = size;
    show_window();
    frame();
    for (const char* id : {"menu.file", "menu.help", "panel.tools", "tool.outline", "canvas.target", "tab.0"})
      EXPECT_TRUE(has(id)) << id << " at " << size.x << " × " << size.y;
    for (const auto& [name, box] : widgets_.boxes()) {
      EXPECT_GE(box.x, -0.5F) << name;
      EXPECT_GE(box.y, -0.5F) << name;
      EXPECT_LE(box.x + box.w, size.x + 0.5F) << name << " at " << size.x;
      EXPECT_LE(box.y + box.h, size.y + 0.5F) << name << " at " << size.y;
    }
  }
}

TEST_F(WholeWindow, ShowsThePresentStepHoweverFullTheSidePanelIs) {
  open_document();
  LiveSession& session = *state.tabs[0].session;
  for (int i = 0; i < 20; ++i)
    session.execute(LayerRename{{}, "name " + std::to_string(i)});
  session.wait_until_idle();
  for (const ImVec2 size : {ImVec2(1600, 1000), ImVec2(1600, 700), ImVec2(1024, 560)}) {
    ImGui::GetIO().DisplaySize = size;
    window.parts().flags.side_panel = window.parts().flags.side_over = true;
    for (int step = 0; step < 3; ++step) {
      // The last step, one before it, and that with more above the list.
      if (step == 1) session.undo(9);
      if (step == 2 && has("blend.more")) click("blend.more");
      session.wait_until_idle();
      show_window();
      frame();
      const std::string present = "history." + std::to_string(session.snapshot()->cursor);
      ASSERT_TRUE(has(present)) << size.y << " " << step;
      EXPECT_NEAR(widgets_.boxes().find(present)->second.h, look_.px(24), 1) << size.y << " " << step;
    }
    session.redo(9);
  }
}

TEST_F(WholeWindow, EveryWidgetHasATip) {
  open_document();
  show_window();
  for (const auto& [name, box] : widgets_.boxes()) {
    const bool place = (name.starts_with("panel.") && !name.ends_with(".title") && !name.ends_with(".edge")) ||
                       name.starts_with("canvas.");
    EXPECT_EQ(widgets_.tips().contains(name), !place) << name;
  }
  for (const char* panel : {"panel.layers", "panel.tool", "panel.deformation", "panel.blending", "panel.history"})
    EXPECT_TRUE(has(panel)) << panel;
}

TEST_F(WholeWindow, IsEmptyWithoutADocument) {
  show_window();
  EXPECT_TRUE(has("empty.open"));
  EXPECT_FALSE(has("canvas.target"));
  EXPECT_FALSE(has("tab.0"));
  click("empty.sample");
  take_one<action::OpenSample>();
}

TEST_F(WholeWindow, SmallWindowsShowTheSidePanelWhenAsked) {
  open_document();
  ImGui::GetIO().DisplaySize = ImVec2(320, 240);
  show_window();
  EXPECT_FALSE(has("panel.layers"));
  events = {key_event(Key::kF4)};
  frame();
  frame();
  EXPECT_TRUE(has("panel.layers"));
  events = {key_event(Key::kF4)};
  frame();
  frame();
  EXPECT_FALSE(has("panel.layers"));
}

TEST_F(WholeWindow, KeysReachTheirActions) {
  open_document();
  show_window();
  take();
  events = {key_event(key_of('Z'), {.ctrl = true}), key_event(key_of('E'), {.shift = true, .ctrl = true})};
  frame();
  const auto actions = take();
  EXPECT_EQ(std::ranges::count_if(actions, [](const Action& a) { return std::holds_alternative<action::Undo>(a); }), 1);
  EXPECT_EQ(std::ranges::count_if(actions, [](const Action& a) { return std::holds_alternative<action::Export>(a); }),
            1);
}

TEST_F(WholeWindow, DialogsTakeTheKeyboardAndTheMouse) {
  open_document();
  state.question = Question{"Really?", "It is lost.", {{"yes", "Yes", {}, true}}};
  show_window();
  frame();
  take();
  events = {key_event(key_of('Z'), {.ctrl = true})};
  frame();
  EXPECT_TRUE(take_all<action::Undo>().empty());
  state.tool = Tool::kMove;
  events = {key_event(key_of('P')), key_event(Key::kRight), key_event(Key::kRight, {}, InputEvent::Kind::kKeyUp)};
  frame();
  EXPECT_FALSE(changes_something(take())) << "no tool is picked, nothing nudged behind it";
  click("tool.pin");
  EXPECT_TRUE(take_all<action::PickTool>().empty()) << "it lies under the dialog";
  click("question.yes");
  take_one<action::Dismiss>();
}

TEST_F(WholeWindow, NothingIsNudgedBehindAnOpenMenu) {
  open_document();
  state.tool = Tool::kMove;
  show_window();
  click("menu.file");
  take();
  events = {key_event(Key::kRight), key_event(key_of('S'))};
  frame();
  EXPECT_FALSE(changes_something(take()));
}

TEST_F(WholeWindow, TheSidePanelsEdgeIsDragged) {
  open_document();
  show_window();
  const float before = widgets_.boxes().at("panel.side").w;
  move_to(at("panel.side.edge"));
  set_button(true);
  move_to(ImVec2(at("panel.side.edge").x - 80, 500));
  set_button(false);
  frame();
  EXPECT_NEAR(widgets_.boxes().at("panel.side").w, before + 80, 5);
}

/// Answers what it was told to, after some polls.
class FakeDialog : public SystemDialog {
public:
  explicit FakeDialog(std::vector<FileRequest>& started) : started_(started) {}
  bool available() const override { return true; }
  void start(const FileRequest& request) override {
    started_.push_back(request);
    polls_ = 0;
  }
  std::optional<std::filesystem::path> poll() override {
    return ++polls_ < 3 ? std::nullopt : std::optional<std::filesystem::path>("/a/sea.jpg");
  }
  void stop() override {}

private:
  std::vector<FileRequest>& started_;
  int polls_ = 0;
};

TEST_F(WholeWindow, TheDesktopsDialogIsAskedOnceAndPolled) {
  std::vector<FileRequest> started;
  WindowState with_system({}, std::make_unique<FakeDialog>(started));
  state.preferences.system_dialog = true;
  state.file_request = FileRequest{FileRequest::For::kOpen, "/a"};
  show([&](const DrawContext& context) { draw_editor_window(state, with_system, pictures, events, context); }, true);
  EXPECT_EQ(started.size(), 1U);
  EXPECT_FALSE(has("browser.path"));
  EXPECT_LT(reply_.next_frame_s, now_s_ + 1);
  frame();
  const auto actions = take();
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<action::Dismiss>(actions[0]));
  EXPECT_EQ(std::get<action::Open>(actions[1]).path, "/a/sea.jpg");
}

/// What panels draw goes through the widgets, which register it and give it a tip.
TEST(PanelSources, DrawNoBareItems) {
  namespace fs = std::filesystem;
  for (const auto& entry : fs::directory_iterator(fs::path(OVERSKETCH_SOURCE_DIR) / "ui" / "panels")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    const std::string source = text.str();
    for (const char* item : {"ImGui::Button(", "ImGui::SmallButton(", "ImGui::Checkbox(", "ImGui::RadioButton(",
                             "ImGui::SliderFloat(", "ImGui::SliderInt(", "ImGui::DragFloat(", "ImGui::Combo(",
                             "ImGui::BeginCombo(", "ImGui::ListBox(", "ImGui::CollapsingHeader(", "ImGui::TreeNode("})
      EXPECT_EQ(source.find(item), std::string::npos) << entry.path() << " draws " << item;
    // Items that panels make themselves are each followed by their registration.
    for (const char* item : {"ImGui::InvisibleButton(", "ImGui::InputText", "ImGui::MenuItem(", "ImGui::Selectable("})
      for (auto found = source.find(item); found != std::string::npos; found = source.find(item, found + 1)) {
        const auto registered = source.find("finish_item(", found);
        EXPECT_LT(registered - found, 900U) << entry.path() << ": " << source.substr(found, 60);
      }
  }
}

TEST_F(WholeWindow, MenusAreMovedInByTheKeyboard) {
  open_document();
  show_window();
  take();
  const auto chosen = [&] {
    auto actions = take();
    std::erase_if(actions, comes_of_looking);
    return actions;
  };
  // A finger stays on a key for some frames.
  const auto hit = [&](ImGuiKey key, Key named) {
    events = {key_event(named)};
    press(key, 4);
    frame();
  };
  events = {key_event(Key::kF10)};
  frame();
  frame();
  ASSERT_TRUE(has("menu.file.open"));
  hit(ImGuiKey_RightArrow, Key::kRight);
  ASSERT_TRUE(has("menu.edit.undo"));
  EXPECT_FALSE(has("menu.file.open"));
  hit(ImGuiKey_LeftArrow, Key::kLeft);
  ASSERT_TRUE(has("menu.file.open"));
  EXPECT_TRUE(chosen().empty()) << "nothing is chosen or nudged on the way";
  hit(ImGuiKey_DownArrow, Key::kDown);
  hit(ImGuiKey_Enter, Key::kEnter);
  EXPECT_EQ(chosen().size(), 1U);
  EXPECT_FALSE(has("menu.file.open"));
  events = {key_event(Key::kF10)};
  frame();
  frame();
  hit(ImGuiKey_Escape, Key::kEscape);
  EXPECT_FALSE(has("menu.file.open"));
  EXPECT_TRUE(chosen().empty());
  events = {key_event(Key::kRight), key_event(key_of('S')), key_event(key_of('S'), {}, InputEvent::Kind::kKeyUp)};
  frame();
  EXPECT_TRUE(changes_something(take())) << "tools have their keys again";
}

TEST_F(WholeWindow, AMenuOpensBesideThePointerHoweverLowTheWindowIs) {
  open_document();
  for (const ImVec2 size : {ImVec2(320, 240), ImVec2(640, 120)}) {
    ImGui::GetIO().DisplaySize = size;
    show_window();
    for (const char* menu : {"menu.file", "menu.edit", "menu.layer", "menu.view", "menu.help"}) {
      const float bottom = at(menu, 0, 1).y;
      take();
      click(menu);
      frame();
      for (const Action& action : take())
        EXPECT_TRUE(comes_of_looking(action)) << menu << " " << action.index();
      EXPECT_TRUE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) << menu;
      for (const auto& [name, box] : widgets_.boxes()) {
        if (name.starts_with(std::string(menu) + ".")) EXPECT_GE(box.y, bottom - 1) << name << " at " << size.y;
      }
      press(ImGuiKey_Escape);
      frame();
    }
  }
}

TEST_F(WholeWindow, WhatIsNotOpenedIsToldOverTheCanvases) {
  state.notice = "a.png is not opened: it is no picture\nb.png is not opened: there is no such file";
  for (const bool document : {false, true}) {
    if (document) open_document();
    show_window();
    EXPECT_TRUE(has("panel.notice"));
    EXPECT_GE(at(document ? "canvas.target" : "panel.empty", 0, 0).y, at("panel.notice", 0, 1).y);
    take();
    click("notice.close");
    take_one<action::DismissNotice>();
  }
  state.notice = "a\nb\nc\nd\ne\nf\ng";
  frame();
  EXPECT_TRUE(has("notice.4"));
  EXPECT_FALSE(has("notice.5"));
  EXPECT_EQ(widgets_.tips().find("notice.4")->second, "e\nf\ng") << "what has no line is in the last one's tip";
  state.notice.clear();
  frame();
  EXPECT_FALSE(has("panel.notice"));
}

} // namespace
} // namespace oversketch
