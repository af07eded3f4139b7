// The window itself: that it opens, shows, rests, and loses nothing of what a hand does.
#include "tests/gui/editor_under_test.h"

#include "core/image/image_io.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <set>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using testing::EditorUnderTest;
using testing::Json;

/// How many colours a picture has, counted up to a limit.
std::size_t count_colors(const Image& image, std::size_t most) {
  std::set<std::array<float, 3>> colors;
  for (const Rgba& p : image.pixels().values()) {
    colors.insert({p.r, p.g, p.b});
    if (colors.size() >= most) break;
  }
  return colors.size();
}

TEST(GuiWindow, an_old_display_gets_one_clear_message) {
  EditorUnderTest editor({.environment = {{"MESA_GL_VERSION_OVERRIDE", "2.1"}}});
  EXPECT_EQ(editor.program().wait(), 1);
  EXPECT_NE(editor.printed().find("Oversketch needs OpenGL 3.3"), std::string::npos) << editor.printed();
  const std::string printed = editor.printed();
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 1) << printed;
}

TEST(GuiWindow, without_a_display_it_says_so) {
  EditorUnderTest editor({.environment = {{"DISPLAY", ":98765"}}});
  EXPECT_EQ(editor.program().wait(), 1);
  EXPECT_NE(editor.printed().find("no window can be opened"), std::string::npos) << editor.printed();
}

TEST(GuiWindow, wrong_usage_is_told_before_a_window_opens) {
  EditorUnderTest editor({.arguments = {"--no-such-option"}});
  EXPECT_EQ(editor.program().wait(), 2);
}

TEST(GuiWindow, a_file_that_is_no_picture_is_said_in_the_window) {
  const testing::TempFolder folder;
  folder.write("broken.png", "this is no picture");
  EditorUnderTest editor({.arguments = {(folder / "broken.png").string()}});
  ASSERT_TRUE(editor.start());
  EXPECT_NE(editor.map().at("status").get<std::string>().find("broken.png"), std::string::npos);
  EXPECT_TRUE(editor.map().at("tabs").empty());
  EXPECT_EQ(editor.close(), 0);
}

TEST(GuiWindow, the_sample_is_shown_and_then_nothing_moves) {
  const testing::TempFolder folder;
  EditorUnderTest editor({.arguments = {"--sample", "--screenshot", (folder / "shot.png").string()}});
  ASSERT_TRUE(editor.start());
  const Json map = editor.map();
  EXPECT_EQ(map.at("history").size(), 9u);
  EXPECT_EQ(map.at("cursor"), 8);
  EXPECT_FALSE(map.at("modified"));
  EXPECT_FALSE(map.at("canvases").at("source").is_null());
  EXPECT_FALSE(map.at("canvases").at("target").is_null());
  ASSERT_TRUE(fs::exists(folder / "shot.png"));
  const auto shot = load_image(folder / "shot.png");
  ASSERT_TRUE(shot.ok());
  EXPECT_EQ(shot->width(), 1280);
  EXPECT_EQ(shot->height(), 800);
  EXPECT_EQ(count_colors(*shot, 5000), 5000u) << "photographs have many colours";
  EXPECT_EQ(editor.close(), 0);
}

TEST(GuiWindow, at_rest_it_uses_no_processor) {
  EditorUnderTest editor({.arguments = {"--sample"}});
  ASSERT_TRUE(editor.start());
  ASSERT_TRUE(editor.rest());
  // What it uses in a time that is measured, not waited for.
  const auto used_in = [&](long milliseconds) {
    const double before = editor.program().cpu_s();
    const timespec time = {milliseconds / 1000, milliseconds % 1000 * 1'000'000};
    nanosleep(&time, nullptr);
    return editor.program().cpu_s() - before;
  };
  // The status bar's line ends by itself some seconds later; after that there is nothing left to draw.
  for (int half_seconds = 0; half_seconds < 40 && used_in(500) > 0; ++half_seconds)
    continue;
  EXPECT_LT(used_in(2000), 0.02 + 1e-9);
}

TEST(GuiWindow, every_point_of_a_fast_stroke_arrives) {
  EditorUnderTest editor({.arguments = {"--sample"}});
  ASSERT_TRUE(editor.start());
  const auto events = editor.map().at("events").get<int>();
  Points circle;
  for (int i = 0; i < 200; ++i) {
    const double angle = 2 * std::numbers::pi * i / 200;
    circle.push_back({320 + 90 * std::cos(angle), 400 + 90 * std::sin(angle)});
  }
  editor.hand().draw(circle);
  ASSERT_TRUE(editor.rest());
  // To the first point, down, 199 others, up, and the marker of rest().
  EXPECT_GE(editor.map().at("events").get<int>() - events, 1 + 1 + 199 + 1 + 1);
}

TEST(GuiWindow, menus_are_moved_in_by_the_keyboard) {
  EditorUnderTest editor({.arguments = {"--sample"}});
  ASSERT_TRUE(editor.start());
  const Json history = editor.map().at("history");
  const int cursor = editor.map().at("cursor");
  ASSERT_TRUE(editor.press("F10"));
  ASSERT_TRUE(editor.widget("menu.file.open"));
  using Step = std::pair<const char*, const char*>;
  for (const auto& [key, entry] :
       {Step("Right", "menu.edit.undo"), Step("Right", "menu.layer.add"), Step("Right", "menu.view.fit"),
        Step("Right", "menu.help.about"), Step("Right", "menu.file.open"), Step("Left", "menu.help.about"),
        Step("Left", "menu.view.fit"), Step("Left", "menu.layer.add"), Step("Left", "menu.edit.undo")}) {
    ASSERT_TRUE(editor.press(key));
    ASSERT_TRUE(editor.widget(entry)) << entry;
  }
  EXPECT_EQ(editor.map().at("history"), history) << "nothing is nudged on the way";
  EXPECT_EQ(editor.map().at("cursor"), cursor);
  ASSERT_TRUE(editor.press("Return"));
  EXPECT_EQ(editor.map().at("cursor"), cursor - 1) << "the first entry undoes";
  EXPECT_FALSE(editor.widget("menu.edit.undo"));
  for (const char* key : {"F10", "Right", "Down", "Return"})
    ASSERT_TRUE(editor.press(key));
  EXPECT_EQ(editor.map().at("cursor"), cursor) << "the second does it again";
  EXPECT_EQ(editor.close(), 0);
}

TEST(GuiWindow, a_menu_in_a_menu_is_left_by_the_keyboard) {
  EditorUnderTest editor({.arguments = {OVERSKETCH_SOURCE_DIR "/assets/puffer.jpg"}, .width = 320, .height = 240});
  ASSERT_TRUE(editor.start());
  ASSERT_TRUE(editor.click("menu.file"));
  const auto recent = editor.widget("menu.file.recent");
  ASSERT_TRUE(recent);
  editor.hand().move(*recent);
  ASSERT_TRUE(editor.rest());
  // The pointer lies on it all the while.
  for (int i = 0; i < 6; ++i)
    ASSERT_TRUE(editor.press("Escape")) << i;
  EXPECT_FALSE(editor.widget("menu.file.open"));
  ASSERT_TRUE(editor.press("h"));
  EXPECT_EQ(editor.map().at("tool"), "pan") << "nothing keeps the keyboard";
  EXPECT_EQ(editor.close(), 0);
}

TEST(GuiWindow, resizing_keeps_the_picture_fitted) {
  EditorUnderTest editor({.arguments = {OVERSKETCH_SOURCE_DIR "/assets/puffer.jpg"}});
  ASSERT_TRUE(editor.start());
  const double zoom = editor.map().at("canvases").at("target").at("zoom");
  for (const auto& [width, height] : {std::pair{700, 500}, {320, 240}, {1400, 900}}) {
    editor.hand().resize(width, height);
    ASSERT_TRUE(editor.wait_for("the new size", [&, w = width, h = height](const Json& map) {
      return map.at("window")[2] == w && map.at("window")[3] == h && !map.at("busy");
    }));
  }
  EXPECT_GT(editor.map().at("canvases").at("target").at("zoom").get<double>(), zoom * 0.9);
  EXPECT_EQ(editor.close(), 0);
}

TEST(GuiWindow, a_script_runs_in_the_window_and_is_recorded) {
  const testing::TempFolder folder;
  const std::string record = (folder / "recorded.jsonl").string();
  {
    EditorUnderTest editor({.arguments = {"--script", OVERSKETCH_SOURCE_DIR "/assets/samples/puffer.jsonl", "--out",
                                          folder.path().string(), "--record", record, "--exit-when-idle"}});
    EXPECT_EQ(editor.program().wait(), 0) << editor.printed();
  }
  EXPECT_TRUE(fs::exists(folder / "puffer.png"));
  EditorUnderTest again({.arguments = {record, "--exit-when-idle"}});
  EXPECT_EQ(again.program().wait(), 0) << again.printed();
  EXPECT_EQ(again.map().at("history").size(), 9u);
}

TEST(GuiWindow, what_goes_wrong_without_a_person_ends_with_a_reason) {
  EditorUnderTest editor({.arguments = {"/nowhere/at/all.png", "--exit-when-idle"}});
  EXPECT_EQ(editor.program().wait(), 1);
  EXPECT_NE(editor.printed().find("image.missing"), std::string::npos) << editor.printed();
}

} // namespace
} // namespace oversketch
