// A hand that knows nothing: strokes, clicks, keys, text, wheel and window sizes in any order.  Afterwards the document
// is valid, everything can be undone and done again, and what was recorded replays to the same document.
//
// OVERSKETCH_MONKEY_EVENTS is how many events each seed makes, in place of kEvents (fewer with the sanitizers).
#include "tests/gui/editor_under_test.h"

#include "core/io/project.h"
#include "core/io/recorder.h"

#include "tests/support/effort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using testing::EditorUnderTest;
using testing::Json;

constexpr int kEvents = 300;

int wanted_events() {
  return testing::tries(kEvents, "OVERSKETCH_MONKEY_EVENTS");
}

class Monkey {
public:
  Monkey(EditorUnderTest& editor, unsigned seed) : editor_(editor), random_(seed) {}

  /// One gesture, and rest.  It never navigates or confirms in a file browser: what lies on this disk is not its own.
  bool act() {
    const Json map = editor_.map();
    if (!map.at("file_request").is_null()) {
      last_ = "in the browser";
      if (chance(0.4)) return editor_.press("Escape");
      if (chance(0.5)) return click_any(map, {"browser.sort.date", "browser.sort.name", "browser.sort.size"});
      editor_.hand().type(some_text());
      return editor_.rest();
    }
    const double kind = uniform(0, 1);
    if (kind < 0.35) return stroke(map);
    if (kind < 0.50) return click_somewhere();
    if (kind < 0.72) return click_widget(map);
    if (kind < 0.94) return press_keys(map);
    if (kind < 0.98) return turn_wheel();
    return resize();
  }

  const std::string& last() const { return last_; }

private:
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  bool chance(double share) { return uniform(0, 1) < share; }
  template <typename List>
  const auto& any_of(const List& list) {
    return list[std::uniform_int_distribution<std::size_t>(0, std::size(list) - 1)(random_)];
  }

  Point somewhere() { return {uniform(-20, 1620), uniform(-20, 1020)}; }
  Point in_window(const Json& map) {
    return {uniform(0, map.at("window")[2].get<double>()), uniform(0, map.at("window")[3].get<double>())};
  }

  std::string some_text() {
    static constexpr std::string_view kLetters = "0123456789.-+eE/\\\"'{}[] abcxyz%";
    std::string text;
    for (int i = 0; i < 1 + static_cast<int>(uniform(0, 6)); ++i)
      text += kLetters[static_cast<std::size_t>(uniform(0, static_cast<double>(kLetters.size()) - 0.01))];
    return text;
  }

  /// Round something on a canvas, or anywhere; with a key held, now and then.
  bool stroke(const Json& map) {
    last_ = "a stroke";
    Point centre = in_window(map);
    double radius = uniform(5, 200);
    if (const Json& canvas = map.at("canvases").at(chance(0.5) ? "source" : "target");
        !canvas.is_null() && chance(0.8)) {
      const Json& rect = canvas.at("rect");
      centre = {rect[0].get<double>() + uniform(0.2, 0.8) * rect[2].get<double>(),
                rect[1].get<double>() + uniform(0.2, 0.8) * rect[3].get<double>()};
      radius = uniform(0.05, 0.4) * std::min(rect[2].get<double>(), rect[3].get<double>());
    }
    const int count = 2 + static_cast<int>(uniform(0, 40));
    const double begin = uniform(0, 7), turn = chance(0.5) ? uniform(6.0, 6.4) : uniform(-7, 7), wild = uniform(0, 0.4);
    Points points;
    for (int i = 0; i < count; ++i) {
      const double angle = begin + turn * i / (count - 1), r = radius * (1 + uniform(-wild, wild));
      points.push_back(centre + r * Point{std::cos(angle), std::sin(angle)});
    }
    static constexpr std::array kHeld{"space", "Alt_L", "Shift_L", "Control_L", "v", "p", "s", "l", "backslash"};
    const char* held = chance(0.2) ? any_of(kHeld) : nullptr;
    if (held != nullptr) editor_.hand().hold(held);
    editor_.hand().draw(points);
    if (held != nullptr) editor_.hand().let_go(held);
    return editor_.rest();
  }

  bool click_somewhere() {
    last_ = "a click";
    const Point at = somewhere();
    const int button = chance(0.8) ? 1 : chance(0.5) ? 2 : 3;
    editor_.hand().click(at, button);
    if (chance(0.2)) editor_.hand().click(at, button);
    return editor_.rest();
  }

  bool click_any(const Json& map, std::vector<std::string> ids) {
    std::erase_if(ids, [&](const std::string& id) { return !map.at("widgets").contains(id); });
    if (ids.empty()) return editor_.press("Escape");
    last_ = any_of(ids);
    return editor_.click(last_);
  }

  bool click_widget(const Json& map) {
    std::vector<std::string> ids;
    for (const auto& [id, box] : map.at("widgets").items())
      if (id != "menu.file.quit") ids.push_back(id);
    return click_any(map, ids);
  }

  bool press_keys(const Json& map) {
    static constexpr std::array kChords{"l",           "s",      "p",      "v",           "h",
                                        "ctrl+z",      "ctrl+z", "ctrl+z", "ctrl+y",      "ctrl+shift+z",
                                        "Delete",      "Escape", "Return", "Tab",         "Left",
                                        "Right",       "Up",     "Down",   "x",           "shift+Left",
                                        "ctrl+n",      "ctrl+o", "ctrl+s", "ctrl+w",      "F1",
                                        "F2",          "F10",    "ctrl+0", "ctrl+1",      "plus",
                                        "minus",       "space",  "Home",   "End",         "backslash",
                                        "ctrl+h",      "ctrl+a", "ctrl+v", "bracketleft", "bracketright",
                                        "ctrl+shift+e"};
    if (map.at("wants_text") && chance(0.7)) {
      last_ = "text";
      editor_.hand().type(some_text());
      if (chance(0.5)) editor_.hand().key("Return");
      return editor_.rest();
    }
    last_ = any_of(kChords);
    // The keyboard may have gone to what ends the program.
    const bool chooses = last_ == "Return" || last_ == "space";
    for (const auto& [id, box] : map.at("widgets").items())
      if (chooses && id.starts_with("menu.file.")) last_ = "Escape";
    return editor_.press(last_);
  }

  bool turn_wheel() {
    last_ = "the wheel";
    editor_.hand().move(somewhere());
    editor_.hand().wheel(static_cast<int>(uniform(-6, 7)));
    return editor_.rest();
  }

  bool resize() {
    last_ = "another size";
    static constexpr std::array<std::pair<int, int>, 5> kSizes{
        {{320, 240}, {1280, 800}, {1600, 1000}, {700, 500}, {1024, 700}}};
    const auto [width, height] = any_of(kSizes);
    return editor_.resize(width, height);
  }

  EditorUnderTest& editor_;
  std::mt19937 random_;
  std::string last_;
};

/// Closes what is open over the window: browsers, questions, menus, fields.
bool come_back(EditorUnderTest& editor) {
  for (int i = 0; i < 6; ++i)
    if (!editor.press("Escape")) return false;
  const Json map = editor.map();
  EXPECT_TRUE(map.at("file_request").is_null());
  EXPECT_TRUE(map.at("question").is_null());
  return true;
}

class GuiMonkey : public ::testing::TestWithParam<unsigned> {};

TEST_P(GuiMonkey, whatever_it_does_can_be_undone_saved_and_replayed) {
  const testing::TempFolder folder;
  const fs::path project = folder / "monkey.ora", record = folder / "record.jsonl";
  EditorUnderTest editor({.arguments = {"--sample", "--record", record.string()}});
  ASSERT_TRUE(editor.start());
  Monkey monkey(editor, GetParam());
  const int events = wanted_events();
  std::vector<std::string> lately;
  for (int gesture = 0; editor.map().at("events").get<int>() < events; ++gesture) {
    const bool rested = monkey.act();
    lately.push_back(monkey.last());
    if (lately.size() > 12) lately.erase(lately.begin());
    ASSERT_TRUE(rested) << "gesture " << gesture << ", after " << ::testing::PrintToString(lately);
    const Json map = editor.map();
    if (!map.at("history").empty()) ASSERT_LT(map.at("cursor"), map.at("history").size());
  }
  ASSERT_TRUE(come_back(editor));
  ASSERT_TRUE(editor.resize(1280, 800));
  if (editor.map().at("tabs").empty()) ASSERT_TRUE(editor.click("empty.sample"));

  const Json before = editor.map();
  for (int cursor = before.at("cursor"); cursor > 0; --cursor) {
    ASSERT_TRUE(editor.press("ctrl+z"));
    ASSERT_EQ(editor.map().at("cursor"), cursor - 1) << editor.map().at("status");
  }
  const auto count = before.at("history").size();
  for (std::size_t cursor = 0; cursor + 1 < count; ++cursor) {
    ASSERT_TRUE(editor.press("ctrl+y"));
    ASSERT_EQ(editor.map().at("cursor"), cursor + 1) << editor.map().at("status");
  }
  EXPECT_EQ(editor.map().at("history"), before.at("history"));

  ASSERT_TRUE(editor.press("ctrl+shift+s"));
  ASSERT_TRUE(editor.click("browser.path"));
  ASSERT_TRUE(editor.press("ctrl+a"));
  editor.hand().type(project.string());
  ASSERT_TRUE(editor.press("Return"));
  ASSERT_TRUE(editor.wait_for("a saved project", [](const Json& map) { return !map.at("modified").get<bool>(); }));
  // The others go without a word.
  for (std::size_t tabs = editor.map().at("tabs").size(); tabs > 1; --tabs) {
    const Json map = editor.map();
    if (map.at("tabs").at(map.at("tab").get<std::size_t>()) == project.stem().string())
      ASSERT_TRUE(editor.press("ctrl+Tab"));
    ASSERT_TRUE(editor.press("ctrl+w"));
    if (!editor.map().at("question").is_null()) ASSERT_TRUE(editor.click("question.discard"));
    ASSERT_EQ(editor.map().at("tabs").size(), tabs - 1);
  }
  EXPECT_EQ(editor.close(), 0);

  auto loaded = load_project(project);
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_TRUE(loaded->session.composite().ok());
  Session replayed;
  const auto opened = open_session(replayed, record, {});
  ASSERT_TRUE(opened.ok()) << to_string(opened.error());
  EXPECT_EQ(replayed.document(), loaded->session.document());
  const auto undone = loaded->session.jump(0);
  EXPECT_TRUE(undone.ok()) << to_string(undone.error());
}

INSTANTIATE_TEST_SUITE_P(Seeds, GuiMonkey, ::testing::Values(1U, 2U, 3U));

} // namespace
} // namespace oversketch
