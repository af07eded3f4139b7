#include "core/image/compare.h"
#include "core/image/levels.h"
#include "core/image/resample.h"
#include "core/image/srgb.h"
#include "tests/unit/image/craft.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace oversketch {
namespace {

using craft::code_of;

Image noisy(int width, int height, std::uint64_t seed) {
  craft::Random random(seed);
  Raster<Rgba> pixels(width, height);
  for (Rgba& p : pixels.values())
    p = {random.unit(), random.unit(), random.unit(), random.unit()};
  return Image(std::move(pixels));
}

TEST(Values, BugsAreCaught) {
  const Image image = filled(4, 3, {});
  EXPECT_THROW((void)downscaled(image, 0, 3), BugError);
  EXPECT_THROW((void)downscaled(image, 4, 4), BugError);
  EXPECT_THROW((void)downscaled(Image(), 1, 1), BugError);
  EXPECT_THROW((void)filled(-1, 3, {}), BugError);
  EXPECT_THROW((void)difference_image(image, filled(3, 4, {})), BugError);
  std::vector<std::uint8_t> few(3);
  EXPECT_THROW(to_levels8(image.pixels().values(), few), BugError);
  const auto differs = compare(image, filled(3, 4, {}));
  ASSERT_EQ(code_of(differs), "image.size-differs");
  EXPECT_NE(differs.error().sentence.find("4 × 3"), std::string::npos);
}

TEST(Srgb, KnownValuesInverseAndSymmetry) {
  EXPECT_EQ(srgb_from_linear(0), 0);
  EXPECT_NEAR(srgb_from_linear(1), 1, 1e-15);
  // Middle grey of IEC 61966-2-1: half of the light is level 188 (187.52), level 128 is 21.6 % of it.
  EXPECT_NEAR(srgb_from_linear(0.5) * 255, 187.516, 1e-3);
  EXPECT_NEAR(linear_from_srgb(128 / 255.0), 0.215861, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.002), 0.02584, 1e-12);
  double before = -1e9;
  for (double x = -20; x <= 20; x += 0.0037) {
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(x)), x, 1e-7 * (1 + std::abs(x)));
    EXPECT_EQ(srgb_from_linear(-x), -srgb_from_linear(x));
    EXPECT_EQ(linear_from_srgb(-x), -linear_from_srgb(x));
    EXPECT_GT(srgb_from_linear(x), before);
    before = srgb_from_linear(x);
  }
  EXPECT_NEAR(srgb_from_linear(std::nextafter(0.0031308, 1.0)), srgb_from_linear(0.0031308), 1e-7);
}

TEST(Levels, RoundToNearestAndClamp) {
  Raster<Rgba> pixels(2, 1);
  pixels.at(0, 0) = {-3, 0.49f / 255, 0.51f / 255, 1e9f};
  pixels.at(1, 0) = {254.49f / 255, 254.51f / 255, 1, -0.0f};
  EXPECT_EQ(to_rgba8(pixels), (std::vector<std::uint8_t>{0, 0, 1, 255, 254, 255, 255, 0}));
  std::vector<std::uint16_t> wide(8);
  to_levels16(pixels.values(), wide);
  EXPECT_EQ(wide[0], 0);
  EXPECT_EQ(wide[1], 126);
  EXPECT_EQ(wide[3], 65535);
  EXPECT_EQ(wide[6], 65535);
}

TEST(Levels, FinitenessOfEveryChannel) {
  EXPECT_TRUE(is_finite(noisy(13, 7, 1).pixels().values()));
  EXPECT_TRUE(is_finite({}));
  const float largest = std::numeric_limits<float>::max();
  EXPECT_TRUE(is_finite(filled(9, 9, {largest, -largest, largest, largest}).pixels().values()));
}

TEST(Compare, CountsWhatAViewerSees) {
  Raster<Rgba> pixels(4, 3, {0.5f, 0.5f, 0.5f, 1});
  const Image a{Raster<Rgba>(pixels)};
  pixels.at(1, 1).g += 3.0f / 255;
  pixels.at(3, 1).a -= 10.0f / 255;
  pixels.at(2, 2).b -= 10.0f / 255;
  pixels.at(0, 0).r += 0.1f / 255;
  const auto d = compare(a, Image(pixels));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->max_levels, 10);
  EXPECT_EQ(d->differing, 3);
  EXPECT_EQ(d->x, 3);
  EXPECT_EQ(d->y, 1);
  EXPECT_DOUBLE_EQ(d->mean_levels, 23.0 / 48);
  const Image shown = difference_image(a, Image(pixels), 5);
  EXPECT_FLOAT_EQ(shown.at(1, 1).g, 15.0f / 255);
  EXPECT_EQ(shown.at(1, 1).r, 0);
  EXPECT_FLOAT_EQ(shown.at(3, 1).r, 50.0f / 255);
  EXPECT_EQ(shown.at(3, 1).a, 1);
}

TEST(Compare, RelationsOnNoise) {
  const Image a = noisy(31, 17, 2), b = noisy(31, 17, 3);
  const auto ab = compare(a, b).value(), ba = compare(b, a).value(), aa = compare(a, a).value();
  EXPECT_EQ(ab.max_levels, ba.max_levels);
  EXPECT_EQ(ab.mean_levels, ba.mean_levels);
  EXPECT_EQ(ab.differing, ba.differing);
  EXPECT_EQ(aa.max_levels, 0);
  EXPECT_EQ(aa.mean_levels, 0);
  EXPECT_EQ(aa.differing, 0);
  // Beyond white is white.
  EXPECT_EQ(compare(filled(2, 2, {5, 1, -1, 1}), filled(2, 2, {1, 3, 0, 1}))->differing, 0);
  EXPECT_EQ(compare(Image(), Image())->mean_levels, 0);
}

TEST(Downscaled, HalvesByHand) {
  Raster<Rgba> pixels(4, 2);
  for (int i = 0; i < 8; ++i)
    pixels.at(i % 4, i / 4) = {static_cast<float>(i), 1, 0, 1};
  const Image half = downscaled(Image(pixels), 2, 1);
  EXPECT_EQ(half.at(0, 0), (Rgba{2.5f, 1, 0, 1}));
  EXPECT_EQ(half.at(1, 0), (Rgba{4.5f, 1, 0, 1}));
  // 3 to 2: each takes one and a half.
  Raster<Rgba> three(3, 1);
  for (int i = 0; i < 3; ++i)
    three.at(i, 0) = {static_cast<float>(i * i), 0, 0, 1};
  EXPECT_NEAR(downscaled(Image(three), 2, 1).at(0, 0).r, 0.5 / 1.5, 1e-6);
  EXPECT_NEAR(downscaled(Image(three), 2, 1).at(1, 0).r, 4.5 / 1.5, 1e-6);
}

TEST(Downscaled, AgreesWithTheDefinitionAndKeepsTheMean) {
  const Image image = noisy(37, 23, 5);
  for (const auto& [width, height] : {std::pair(36, 22), std::pair(19, 23), std::pair(5, 7), std::pair(1, 1)}) {
    const Image small = downscaled(image, width, height);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        double alpha = 0, red = 0, area = 0;
        const double x0 = 37.0 * u / width, x1 = 37.0 * (u + 1) / width, y0 = 23.0 * v / height,
                     y1 = 23.0 * (v + 1) / height;
        for (int y = 0; y < 23; ++y)
          for (int x = 0; x < 37; ++x) {
            const double part = std::max(0.0, std::min(x1, x + 1.0) - std::max<double>(x0, x)) *
                                std::max(0.0, std::min(y1, y + 1.0) - std::max<double>(y0, y));
            area += part;
            alpha += part * image.at(x, y).a;
            red += part * image.at(x, y).a * image.at(x, y).r;
          }
        EXPECT_NEAR(small.at(u, v).a, alpha / area, 1e-6);
        EXPECT_NEAR(small.at(u, v).r, red / alpha, 1e-6);
      }
  }
}

TEST(Downscaled, ColourOfTransparentPixelsDoesNotLeakAndOneColourStays) {
  Raster<Rgba> pixels(8, 8, {1, 0, 0, 0});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 5; ++x)
      pixels.at(x, y) = {0.1f, 0.7f, 0.3f, 1};
  const Image small = downscaled(Image(pixels), 3, 3);
  EXPECT_FLOAT_EQ(small.at(1, 1).r, 0.1f);
  EXPECT_FLOAT_EQ(small.at(1, 1).g, 0.7f);
  EXPECT_LT(small.at(1, 1).a, 1);
  EXPECT_EQ(small.at(2, 1), (Rgba{0, 0, 0, 0}));
  const Image image = noisy(9, 4, 6);
  EXPECT_TRUE(downscaled(image, 9, 4).pixels() == image.pixels());
}

TEST(Image, HashFollowsContentAndSize) {
  const Image a = noisy(6, 4, 1), b = noisy(6, 4, 1);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.content_hash(), b.content_hash());
  EXPECT_FALSE(a == noisy(4, 6, 1));
  EXPECT_FALSE(filled(6, 4, {}) == filled(4, 6, {}));
  Raster<Rgba> changed = a.pixels();
  changed.at(5, 3).a += 1e-6f;
  EXPECT_FALSE(Image(changed) == a);
  EXPECT_TRUE(Image().empty());
}

} // namespace
} // namespace oversketch
