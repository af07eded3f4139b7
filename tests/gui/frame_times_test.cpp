// That the measurement of frames counts what happens: frames while something moves, none while nothing does.
#include "tests/gui/editor_under_test.h"

#include "core/image/image_io.h"

#include "tests/support/effort.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace oversketch {
namespace {

using testing::EditorUnderTest;
using testing::Json;

double median(const Json& times, const char* part) {
  return times.at(part).at("median_ms").get<double>();
}

TEST(GuiFrameTimes, parts_of_each_frame_are_told) {
  const testing::TempFolder folder;
  EditorUnderTest editor({.arguments = {"--sample", "--frame-times", (folder / "times.json").string()}});
  ASSERT_TRUE(editor.start());
  ASSERT_TRUE(editor.press("v"));
  ASSERT_TRUE(editor.draw("target", {{750, 450}, {755, 452}, {760, 455}, {770, 460}}));
  EXPECT_EQ(editor.map().at("history").size(), 10U) << editor.map().at("status");
  ASSERT_TRUE(editor.press("ctrl+z"));
  EXPECT_EQ(editor.close(), 0);
  const Json times = Json::parse(folder.read("times.json"));
  EXPECT_GT(times.at("frames"), 5);
  for (const char* part : {"own", "state", "upload", "layout", "draw"}) {
    const Json& of = times.at(part);
    EXPECT_LE(of.at("median_ms"), of.at("p95_ms")) << part;
    EXPECT_LE(of.at("p95_ms"), of.at("worst_ms")) << part;
  }
  EXPECT_GT(median(times, "layout"), 0);
  EXPECT_GT(median(times, "draw"), 0);
  EXPECT_GE(median(times, "own"), median(times, "layout"));
}

Image waves(int width, int height, double wave) {
  Raster<Rgba> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto at = [&](double phase) {
        return static_cast<float>(0.5 + 0.4 * std::sin(x / wave + phase) * std::cos(y / wave - phase));
      };
      picture.at(x, y) = {at(0), at(1), at(2), 1};
    }
  return Image(std::move(picture));
}

/// Sides of what is dragged, as a share of what frames are judged by: a part of one megapixel over a picture of twelve,
/// with OVERSKETCH_FRAMES=1.
double wanted_size() {
  if (std::getenv("OVERSKETCH_FRAMES") != nullptr) return 1;
  return testing::kIsSanitized ? 0.1 : 0.25;
}

TEST(GuiFrameTimes, a_large_part_is_dragged_over_a_large_picture) {
  const testing::TempFolder folder;
  const double size = wanted_size();
  const auto sized = [&](int length) { return static_cast<int>(length * size); };
  ASSERT_TRUE(save_image(waves(sized(4000), sized(3000), 90 * size), folder / "target.jpg").ok());
  ASSERT_TRUE(save_image(waves(sized(1400), sized(1300), 70 * size), folder / "source.jpg").ok());
  Json outline = Json::array();
  for (int i = 0; i < 120; ++i) {
    const double angle = 2 * std::numbers::pi * i / 120;
    outline.push_back({size * (700 + 585 * std::cos(angle)), size * (650 + 545 * std::sin(angle))});
  }
  folder.write("large.jsonl", "{\"oversketch_script\": 1}\n"
                              "{\"do\": \"document.new\", \"target\": \"target.jpg\"}\n"
                              "{\"do\": \"layer.add\", \"source\": \"source.jpg\"}\n" +
                                  Json{{"do", "region.set"}, {"outline", outline}}.dump() + "\n");
  EditorUnderTest editor(
      {.arguments = {(folder / "large.jsonl").string(), "--frame-times", (folder / "times.json").string()},
       .width = 1600,
       .height = 1000});
  ASSERT_TRUE(editor.start());
  ASSERT_TRUE(editor.press("v"));
  const Json map = editor.map();
  const Json& canvas = map.at("canvases").at("target").at("rect");
  const Point middle{canvas[0].get<double>() + canvas[2].get<double>() / 2,
                     canvas[1].get<double>() + canvas[3].get<double>() / 2};
  const auto steps = map.at("history").size();
  editor.hand().move(middle);
  editor.hand().press();
  constexpr int kMoves = testing::kIsSanitized ? 10 : 30;
  for (int i = 1; i <= kMoves; ++i) {
    editor.hand().move(middle + Point{100 * std::sin(0.2 * i), 60 * std::sin(0.31 * i)});
    ASSERT_TRUE(editor.rest());
  }
  editor.hand().release();
  ASSERT_TRUE(editor.rest());
  EXPECT_EQ(editor.map().at("history").size(), steps + 1) << editor.map().at("status");
  ASSERT_TRUE(editor.press("ctrl+z"));
  EXPECT_EQ(editor.close(), 0);
  const std::string times = folder.read("times.json");
  EXPECT_GE(Json::parse(times).at("frames"), kMoves);
  RecordProperty("times", times);
  GTEST_LOG_(INFO) << times;
}

} // namespace
} // namespace oversketch
