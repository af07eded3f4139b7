// The two-minute task, as a hand does it: a fish out of one photograph into another, redrawn, pinned, moved, undone,
// saved, opened again, exported; and all of it again without a window.
#include "tests/gui/editor_under_test.h"

#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/io/project.h"
#include "core/io/recorder.h"
#include "core/session/script.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <numbers>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using testing::EditorUnderTest;
using testing::Json;

const fs::path kSamples = fs::path(OVERSKETCH_SOURCE_DIR) / "assets/samples";

/// The curves of the sample, which a hand draws here.
struct FishCurves {
  Points outline, sketch;
};

FishCurves read_fish() {
  std::ifstream file(kSamples / "puffer.jsonl");
  FishCurves fish;
  for (std::string line; std::getline(file, line);) {
    const Json step = Json::parse(line, nullptr, false);
    if (step.is_discarded() || !step.contains("do")) continue;
    const auto read = [&](const char* key, Points& into) {
      for (const Json& p : step.value(key, Json::array()))
        into.push_back({p[0].get<double>(), p[1].get<double>()});
    };
    if (step.at("do") == "region.set") read("outline", fish.outline);
    if (step.at("do") == "sketch.set") read("curve", fish.sketch);
  }
  return fish;
}

/// Part of a closed curve, pushed out by a bump of so many pixels.
Points bumped_part(const Points& curve, std::size_t from, std::size_t count, double height) {
  Points part;
  for (std::size_t i = 0; i <= count; ++i) {
    const Point before = curve[(from + i + curve.size() - 1) % curve.size()], at = curve[(from + i) % curve.size()],
                after = curve[(from + i + 1) % curve.size()];
    const Point along = (after - before) / distance(after, before);
    const double share = static_cast<double>(i) / static_cast<double>(count);
    const double push = height * std::pow(std::sin(std::numbers::pi * share), 2);
    part.push_back(at + push * Point{along.y, -along.x});
  }
  return part;
}

/// Types a path into the browser that is open, and goes there.
void go_to_file(EditorUnderTest& editor, const fs::path& path, const std::string& purpose) {
  ASSERT_TRUE(editor.wait_for("the browser", [&](const Json& map) {
    return map.at("file_request") == purpose && map.at("widgets").contains("browser.path");
  }));
  ASSERT_TRUE(editor.click("browser.path"));
  ASSERT_TRUE(editor.press("ctrl+a"));
  editor.hand().type(path.string());
  ASSERT_TRUE(editor.press("Return"));
  ASSERT_TRUE(editor.wait_for("the browser to close",
                              [](const Json& map) { return map.at("file_request").is_null() && !map.at("busy"); }));
}

std::size_t steps(const EditorUnderTest& editor) {
  return editor.map().at("history").size();
}

void expect_steps(EditorUnderTest& editor, std::size_t count, const std::string& what) {
  ASSERT_EQ(steps(editor), count) << "after " << what << ": " << editor.map().at("status");
  EXPECT_EQ(editor.map().at("cursor").get<std::size_t>() + 1, count) << what;
}

class GuiSession : public ::testing::Test {
protected:
  void draw_the_fish(EditorUnderTest& editor) {
    const FishCurves fish = read_fish();
    ASSERT_GT(fish.outline.size(), 50U);
    ASSERT_GT(fish.sketch.size(), 50U);
    ASSERT_TRUE(editor.press("ctrl+o"));
    go_to_file(editor, kSamples / "sea_sand_bg.jpg", "open");
    expect_steps(editor, 1, "opening the target");
    ASSERT_TRUE(editor.click("menu.layer"));
    ASSERT_TRUE(editor.click("menu.layer.add"));
    go_to_file(editor, kSamples / "pufferfish.png", "add-source");
    expect_steps(editor, 2, "adding the source");

    ASSERT_TRUE(editor.press("l"));
    ASSERT_TRUE(editor.draw("source", fish.outline));
    expect_steps(editor, 3, "the outline");
    ASSERT_TRUE(editor.press("s"));
    ASSERT_TRUE(editor.draw("target", fish.sketch));
    expect_steps(editor, 4, "the sketch");
    ASSERT_TRUE(editor.draw("target", bumped_part(fish.sketch, fish.sketch.size() / 3, 12, 18)));
    expect_steps(editor, 5, "oversketching the sketch");
    ASSERT_TRUE(editor.press("l"));
    ASSERT_TRUE(editor.draw("source", bumped_part(fish.outline, fish.outline.size() / 2, 14, 3)));
    expect_steps(editor, 6, "oversketching the outline");

    ASSERT_TRUE(editor.press("p"));
    editor.hand().click(editor.to_window("source", fish.outline.front()));
    ASSERT_TRUE(editor.rest());
    editor.hand().click(editor.to_window("target", fish.sketch.front()));
    ASSERT_TRUE(editor.rest());
    expect_steps(editor, 7, "a pin");

    // Dragged by 40 pixels of the picture, give or take what a window's pixel is.
    ASSERT_TRUE(editor.press("v"));
    Point middle{0, 0};
    for (const Point p : fish.sketch)
      middle += p / static_cast<double>(fish.sketch.size());
    Points way;
    for (int i = 0; i <= 20; ++i)
      way.push_back(middle + Point{2.0 * i, 1.0 * i});
    ASSERT_TRUE(editor.draw("target", way));
    expect_steps(editor, 8, "moving");
    for (const char* arrow : {"Right", "Down", "shift+Left"})
      ASSERT_TRUE(editor.press(arrow));
    expect_steps(editor, 11, "three arrows");
  }
};

TEST_F(GuiSession, a_fish_gets_into_the_sea_and_everything_is_kept) {
  const testing::TempFolder folder;
  const fs::path project = folder / "fish.ora", picture = folder / "fish.png", record = folder / "record.jsonl";
  Json history;
  {
    EditorUnderTest editor({.arguments = {"--record", record.string()}, .width = 1500, .height = 940});
    ASSERT_TRUE(editor.start());
    draw_the_fish(editor);
    if (HasFatalFailure()) return;
    history = editor.map().at("history");
    for (int i = 0; i < 10; ++i)
      ASSERT_TRUE(editor.press("ctrl+z"));
    EXPECT_EQ(editor.map().at("cursor"), 0);
    for (int i = 0; i < 10; ++i)
      ASSERT_TRUE(editor.press(i % 2 == 0 ? "ctrl+y" : "ctrl+shift+z"));
    EXPECT_EQ(editor.map().at("cursor"), 10);
    EXPECT_EQ(editor.map().at("history"), history);

    EXPECT_TRUE(editor.map().at("modified"));
    ASSERT_TRUE(editor.press("ctrl+s"));
    go_to_file(editor, project, "save-as");
    ASSERT_TRUE(editor.wait_for("a saved project", [](const Json& map) { return !map.at("modified").get<bool>(); }));
    ASSERT_TRUE(editor.press("ctrl+shift+e"));
    go_to_file(editor, picture, "export");
    ASSERT_TRUE(editor.wait_for("the picture", [&](const Json&) { return fs::exists(picture); }));
    EXPECT_EQ(editor.close(), 0);
  }

  // Opened again in the window: the same steps, and they can still be undone.
  {
    EditorUnderTest editor({.arguments = {project.string()}});
    ASSERT_TRUE(editor.start());
    EXPECT_EQ(editor.map().at("history"), history);
    EXPECT_EQ(editor.map().at("cursor"), 10);
    EXPECT_FALSE(editor.map().at("modified"));
    ASSERT_TRUE(editor.press("ctrl+z"));
    EXPECT_EQ(editor.map().at("cursor"), 9);
    ASSERT_TRUE(editor.press("ctrl+y"));
    EXPECT_FALSE(editor.map().at("modified"));
    EXPECT_EQ(editor.close(), 0);
  }

  // And without one: what was recorded replays to what was saved, and shows what was exported.
  Session replayed;
  const auto opened = open_session(replayed, record, {});
  ASSERT_TRUE(opened.ok()) << to_string(opened.error());
  auto loaded = load_project(project);
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_EQ(replayed.document(), loaded->session.document());
  const auto exported = load_image(picture);
  ASSERT_TRUE(exported.ok());
  for (Session* session : {&replayed, &loaded->session}) {
    const auto shown = session->composite();
    ASSERT_TRUE(shown.ok());
    ASSERT_TRUE(save_image(*shown, folder / "again.png").ok());
    const auto difference = compare(*load_image(folder / "again.png"), *exported);
    ASSERT_TRUE(difference.ok());
    EXPECT_EQ(difference->max_levels, 0);
  }
}

TEST_F(GuiSession, a_name_can_be_typed_before_the_dialog_is_there) {
  const testing::TempFolder folder;
  EditorUnderTest editor({.arguments = {"--sample"}, .width = 1000, .height = 700});
  ASSERT_TRUE(editor.start());
  for (const char* name : {"ab.ora", "ba.ora", "aabb_c.ora"}) {
    editor.hand().key("ctrl+shift+s");
    editor.hand().type((folder / name).string());
    editor.hand().key("Return");
    ASSERT_TRUE(editor.wait_for(name, [&](const Json& map) { return fs::exists(folder / name) && !map.at("busy"); }));
  }
  EXPECT_EQ(editor.close(), 0);
}

TEST_F(GuiSession, a_path_is_typed_into_the_file_list) {
  EditorUnderTest editor({.width = 1000, .height = 700});
  ASSERT_TRUE(editor.start());
  ASSERT_TRUE(editor.press("ctrl+o"));
  ASSERT_TRUE(editor.wait_for("the list", [](const Json& map) {
    return map.at("widgets").contains("browser.list") && !map.at("wants_text") && !map.at("busy");
  }));
  editor.hand().type((kSamples / "kingfisher.jpg").string());
  ASSERT_TRUE(editor.rest());
  EXPECT_TRUE(editor.map().at("wants_text"));
  ASSERT_TRUE(editor.press("Return"));
  ASSERT_TRUE(editor.wait_for(
      "the picture", [](const Json& map) { return map.at("tabs") == Json::array({"kingfisher"}) && !map.at("busy"); }));
  EXPECT_EQ(editor.close(), 0);
}

TEST_F(GuiSession, told_to_end_it_records_and_keeps_what_is_not_saved) {
  const testing::TempFolder folder;
  const fs::path record = folder / "record.jsonl";
  const std::map<std::string, std::string> environment = {{"XDG_STATE_HOME", (folder / "state").string()}};
  Json history;
  {
    EditorUnderTest editor({.arguments = {"--sample", "--record", record.string()}, .environment = environment});
    ASSERT_TRUE(editor.start());
    ASSERT_TRUE(editor.click("tool.move"));
    ASSERT_TRUE(editor.press("Right"));
    ASSERT_TRUE(editor.map().at("modified"));
    history = editor.map().at("history");
    editor.program().send(SIGTERM);
    EXPECT_EQ(editor.program().wait(), 0);
  }
  Session replayed;
  const auto opened = open_session(replayed, record, {});
  ASSERT_TRUE(opened.ok()) << to_string(opened.error());
  EXPECT_EQ(replayed.history().entries().size(), history.size());

  EditorUnderTest editor({.environment = environment});
  ASSERT_TRUE(editor.start());
  ASSERT_TRUE(editor.wait_for("the offer",
                              [](const Json& map) { return map.at("widgets").contains("empty.recovered.0.take"); }));
  ASSERT_TRUE(editor.click("empty.recovered.0.take"));
  ASSERT_TRUE(editor.wait_for("the work", [&](const Json& map) { return map.value("history", Json()) == history; }));
}

} // namespace
} // namespace oversketch
