#include "ui/render/mip_levels.h"

#include "core/base/check.h"

#include <gtest/gtest.h>

#include <random>

namespace oversketch {
namespace {

Raster<Rgba8> random_pixels(int width, int height, unsigned seed, bool opaque) {
  std::mt19937 random(seed);
  Raster<Rgba8> pixels(width, height);
  const auto level = [&] { return static_cast<std::uint8_t>(random() & 255); };
  for (Rgba8& p : pixels.values())
    p = {level(), level(), level(), opaque ? std::uint8_t{255} : level()};
  return pixels;
}

MipLevels levels_of(const Raster<Rgba8>& pixels) {
  MipLevels levels(pixels.width(), pixels.height());
  levels.put(pixels.rect(), pixels.values().data(), pixels.width());
  return levels;
}

TEST(MipLevels, pixels_outside_are_a_mistake) {
  MipLevels levels(10, 10);
  const Raster<Rgba8> pixels(20, 20);
  EXPECT_THROW(levels.put({5, 5, 6, 2}, pixels.values().data(), 20), BugError);
  EXPECT_THROW(levels.put({0, 0, 0, 0}, pixels.values().data(), 20), BugError);
}

TEST(MipLevels, each_level_is_the_mean_of_the_one_below) {
  const Raster<Rgba8> pixels = random_pixels(100, 37, 1, true);
  const MipLevels levels = levels_of(pixels);
  EXPECT_EQ(levels.level(0).width(), 128);
  EXPECT_EQ(levels.level(0).height(), 64);
  EXPECT_EQ(levels.level(6).width(), 2);
  for (int k = 1; k < MipLevels::kCount; ++k)
    for (int y = 0; y < levels.level(k).height(); ++y)
      for (int x = 0; x < levels.level(k).width(); ++x) {
        const auto& below = levels.level(k - 1);
        const double mean = (below.at(2 * x, 2 * y).g + below.at(2 * x + 1, 2 * y).g + below.at(2 * x, 2 * y + 1).g +
                             below.at(2 * x + 1, 2 * y + 1).g) /
                            4.0;
        ASSERT_NEAR(levels.level(k).at(x, y).g, mean, 0.51);
      }
  EXPECT_EQ(levels.level(0).at(120, 60), pixels.at(99, 36)) << "the edge is repeated";
}

TEST(MipLevels, what_is_transparent_lends_no_colour) {
  Raster<Rgba8> pixels(2, 2, Rgba8{255, 0, 0, 0});
  pixels.at(1, 1) = {10, 20, 30, 255};
  const Rgba8 mean = levels_of(pixels).level(1).at(0, 0);
  EXPECT_EQ(mean.r, 10);
  EXPECT_EQ(mean.g, 20);
  EXPECT_EQ(mean.a, 64);
}

TEST(MipLevels, parts_that_are_put_anew_give_what_all_at_once_gives) {
  Raster<Rgba8> pixels = random_pixels(150, 90, 2, false);
  MipLevels levels = levels_of(pixels);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const int x = static_cast<int>(random() % 150), y = static_cast<int>(random() % 90);
    const Rect rect = {x, y, 1 + static_cast<int>(random() % static_cast<unsigned>(150 - x)),
                       1 + static_cast<int>(random() % static_cast<unsigned>(90 - y))};
    const Raster<Rgba8> part = random_pixels(rect.width, rect.height, static_cast<unsigned>(i) + 9, i % 2 == 0);
    for (int row = 0; row < rect.height; ++row)
      std::ranges::copy(part.row(row), pixels.row(y + row).begin() + x);
    const Rect changed = levels.put(rect, part.values().data(), part.width());
    EXPECT_EQ(intersect(changed, rect), rect);
  }
  const MipLevels at_once = levels_of(pixels);
  for (int k = 0; k < MipLevels::kCount; ++k)
    EXPECT_EQ(levels.level(k), at_once.level(k)) << k;
}

} // namespace
} // namespace oversketch
