#include "core/clone/bleed.h"

#include "core/clone/placed_pair.h"
#include "tests/unit/clone/clone_support.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

Raster<Rgba> flat(int width, int height, float level) {
  return Raster<Rgba>(width, height, {level / 255, level / 255, level / 255, 1});
}

const Points kSquare = {{10, 10}, {50, 10}, {50, 40}, {10, 40}};

struct Scene {
  Mask mask = rect_mask({10, 10, 40, 30});
  WarpedRegion source{{9, 9, 42, 32}, flat(42, 32, 20)};
  Raster<Rgba> target = flat(100, 90, 50);

  BleedForecast at(int dx, int dy, const Points& outline = kSquare) const {
    return forecast_bleed(target, source, mask, dx, dy, outline);
  }
};

TEST(Bleed, HasNoSamplesWithoutALine) {
  const Scene scene;
  EXPECT_TRUE(scene.at(0, 0, {}).samples.empty());
  EXPECT_TRUE(scene.at(0, 0, {{3, 3}}).samples.empty());
  EXPECT_TRUE(scene.at(0, 0, {{3, 3}, {3, 3}, {3, 3}}).samples.empty());
  EXPECT_TRUE(forecast_bleed(Raster<Rgba>(), scene.source, scene.mask, 0, 0, kSquare).samples.empty());
}

TEST(Bleed, OfTheSameDifferenceAllRoundIsThatDifferenceWithoutJumps) {
  const Scene scene;
  for (const bool turned : {false, true}) {
    Points outline = kSquare;
    if (turned) std::reverse(outline.begin(), outline.end());
    const BleedForecast forecast = scene.at(7, 5, outline);
    ASSERT_EQ(forecast.samples.size(), 140u);
    for (std::size_t i = 0; i < forecast.samples.size(); ++i) {
      const BleedSample& sample = forecast.samples[i];
      EXPECT_NEAR(sample.s, static_cast<double>(i), 1e-9);
      EXPECT_NEAR(sample.mismatch[1], 30, 1e-3);
      EXPECT_NEAR(sample.norm, 30 * std::sqrt(3.0), 1e-3);
      EXPECT_NEAR(sample.jump, 0, 1e-3);
    }
    EXPECT_NEAR(forecast.mean[2], 30, 1e-3);
    EXPECT_NEAR(forecast.largest_jump, 0, 1e-3);
  }
}

TEST(Bleed, FollowsARampAlongTheEdge) {
  Scene scene;
  // Red rises by half a level a pixel to the right, so by half a level a sample along the upper side.
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 100; ++x)
      scene.target.at(x, y).r = (50 + 0.5f * static_cast<float>(x)) / 255;
  const int dx = 20;
  const BleedForecast forecast = scene.at(dx, 30);
  for (std::size_t i = 5; i < 35; ++i) {
    const BleedSample& sample = forecast.samples[i];
    EXPECT_EQ(sample.at, (Point{10 + sample.s, 10}));
    const double column = std::floor(sample.at.x) + dx;
    EXPECT_NEAR(sample.mismatch[0], 30 + 0.5 * column, 1e-3);
    EXPECT_NEAR(sample.mismatch[1], 30, 1e-3);
    // Means 4 px before and after lie 5 px apart.
    EXPECT_NEAR(sample.jump, 2.5, 1e-3);
  }
  // Along the right side nothing changes; round the corner it turns.
  EXPECT_NEAR(forecast.samples[55].jump, 0, 1e-3);
}

TEST(Bleed, JumpsWhereTheEdgeCrossesAnObject) {
  Scene scene;
  for (int y = 0; y < 90; ++y)
    for (int x = 60; x < 100; ++x)
      scene.target.at(x, y) = {200.0f / 255, 50.0f / 255, 50.0f / 255, 1};
  // The object begins at column 60: 30 px to the right of the mask's left side when it is moved by 20.
  const BleedForecast forecast = scene.at(20, 0);
  const auto by_jump = [](const BleedSample& a, const BleedSample& b) { return a.jump < b.jump; };
  const auto top = std::max_element(forecast.samples.begin(), forecast.samples.begin() + 40, by_jump);
  EXPECT_NEAR(top->s, 30, 1);
  EXPECT_NEAR(top->jump, 150, 40);
  EXPECT_EQ(forecast.largest_jump, std::max_element(forecast.samples.begin(), forecast.samples.end(), by_jump)->jump);
  EXPECT_NEAR(forecast.samples[10].jump, 0, 1e-3);
}

TEST(Bleed, ReadsTheRingAndNotTheMask) {
  Scene scene;
  // What stands under the mask and in it does not matter.
  for (int y = 10; y < 40; ++y)
    for (int x = 10; x < 50; ++x) {
      scene.source.pixels.at(x - 9, y - 9) = {9, 9, 9, 1};
      scene.target.at(x, y) = {-5, -5, -5, 1};
    }
  const BleedForecast forecast = scene.at(0, 0);
  for (const BleedSample& sample : forecast.samples)
    EXPECT_NEAR(sample.mismatch[0], 30, 1e-3) << sample.s;
}

TEST(Bleed, SumsUpWhatLiesInTheTargetOnly) {
  Scene scene;
  // Bright along the left edge, which is what the target is taken to be beyond it.
  for (int y = 0; y < 90; ++y)
    scene.target.at(0, y) = {1, 1, 1, 1};
  const BleedForecast forecast = scene.at(-30, 0);
  ASSERT_EQ(forecast.samples.size(), 140u);
  for (const BleedSample& sample : forecast.samples)
    EXPECT_EQ(sample.is_seen, sample.at.x >= 30) << sample.at.x;
  EXPECT_GT(forecast.samples[5].norm, 200 * std::sqrt(3.0));
  // Of the bright column itself two samples are seen, of the upper and the lower side.
  EXPECT_LT(forecast.mean[0], 45);
  const BleedForecast outside = scene.at(-300, 0);
  EXPECT_EQ(outside.samples.size(), 140u);
  EXPECT_EQ(outside.largest_norm, 0);
  EXPECT_EQ(outside.largest_jump, 0);
  EXPECT_EQ(outside.mean, (std::array<float, 3>{}));
}

TEST(Bleed, OfRoundAndHangingOutShapesIsFinite) {
  Points circle;
  for (int i = 0; i < 300; ++i)
    circle.push_back({30 + 18.3 * std::cos(i * 0.020943951), 25 + 14.2 * std::sin(i * 0.020943951)});
  Scene scene;
  scene.mask = rasterize_polygon(circle, {0, 0, 100, 100});
  for (const int shift : {-500, -20, 0, 60, 500}) {
    const BleedForecast forecast = scene.at(shift, -shift, circle);
    EXPECT_GT(forecast.samples.size(), 90u);
    for (const BleedSample& sample : forecast.samples)
      EXPECT_NEAR(sample.norm, 30 * std::sqrt(3.0), 1e-3);
  }
}

} // namespace
} // namespace oversketch
