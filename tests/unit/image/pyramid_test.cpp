#include "core/image/pyramid.h"

#include "core/base/check.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>

namespace oversketch {
namespace {

Image noise(int width, int height, bool opaque) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(0, 1);
  Raster<Rgba> pixels(width, height);
  for (Rgba& p : pixels.values())
    p = {value(random), value(random), value(random), opaque ? 1 : value(random)};
  return Image(std::move(pixels));
}

TEST(ImagePyramid, HalvesUntilOnePixelIsLeft) {
  const ImagePyramid pyramid(noise(37, 6, true));
  ASSERT_EQ(pyramid.top(), 6);
  const int widths[] = {37, 19, 10, 5, 3, 2, 1}, heights[] = {6, 3, 2, 1, 1, 1, 1};
  for (int k = 0; k <= 6; ++k) {
    EXPECT_EQ(pyramid.level(k).width(), widths[k]);
    EXPECT_EQ(pyramid.level(k).height(), heights[k]);
  }
  EXPECT_EQ(&pyramid.level(0), &pyramid.image().pixels());
  EXPECT_EQ(&ImagePyramid(pyramid).level(3), &pyramid.level(3));
  EXPECT_EQ(ImagePyramid(noise(1, 1, true)).top(), 0);
  EXPECT_EQ(ImagePyramid(Image()).top(), 0);
  EXPECT_EQ(ImagePyramid(noise(64, 64, true)).top(), 6);
  EXPECT_THROW((void)pyramid.level(7), BugError);
  EXPECT_THROW((void)pyramid.level(-1), BugError);
}

TEST(ImagePyramid, TheLastPixelIsTheMeanWeighedByAlpha) {
  for (const bool opaque : {true, false}) {
    const Image image = noise(64, 32, opaque);
    double red = 0, alpha = 0;
    for (const Rgba& p : image.pixels().values())
      red += double{p.r} * p.a, alpha += p.a;
    const ImagePyramid pyramid(image);
    // 64 × 32 are two pixels at level 5.
    const Raster<Rgba>& two = pyramid.level(5);
    ASSERT_EQ(two.values().size(), 2U);
    EXPECT_NEAR(0.5 * (two.at(0, 0).a + two.at(1, 0).a), alpha / (64 * 32), 1e-5);
    EXPECT_NEAR(pyramid.level(6).at(0, 0).r, red / alpha, 1e-5);
  }
}

TEST(ImagePyramid, HiddenColoursAreLeftOutAndOddEdgesRepeated) {
  Raster<Rgba> pixels(3, 2, Rgba{9, 9, 9, 0});
  pixels.at(1, 1) = {0.5F, 0.25F, 1, 1};
  pixels.at(2, 0) = {0.2F, 0, 0, 1};
  pixels.at(2, 1) = {0.4F, 0, 0, 1};
  const ImagePyramid pyramid{Image(pixels)};
  EXPECT_EQ(pyramid.level(1).at(0, 0), (Rgba{0.5F, 0.25F, 1, 0.25F}));
  EXPECT_NEAR(pyramid.level(1).at(1, 0).r, 0.3, 1e-6);
  EXPECT_EQ(pyramid.level(1).at(1, 0).a, 1);
  EXPECT_EQ(ImagePyramid(Image(Raster<Rgba>(2, 2, Rgba{9, 9, 9, 0}))).level(1).at(0, 0), (Rgba{0, 0, 0, 0}));
}

TEST(ImagePyramid, SeveralThreadsMayAsk) {
  const ImagePyramid pyramid(noise(200, 150, true));
  std::vector<const Raster<Rgba>*> seen(4);
  {
    std::vector<std::jthread> threads;
    for (auto& level : seen)
      threads.emplace_back([&pyramid, &level] { level = &pyramid.level(5); });
  }
  for (const auto* level : seen)
    EXPECT_EQ(level, seen[0]);
}

} // namespace
} // namespace oversketch
