#include "core/image/image_io.h"
#include "core/image/srgb.h"
#include "tests/unit/image/craft.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace oversketch {
namespace {

using craft::Bytes;
using craft::levels_of;
using craft::Writer;
using Levels = std::vector<int>;

Levels decoded(const Bytes& bytes) {
  const auto image = decode_image(bytes);
  EXPECT_TRUE(image) << to_string(image.error());
  return image ? levels_of(*image) : Levels();
}

constexpr Rgba kNoPixel{-1, -1, -1, -1};

/// The centre of patch p of the files in tests/data/images.
Rgba patch(const Image& image, int p) {
  return p < 6 && image.width() == 48 ? image.at(p % 3 * 16 + 8, p / 3 * 16 + 8) : kNoPixel;
}

float ink(int p, int channel) {
  return static_cast<float>((37 * p + 60 * channel) % 256);
}

TEST(Jpeg, ColourProgressiveAndArithmetic) {
  for (const char* name : {"progressive.jpg", "arithmetic.jpg"}) {
    const auto image = decode_image(craft::read_data(name));
    ASSERT_TRUE(image) << name;
    for (int p = 0; p < 6; ++p) {
      EXPECT_NEAR(patch(*image, p).r * 255, ink(p, 0), 2) << name;
      EXPECT_NEAR(patch(*image, p).g * 255, ink(p, 1), 2) << name;
      EXPECT_NEAR(patch(*image, p).b * 255, ink(p, 2), 2) << name;
      EXPECT_EQ(patch(*image, p).a, 1) << name;
    }
  }
}

TEST(Jpeg, GreyWithRestartMarkers) {
  const auto image = decode_image(craft::read_data("grey_restart.jpg"));
  ASSERT_TRUE(image);
  for (int p = 0; p < 6; ++p) {
    EXPECT_NEAR(patch(*image, p).r * 255, ink(p, 0), 2);
    EXPECT_EQ(patch(*image, p).r, patch(*image, p).g);
    EXPECT_EQ(patch(*image, p).r, patch(*image, p).b);
  }
}

TEST(Jpeg, InksBecomeLight) {
  for (const char* name : {"cmyk_adobe.jpg", "ycck_adobe.jpg", "cmyk_plain.jpg"}) {
    const bool inverted = name[5] == 'a';
    const auto image = decode_image(craft::read_data(name));
    ASSERT_TRUE(image) << name;
    for (int p = 0; p < 6; ++p) {
      const auto light = [&](int c) { return inverted ? ink(p, c) : 255 - ink(p, c); };
      EXPECT_NEAR(patch(*image, p).r * 255, light(0) * light(3) / 255, 3) << name << " " << p;
      EXPECT_NEAR(patch(*image, p).g * 255, light(1) * light(3) / 255, 3) << name << " " << p;
      EXPECT_NEAR(patch(*image, p).b * 255, light(2) * light(3) / 255, 3) << name << " " << p;
    }
  }
}

TEST(Bmp, TrueColourBothWaysUp) {
  // Two pixels wide: 6 bytes and 2 to fill up; the last row's may be missing.
  const auto rows = [](Writer file) {
    return file.u8(3).u8(2).u8(1).u8(6).u8(5).u8(4).u16(0).u8(9).u8(8).u8(7).u8(12).u8(11).u8(10).done();
  };
  EXPECT_EQ(decoded(rows(craft::begin_bmp({.width = 2, .height = -2}))),
            (Levels{1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 255}));
  EXPECT_EQ(decoded(rows(craft::begin_bmp({.width = 2, .height = 2}))),
            (Levels{7, 8, 9, 255, 10, 11, 12, 255, 1, 2, 3, 255, 4, 5, 6, 255}));
}

TEST(Bmp, PalettesOfEveryDepth) {
  for (const unsigned bits : {1U, 4U, 8U}) {
    const unsigned colors = 1U << bits;
    Writer file = craft::begin_bmp({.width = 11, .height = 1, .bits = bits, .palette = colors});
    for (unsigned i = 0; i < colors; ++i)
      file.u8(i).u8(255 - i).u8(i * 3).u8(0);
    Levels expected;
    unsigned packed = 0, held = 0;
    for (unsigned x = 0; x < 11; ++x) {
      const unsigned index = x * 7 % colors;
      expected.insert(expected.end(),
                      {static_cast<int>(index * 3 % 256), static_cast<int>(255 - index), static_cast<int>(index), 255});
      packed = packed << bits | index;
      held += bits;
      if (held == 8) file.u8(packed), packed = held = 0;
    }
    if (held > 0) file.u8(packed << (8 - held));
    EXPECT_EQ(decoded(file.done()), expected) << bits;
  }
}

TEST(Bmp, MasksAndSixteenBits) {
  EXPECT_EQ(decoded(craft::begin_bmp({.bits = 16}).u16(31 << 10 | 1 << 5 | 16).done()), (Levels{255, 8, 132, 255}));
  const craft::BmpHeader rgb565{.bits = 16, .compression = 3, .masks = {0xf800, 0x07e0, 0x001f}};
  EXPECT_EQ(decoded(craft::begin_bmp(rgb565).u16(31 << 11 | 32 << 5 | 1).done()), (Levels{255, 130, 8, 255}));
  for (const unsigned header_bytes : {108U, 124U}) {
    const craft::BmpHeader abgr{
        .bits = 32, .compression = 3, .masks = {0xff, 0xff00, 0xff0000, 0xff000000}, .header_bytes = header_bytes};
    EXPECT_EQ(decoded(craft::begin_bmp(abgr).u32(0x80030201).done()), (Levels{1, 2, 3, 128}));
    EXPECT_EQ(decoded(craft::begin_bmp(abgr).u32(0x00030201).done()), (Levels{1, 2, 3, 0}));
  }
  // Without masks the fourth byte means nothing.
  for (const unsigned header_bytes : {40U, 108U})
    EXPECT_EQ(decoded(craft::begin_bmp({.width = 2, .bits = 32, .header_bytes = header_bytes})
                          .u32(0x00010203)
                          .u32(0x70010203)
                          .done()),
              (Levels{1, 2, 3, 255, 1, 2, 3, 255}));
}

TEST(Bmp, PalettesMayBeShortAndStandApart) {
  Writer file = craft::begin_bmp({.width = 3, .height = 2, .bits = 4, .palette = 2, .gap = 8});
  file.u8(3).u8(2).u8(1).u8(0).u8(6).u8(5).u8(4).u8(0).zeros(8);
  file.u8(0x10).u8(0x00).u16(0).u8(0x01).u8(0x1f).u16(0);
  EXPECT_EQ(decoded(file.done()), (Levels{1, 2, 3, 255, 4, 5, 6, 255, 4, 5, 6, 255, //
                                          4, 5, 6, 255, 1, 2, 3, 255, 1, 2, 3, 255}));
}

TEST(Bmp, TheOldestHeader) {
  Writer file;
  file.text("BM").u32(0).u32(0).u32(14 + 12).u32(12).u16(2).u16(1).u16(1).u16(24);
  file.u8(10).u8(20).u8(30).u8(40).u8(50).u8(60).zeros(2);
  EXPECT_EQ(decoded(file.done()), (Levels{30, 20, 10, 255, 60, 50, 40, 255}));
}

TEST(Tga, EveryKindOfPixel) {
  EXPECT_EQ(decoded(craft::begin_tga({.bits = 24}).u8(3).u8(2).u8(1).done()), (Levels{1, 2, 3, 255}));
  EXPECT_EQ(decoded(craft::begin_tga({.bits = 32, .descriptor = 0x28}).u32(0x80010203).done()), (Levels{1, 2, 3, 128}));
  // The header counts no alpha bits: the fourth byte is not alpha.
  EXPECT_EQ(decoded(craft::begin_tga({.bits = 32}).u32(0x00010203).done()), (Levels{1, 2, 3, 255}));
  EXPECT_EQ(decoded(craft::begin_tga({.bits = 15}).u16(31 << 10 | 1 << 5 | 16).done()), (Levels{255, 8, 131, 255}));
  // The sixteenth bit is not alpha, whatever the header says.
  EXPECT_EQ(decoded(craft::begin_tga({.width = 2, .bits = 16, .descriptor = 0x21}).u16(0xfc00).u16(0x03e0).done()),
            (Levels{255, 0, 0, 255, 0, 255, 0, 255}));
  EXPECT_EQ(decoded(craft::begin_tga({.type = 3, .bits = 8}).u8(77).done()), (Levels{77, 77, 77, 255}));
  EXPECT_EQ(decoded(craft::begin_tga({.type = 3, .bits = 16, .descriptor = 0x28}).u8(77).u8(5).done()),
            (Levels{77, 77, 77, 5}));
  Writer indexed = craft::begin_tga({.type = 1, .map_count = 2, .map_bits = 24, .width = 2, .bits = 8});
  EXPECT_EQ(decoded(indexed.u8(3).u8(2).u8(1).u8(6).u8(5).u8(4).u8(1).u8(0).done()),
            (Levels{4, 5, 6, 255, 1, 2, 3, 255}));
  Writer alpha = craft::begin_tga({.type = 1, .map_count = 1, .map_bits = 32, .bits = 16, .descriptor = 0x28});
  EXPECT_EQ(decoded(alpha.u32(0x80010203).u16(0).done()), (Levels{1, 2, 3, 128}));
}

TEST(Tga, RunsAndAllFourOrigins) {
  // 3 × 2: a run of four pixels over the row's end, and two pixels one by one.
  const std::array<std::pair<unsigned, Levels>, 4> origins{
      {{0x20, {7, 7, 7, 7, 1, 2}}, {0x30, {7, 7, 7, 2, 1, 7}}, {0x00, {7, 1, 2, 7, 7, 7}}, {0x10, {2, 1, 7, 7, 7, 7}}}};
  for (const auto& [descriptor, greys] : origins) {
    const craft::TgaHeader header{.type = 11, .width = 3, .height = 2, .bits = 8, .descriptor = descriptor};
    Levels expected;
    for (const int grey : greys)
      expected.insert(expected.end(), {grey, grey, grey, 255});
    EXPECT_EQ(decoded(craft::begin_tga(header).u8(0x83).u8(7).u8(0x01).u8(1).u8(2).done()), expected) << descriptor;
  }
}

float encoded(int mantissa, int exponent) {
  return static_cast<float>(srgb_from_linear(std::ldexp(mantissa, exponent - 136)));
}

TEST(Hdr, ValuesAreEncodedAndContinuedAboveOne) {
  // Every mantissa and exponent: also the largest, which is still finite.
  for (int exponent = 0; exponent < 256; ++exponent) {
    Writer file = craft::begin_hdr("-Y 1 +X 255");
    file.u8(2).u8(2).u8(0).u8(255);
    for (int plane = 0; plane < 3; ++plane) {
      file.u8(128);
      for (int m = 1; m <= 128; ++m)
        file.u8(m);
      file.u8(127);
      for (int m = 129; m <= 255; ++m)
        file.u8(m);
    }
    file.u8(128 + 127).u8(exponent).u8(128 + 127).u8(exponent).u8(128 + 1).u8(exponent);
    const auto image = decode_image(file.done());
    ASSERT_TRUE(image) << to_string(image.error());
    for (int m = 1; m <= 255; ++m) {
      const float expected = exponent == 0 ? 0.0f : encoded(m, exponent);
      EXPECT_NEAR(image->at(m - 1, 0).g, expected, 3e-7f * (1 + expected)) << m << " " << exponent;
    }
  }
  EXPECT_GT(encoded(255, 140), 1.0f);
}

TEST(Hdr, Flat) {
  Writer flat = craft::begin_hdr("-Y 1 +X 2");
  const auto plain = decode_image(flat.u8(128).u8(64).u8(32).u8(129).u8(0).u8(0).u8(0).u8(0).done());
  ASSERT_TRUE(plain) << to_string(plain.error());
  EXPECT_NEAR(plain->at(0, 0).r, 1, 1e-6);
  EXPECT_NEAR(plain->at(0, 0).g, encoded(64, 129), 1e-6);
  EXPECT_EQ(plain->at(1, 0), (Rgba{0, 0, 0, 1}));
}

/// Flat and in runs: `width` pixels of which each has its own exponent.
Bytes exponents_hdr(int width, int height, bool runs) {
  Writer file = craft::begin_hdr("-Y " + std::to_string(height) + " +X " + std::to_string(width),
                                 "# a line of no matter\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n");
  for (int y = 0; y < height; ++y) {
    const auto exponent = [&](int x) { return static_cast<unsigned>(100 + y * width + x); };
    for (int x = 0; !runs && x < width; ++x)
      file.u8(128).u8(128).u8(128).u8(exponent(x));
    if (!runs) continue;
    file.u8(2).u8(2).u8(0).u8(static_cast<unsigned>(width));
    for (int plane = 0; plane < 3; ++plane)
      file.u8(128 + static_cast<unsigned>(width)).u8(128);
    file.u8(static_cast<unsigned>(width));
    for (int x = 0; x < width; ++x)
      file.u8(exponent(x));
  }
  return file.done();
}

TEST(Hdr, RowsRunFromTheTop) {
  for (const bool runs : {false, true}) {
    const int width = runs ? 9 : 3;
    const auto image = decode_image(exponents_hdr(width, 4, runs));
    ASSERT_TRUE(image) << to_string(image.error());
    ASSERT_EQ(image->width(), width);
    ASSERT_EQ(image->height(), 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < width; ++x) {
        const float expected = encoded(128, 100 + y * width + x);
        EXPECT_NEAR(image->at(x, y).r, expected, 3e-7f * (1 + expected));
        EXPECT_EQ(image->at(x, y).r, image->at(x, y).b);
      }
  }
}

} // namespace
} // namespace oversketch
