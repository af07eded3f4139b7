#include "core/session/report.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace oversketch {
namespace {

using namespace testing;

constexpr float kLow = 0.25F, kHigh = 0.75F;

/// Grey, brighter right of x = 60.
Image half_bright(int width, int height) {
  Raster<Rgba> pixels(width, height, {kLow, kLow, kLow, 1});
  for (int y = 0; y < height; ++y)
    for (int x = 60; x < width; ++x)
      pixels.at(x, y) = {kHigh, kHigh, kHigh, 1};
  return Image(std::move(pixels));
}

/// A layer of plain grey, round (60, 60) of a target with an edge there.
Session over_an_edge() {
  Session session;
  DocumentNew begin;
  begin.target = loaded_ref("target.png", half_bright(120, 120));
  EXPECT_TRUE(session.execute(begin).ok());
  const ImageRef source = loaded_ref("source.png", plain_image(120, 120, {kLow, kLow, kLow, 1}));
  EXPECT_TRUE(session.execute(LayerAdd{source, std::nullopt}).ok());
  EXPECT_TRUE(session.execute(RegionSet{{}, blob({60, 60}, 35, 0)}).ok());
  return session;
}

nlohmann::ordered_json bleed_of(Session& session) {
  const auto report = make_report(session, {});
  EXPECT_TRUE(report.ok());
  return (*report)["layers"][0]["bleed"];
}

TEST(Report, forecasts_where_a_layers_colours_bleed) {
  Session session = over_an_edge();
  const auto bleed = bleed_of(session);
  // Half of the edge differs by 127.5 levels in three channels, the other half not at all.
  const double most = 127.5 * std::sqrt(3.0);
  EXPECT_NEAR(bleed["worst"], most, 0.1);
  EXPECT_NEAR(bleed["mean"], most / 2, most / 20);
  for (const double shift : bleed["shift"])
    EXPECT_NEAR(shift, 127.5 / 2, 127.5 / 20);
  EXPECT_GT(bleed["worst_at"][0], 60);
  EXPECT_GT(bleed["jump"], 0.9 * most);
  EXPECT_NEAR(bleed["jump_at"][0], 60, 5);
  const double y = bleed["jump_at"][1];
  EXPECT_NEAR(std::abs(y - 60), 35, 2);
}

TEST(Report, forecasts_on_what_is_below_the_layer_where_it_stands) {
  Session session = over_an_edge();
  LayerMove move;
  move.by = {-60, 0};
  ASSERT_TRUE(session.execute(move).ok());
  // There the target is as dark as the layer.
  EXPECT_NEAR(bleed_of(session)["worst"], 0, 0.1);
  move.by = {-300, 0};
  ASSERT_TRUE(session.execute(move).ok());
  EXPECT_TRUE(bleed_of(session).is_null());
  move.by = {360, 0};
  ASSERT_TRUE(session.execute(move).ok());
  LayerSet mode;
  mode.mode = CloneMode::kNone;
  ASSERT_TRUE(session.execute(mode).ok());
  EXPECT_TRUE(bleed_of(session).is_null()) << "nothing is matched";
  mode.mode = CloneMode::kMixed;
  ASSERT_TRUE(session.execute(mode).ok());
  EXPECT_FALSE(bleed_of(session).is_null());
  LayerSet hidden;
  hidden.visible = false;
  ASSERT_TRUE(session.execute(hidden).ok());
  EXPECT_TRUE(bleed_of(session).is_null());
}

TEST(Report, counts_the_pixels_that_a_layer_paints) {
  Session session = over_an_edge();
  const auto pixels = [&]() -> std::int64_t {
    const auto report = make_report(session, {});
    EXPECT_TRUE(report.ok());
    return (*report)["layers"][0]["pixels"];
  };
  const std::int64_t all = pixels();
  EXPECT_GT(all, 3000);
  LayerMove move;
  move.by = {-60, 0};
  ASSERT_TRUE(session.execute(move).ok());
  EXPECT_NEAR(static_cast<double>(pixels()), static_cast<double>(all) / 2, 100) << "half of it hangs out";
  move.by = {-300, 0};
  ASSERT_TRUE(session.execute(move).ok());
  EXPECT_EQ(pixels(), 0);
  move.by = {360, 0};
  ASSERT_TRUE(session.execute(move).ok());
  EXPECT_EQ(pixels(), all);
  LayerSet hidden;
  hidden.visible = false;
  ASSERT_TRUE(session.execute(hidden).ok());
  EXPECT_EQ(pixels(), 0);
  hidden.visible = true;
  ASSERT_TRUE(session.execute(hidden).ok());
  // Between two rows of centres.
  ASSERT_TRUE(session.execute(RegionSet{{}, {{20, 60.1}, {100, 60.1}, {100, 60.4}, {20, 60.4}}}).ok());
  EXPECT_EQ(pixels(), 0);
}

} // namespace
} // namespace oversketch
