#include "core/image/image_io.h"
#include "tests/unit/image/craft.h"

#include <gtest/gtest.h>
#include <tuple>

namespace oversketch {
namespace {

using craft::Bytes;
using craft::code_of;
using craft::Writer;

craft::Png random_png(int color_type, int depth, bool interlaced, std::uint64_t seed) {
  craft::Random random(seed);
  craft::Png png{.width = 13, .height = 11, .depth = depth, .color_type = color_type, .interlaced = interlaced};
  png.samples.resize(std::size_t{png.width} * png.height * static_cast<std::size_t>(craft::png_channels(color_type)));
  for (unsigned& sample : png.samples)
    sample = static_cast<unsigned>(random.below(std::size_t{1} << depth));
  return png;
}

/// What the specification says a pixel is, in parts of the depth's highest value.
Rgba expected_pixel(const craft::Png& png, std::size_t pixel, const std::vector<std::array<int, 4>>& palette) {
  const auto channels = static_cast<std::size_t>(craft::png_channels(png.color_type));
  const unsigned* s = &png.samples[pixel * channels];
  if (png.color_type == 3) {
    const auto& p = palette.at(s[0]);
    return {static_cast<float>(p[0]) / 255.0f, static_cast<float>(p[1]) / 255.0f, static_cast<float>(p[2]) / 255.0f,
            static_cast<float>(p[3]) / 255.0f};
  }
  const auto value = [&](std::size_t c) {
    return static_cast<float>(s[c]) / static_cast<float>((1U << png.depth) - 1);
  };
  const std::size_t g = channels >= 3 ? 1 : 0, b = channels >= 3 ? 2 : 0;
  return {value(0), value(g), value(b), channels % 2 == 0 ? value(channels - 1) : 1.0f};
}

void expect_near(const Rgba& a, const Rgba& b, const std::string& where) {
  EXPECT_NEAR(a.r, b.r, 1e-7f) << where;
  EXPECT_NEAR(a.g, b.g, 1e-7f) << where;
  EXPECT_NEAR(a.b, b.b, 1e-7f) << where;
  EXPECT_NEAR(a.a, b.a, 1e-7f) << where;
}

class PngKind : public testing::TestWithParam<std::tuple<int, int, bool>> {};

TEST_P(PngKind, DecodesToTheSpecifiedValues) {
  const auto [color_type, depth, interlaced] = GetParam();
  craft::Png png = random_png(color_type, depth, interlaced, 7);
  std::vector<std::array<int, 4>> palette;
  if (color_type == 3) {
    Writer plte, trns;
    for (int i = 0; i < 1 << depth; ++i) {
      // The last entries have no alpha of their own: opaque.
      const bool last = i > 0 && i + 1 == 1 << depth;
      palette.push_back({i * 53 % 256, i * 91 % 256, i * 7 % 256, last ? 255 : i * 29 % 256});
      plte.u8(palette.back()[0]).u8(palette.back()[1]).u8(palette.back()[2]);
      if (!last) trns.u8(palette.back()[3]);
    }
    png.before_pixels = craft::png_chunk("PLTE", plte.done());
    const Bytes alpha = craft::png_chunk("tRNS", trns.done());
    png.before_pixels.insert(png.before_pixels.end(), alpha.begin(), alpha.end());
  }
  const auto image = decode_image(craft::make_png(png));
  ASSERT_TRUE(image) << to_string(image.error());
  ASSERT_EQ(image->width(), 13);
  ASSERT_EQ(image->height(), 11);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 13; ++x)
      expect_near(image->at(x, y), expected_pixel(png, static_cast<std::size_t>(y * 13 + x), palette),
                  std::to_string(x) + ", " + std::to_string(y));
}

INSTANTIATE_TEST_SUITE_P(All, PngKind,
                         testing::Values(std::tuple(0, 1, false), std::tuple(0, 2, false), std::tuple(0, 4, false),
                                         std::tuple(0, 8, false), std::tuple(0, 16, false), std::tuple(2, 8, false),
                                         std::tuple(2, 16, false), std::tuple(3, 1, false), std::tuple(3, 2, false),
                                         std::tuple(3, 4, false), std::tuple(3, 8, false), std::tuple(4, 8, false),
                                         std::tuple(4, 16, false), std::tuple(6, 8, false), std::tuple(6, 16, false),
                                         std::tuple(0, 1, true), std::tuple(0, 2, true), std::tuple(0, 4, true),
                                         std::tuple(0, 8, true), std::tuple(0, 16, true), std::tuple(2, 8, true),
                                         std::tuple(2, 16, true), std::tuple(3, 1, true), std::tuple(3, 2, true),
                                         std::tuple(3, 4, true), std::tuple(3, 8, true), std::tuple(4, 8, true),
                                         std::tuple(4, 16, true), std::tuple(6, 8, true), std::tuple(6, 16, true)));

TEST(Png, OneColourCanBeTransparent) {
  for (const int depth : {1, 2, 4, 8, 16})
    for (const int color_type : {0, 2}) {
      if (color_type == 2 && depth < 8) continue;
      craft::Png png = random_png(color_type, depth, false, 3);
      const auto channels = static_cast<std::size_t>(craft::png_channels(color_type));
      Writer key;
      for (std::size_t c = 0; c < channels; ++c)
        key.u16_big(png.samples[5 * channels + c]);
      png.before_pixels = craft::png_chunk("tRNS", key.done());
      const auto image = decode_image(craft::make_png(png));
      ASSERT_TRUE(image);
      for (std::size_t i = 0; i < 13 * 11; ++i) {
        bool same = true;
        for (std::size_t c = 0; c < channels; ++c)
          same = same && png.samples[i * channels + c] == png.samples[5 * channels + c];
        EXPECT_EQ(image->pixels().values()[i].a, same ? 0.0f : 1.0f) << "depth " << depth << ", pixel " << i;
      }
    }
}

TEST(Png, EveryWrongByteIsNoticed) {
  craft::Png png = random_png(2, 8, false, 5);
  png.before_pixels = craft::png_chunk("tEXt", Writer().text({"Title\0fish", 10}).done());
  png.after_pixels = craft::png_chunk("tIME", Writer().u16_big(2024).u8(5).u8(6).u8(7).u8(8).u8(9).done());
  const Bytes good = craft::make_png(png);
  ASSERT_TRUE(decode_image(good));
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const unsigned flip : {1U, 0x20U, 0x80U, 0xffU}) {
      Bytes bad = good;
      bad[i] ^= static_cast<std::byte>(flip);
      EXPECT_FALSE(decode_image(bad)) << "byte " << i << " of " << good.size() << " ^ " << flip;
    }
}

TEST(Png, ManyForeignChunksAreNoObstacle) {
  craft::Png png = random_png(6, 8, false, 6);
  const Bytes frame = craft::png_chunk("fdAT", Writer().zeros(30).done());
  for (int i = 0; i < 3000; ++i)
    png.after_pixels.insert(png.after_pixels.end(), frame.begin(), frame.end());
  const auto image = decode_image(craft::make_png(png));
  ASSERT_TRUE(image) << to_string(image.error());
  EXPECT_EQ(image->width(), 13);
}

TEST(Png, TextThatUnpacksToMuchIsNoObstacle) {
  // Megabytes of text and profiles are skipped, not kept.
  craft::Png png = random_png(6, 8, false, 6);
  png.before_pixels =
      craft::png_chunk("tEXt", Writer().text({"Comment\0", 8}).text(std::string(3'000'000, 'x')).done());
  EXPECT_TRUE(decode_image(craft::make_png(png)));
}

} // namespace
} // namespace oversketch
