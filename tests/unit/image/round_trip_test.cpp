#include "core/image/image_io.h"
#include "core/image/levels.h"
#include "tests/unit/image/craft.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace oversketch {
namespace {

/// All 256 levels in every channel, in combinations.
Image all_levels(bool alpha) {
  Raster<Rgba> pixels(256, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 256; ++x) {
      const auto level = [&](int k) { return static_cast<float>((x * (2 * k + 1) + y * 67) % 256) / 255.0f; };
      pixels.at(x, y) = {level(0), level(1), level(2), alpha ? level(3) : 1.0f};
    }
  return Image(std::move(pixels));
}

TEST(RoundTrip, EightBitsAreExact) {
  for (const bool alpha : {false, true}) {
    const Image image = all_levels(alpha);
    const auto bytes = encode_png(image);
    ASSERT_TRUE(bytes);
    const auto back = decode_image(*bytes);
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->pixels() == image.pixels());
    EXPECT_EQ(encode_png(*back).value(), *bytes);
  }
}

TEST(RoundTrip, SixteenBitsAreExact) {
  Raster<Rgba> pixels(256, 256);
  for (int i = 0; i < 65536; ++i) {
    const auto level = [&](int k) { return static_cast<float>((i + k * 9001) % 65536) / 65535.0f; };
    pixels.at(i % 256, i / 256) = {level(0), level(1), level(2), level(3)};
  }
  const Image image(std::move(pixels));
  const auto back = decode_image(encode_png(image, BitDepth::k16).value());
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->pixels() == image.pixels());
}

TEST(RoundTrip, ColourUnderFullTransparencyIsKept) {
  const Image image = filled(3, 3, {1, 0, 0, 0});
  EXPECT_TRUE(decode_image(encode_png(image).value())->pixels() == image.pixels());
}

TEST(RoundTrip, AlphaIsWrittenOnlyWhenItShows) {
  const auto color_type = [](const Image& image, BitDepth depth) {
    return std::to_integer<int>(encode_png(image, depth).value()[25]);
  };
  EXPECT_EQ(color_type(filled(2, 2, {1, 1, 1, 1}), BitDepth::k8), 2);
  EXPECT_EQ(color_type(filled(2, 2, {1, 1, 1, 2}), BitDepth::k8), 2);
  EXPECT_EQ(color_type(filled(2, 2, {1, 1, 1, 254.6f / 255}), BitDepth::k8), 2);
  EXPECT_EQ(color_type(filled(2, 2, {1, 1, 1, 254.4f / 255}), BitDepth::k8), 6);
  EXPECT_EQ(color_type(filled(2, 2, {1, 1, 1, 254.6f / 255}), BitDepth::k16), 6);
  Raster<Rgba> one(40, 30);
  one.at(39, 29).a = 0;
  EXPECT_EQ(color_type(Image(one), BitDepth::k8), 6);
}

TEST(RoundTrip, ValuesOutsideAreClampedOnceAndInOrder) {
  const Image image = filled(1, 1, {-0.5f, 1.5f, 0.5f, 1});
  EXPECT_EQ(craft::levels_of(*decode_image(encode_png(image).value())), (std::vector<int>{0, 255, 128, 255}));
}

TEST(RoundTrip, JpegIsCloseAndFullColour) {
  // Single columns of pure red and blue: halved colour resolution would mix them.
  Raster<Rgba> pixels(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      pixels.at(x, y) = x / 8 % 2 == 0 ? Rgba{0.9f, 0.2f, 0.2f, 1} : Rgba{0.2f, 0.2f, 0.9f, 1};
  const Image image(std::move(pixels));
  const auto back = decode_image(encode_jpeg(image).value());
  ASSERT_TRUE(back);
  int worst = 0;
  const auto a = craft::levels_of(image), b = craft::levels_of(*back);
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(a[i] - b[i]));
  EXPECT_LE(worst, 5);
  EXPECT_LT(encode_jpeg(image, 30)->size(), encode_jpeg(image, 95)->size());
}

TEST(RoundTrip, SizesOfEveryRemainder) {
  craft::Random random(4);
  for (int width = 1; width <= 17; ++width)
    for (const int height : {1, 2, 3, 9}) {
      Raster<Rgba> pixels(width, height);
      for (Rgba& p : pixels.values()) {
        const auto level = [&] { return static_cast<float>(random.below(256)) / 255.0f; };
        p = {level(), level(), level(), width % 2 == 0 ? level() : 1.0f};
      }
      const Image image(std::move(pixels));
      const auto back = decode_image(encode_png(image).value());
      ASSERT_TRUE(back);
      EXPECT_TRUE(back->pixels() == image.pixels()) << width << " × " << height;
      const auto jpeg = decode_image(encode_jpeg(image).value());
      ASSERT_TRUE(jpeg);
      EXPECT_EQ(jpeg->rect(), image.rect());
    }
}

} // namespace
} // namespace oversketch
