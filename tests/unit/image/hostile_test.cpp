#include "core/image/image_io.h"
#include "core/image/levels.h"
#include "tests/unit/image/craft.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace oversketch {
namespace {

using craft::Bytes;
using craft::Writer;

struct Sample {
  std::string name;
  Bytes bytes;
  /// Bytes at the end that no pixel needs: without them the same picture is read.
  std::size_t spare = 0;
};

Image noise_picture(int width, int height, bool alpha) {
  craft::Random random(21);
  Raster<Rgba> pixels(width, height);
  for (Rgba& p : pixels.values())
    p = {random.unit(), random.unit(), random.unit(), alpha ? random.unit() : 1.0f};
  return Image(std::move(pixels));
}

Bytes random_bytes(std::size_t count, std::uint64_t seed) {
  craft::Random random(seed);
  Writer out;
  for (std::size_t i = 0; i < count; ++i)
    out.u8(static_cast<unsigned>(random.next() >> 56));
  return out.done();
}

Bytes packed_tga() {
  Writer file = craft::begin_tga({.type = 10, .width = 9, .height = 5, .bits = 32, .descriptor = 0x28});
  for (int i = 0; i < 5; ++i)
    file.u8(0x85).u32(0x80102030).u8(2).bytes(random_bytes(12, 3));
  return file.done();
}

Bytes indexed_tga() {
  Writer file = craft::begin_tga({.type = 9, .map_count = 4, .map_bits = 24, .width = 6, .height = 6, .bits = 8});
  file.bytes(random_bytes(12, 4));
  for (unsigned i = 0; i < 9; ++i)
    file.u8(0x81).u8(i % 4).u8(1).u8(i % 3).u8(3);
  return file.done();
}

Bytes indexed_bmp() {
  Writer file = craft::begin_bmp({.width = 9, .height = 4, .bits = 4, .palette = 16});
  return file.bytes(random_bytes(64, 5)).bytes(random_bytes(4 * 8, 6)).done();
}

Bytes masked_bmp() {
  Writer file = craft::begin_bmp({.width = 4,
                                  .height = -4,
                                  .bits = 32,
                                  .compression = 3,
                                  .masks = {0xff, 0xff00, 0xff0000, 0xff000000},
                                  .header_bytes = 124});
  return file.bytes(random_bytes(64, 8)).done();
}

Bytes packed_hdr() {
  Writer file = craft::begin_hdr("-Y 4 +X 12");
  for (int y = 0; y < 4; ++y) {
    file.u8(2).u8(2).u8(0).u8(12);
    for (int plane = 0; plane < 4; ++plane)
      file.u8(128 + 5).u8(130).u8(7).bytes(random_bytes(7, 9));
  }
  return file.done();
}

std::vector<Sample> samples() {
  craft::Png palette{.width = 7, .height = 5, .depth = 2, .color_type = 3, .interlaced = true};
  for (unsigned i = 0; i < 35; ++i)
    palette.samples.push_back(i % 4);
  palette.before_pixels = craft::png_chunk("PLTE", random_bytes(12, 1));
  palette.after_pixels = craft::png_chunk("eXIf", craft::tiff_block(6));
  return {{"png 8", encode_png(noise_picture(9, 7, true)).value()},
          {"png 16", encode_png(noise_picture(5, 4, false), BitDepth::k16).value()},
          {"png palette", craft::make_png(palette)},
          {"jpeg", craft::with_app1(encode_jpeg(noise_picture(24, 20, false), 90).value(), craft::exif_block(6))},
          {"jpeg progressive", craft::read_data("progressive.jpg")},
          {"jpeg arithmetic", craft::read_data("arithmetic.jpg")},
          {"jpeg restart", craft::read_data("grey_restart.jpg")},
          {"jpeg cmyk", craft::read_data("cmyk_adobe.jpg")},
          {"bmp 24", craft::begin_bmp({.width = 5, .height = 3}).bytes(random_bytes(48, 2)).done(), 1},
          {"bmp 4", indexed_bmp(), 3},
          {"bmp masks", masked_bmp()},
          {"bmp 16", craft::begin_bmp({.width = 3, .height = 3, .bits = 16}).bytes(random_bytes(24, 2)).done(), 2},
          {"tga 24", craft::begin_tga({.width = 4, .height = 4}).bytes(random_bytes(48, 2)).done()},
          {"tga 16", craft::begin_tga({.width = 4, .height = 4, .bits = 16}).bytes(random_bytes(32, 2)).done()},
          {"tga packed", packed_tga()},
          {"tga palette", indexed_tga()},
          {"hdr flat", craft::begin_hdr("-Y 3 +X 4").bytes(random_bytes(48, 2)).done()},
          {"hdr packed", packed_hdr()}};
}

TEST(Hostile, EveryTruncationIsAnError) {
  for (const Sample& sample : samples()) {
    const auto whole = decode_image(sample.bytes);
    ASSERT_TRUE(whole) << sample.name << ": " << to_string(whole.error());
    int truncated = 0;
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      const auto part = decode_image(std::span(sample.bytes).first(size));
      if (size + sample.spare >= sample.bytes.size()) {
        ASSERT_TRUE(part) << sample.name << " cut to " << size << " of " << sample.bytes.size();
        EXPECT_EQ(*part, *whole) << sample.name;
        continue;
      }
      ASSERT_FALSE(part) << sample.name << " cut to " << size << " of " << sample.bytes.size();
      if (part.error().code == "image.truncated") ++truncated;
    }
    // TGA without its whole header cannot be told from anything else.
    const std::size_t nameless = sample.name.starts_with("tga") ? 17 : 0;
    EXPECT_EQ(static_cast<std::size_t>(truncated), sample.bytes.size() - sample.spare - nameless) << sample.name;
  }
}

TEST(Hostile, BytesBehindThePictureAreNotRead) {
  for (const Sample& sample : samples()) {
    const Bytes longer = Writer().bytes(sample.bytes).bytes(random_bytes(50, 77)).done();
    const auto image = decode_image(longer);
    ASSERT_TRUE(image) << sample.name << ": " << to_string(image.error());
    EXPECT_EQ(*image, decode_image(sample.bytes).value()) << sample.name;
  }
}

/// Whatever comes out is a picture of the permitted size with finite values, or an error with a code of this room.
void expect_sound(const Bytes& bytes, const std::string& what) {
  const auto image = decode_image(bytes);
  if (image) {
    EXPECT_FALSE(image->empty()) << what;
    EXPECT_LE(std::int64_t{image->width()} * image->height(), kMaxPixels) << what;
    EXPECT_TRUE(is_finite(image->pixels().values())) << what;
  } else {
    EXPECT_TRUE(image.error().code.starts_with("image.")) << what;
    EXPECT_FALSE(image.error().sentence.empty()) << what;
  }
}

/// Sizes stay small, so that thousands of variants take seconds: what is tried is damage, not patience.
bool claims_much(const Bytes& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with("\xff\xd8")) return false;
  for (std::size_t i = 2; i + 8 < bytes.size(); ++i) {
    const auto byte = [&](std::size_t k) { return std::to_integer<unsigned>(bytes[i + k]); };
    const bool frame = byte(0) == 0xff && byte(1) >= 0xc0 && byte(1) <= 0xcf && byte(1) != 0xc4;
    if (frame && (byte(5) * 256 + byte(6)) * (byte(7) * 256 + byte(8)) > 1'000'000) return true;
  }
  return false;
}

TEST(Hostile, RandomDamageNeverHarms) {
  for (const Sample& sample : samples()) {
    craft::Random random(sample.bytes.size());
    for (int variant = 0; variant < 4000; ++variant) {
      Bytes bytes = sample.bytes;
      for (std::size_t flips = 1 + random.below(4); flips > 0; --flips) {
        // Headers more often than pixels.
        const std::size_t end = random.below(2) == 0 ? std::min<std::size_t>(bytes.size(), 64) : bytes.size();
        bytes[random.below(end)] = static_cast<std::byte>(random.next() >> 56);
      }
      if (random.below(8) == 0) bytes.resize(random.below(bytes.size()));
      if (!claims_much(bytes)) expect_sound(bytes, sample.name + ", variant " + std::to_string(variant));
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(Hostile, DamagedPngWithRightChecksumsNeverHarms) {
  // Checksums that fit let the damage through to the decoder.
  craft::Random random(99);
  for (int variant = 0; variant < 4000; ++variant) {
    const auto any = [&](std::initializer_list<int> values) { return values.begin()[random.below(values.size())]; };
    Writer header;
    header.u32_big(static_cast<std::uint32_t>(random.below(40))).u32_big(static_cast<std::uint32_t>(random.below(40)));
    header.u8(any({1, 2, 4, 8, 16, 3})).u8(any({0, 2, 3, 4, 6, 1})).u8(random.below(20) == 0).u8(0).u8(any({0, 1, 2}));
    Writer file;
    file.text("\x89PNG\r\n\x1a\n").bytes(craft::png_chunk("IHDR", header.done()));
    const std::uint64_t seed = random.next();
    if (random.below(2)) file.bytes(craft::png_chunk("PLTE", random_bytes(random.below(50) * 3, seed)));
    if (random.below(2)) file.bytes(craft::png_chunk("tRNS", random_bytes(random.below(300), seed)));
    if (random.below(4) == 0) file.bytes(craft::png_chunk("iCCP", random_bytes(random.below(300), seed)));
    if (random.below(4) == 0) file.bytes(craft::png_chunk("eXIf", random_bytes(random.below(300), seed)));
    craft::Png filler{.width = 30, .height = 20, .depth = 8, .color_type = 0};
    for (std::size_t i = 0; i < 600; ++i)
      filler.samples.push_back(static_cast<unsigned>(random.below(256)));
    const Bytes whole = craft::make_png(filler);
    // From IDAT on: a good stream that belongs to another header.
    file.bytes(std::span(whole).subspan(8 + 25));
    expect_sound(file.done(), "variant " + std::to_string(variant));
  }
}

TEST(Hostile, AProgressiveJpegCannotGoOnForEver) {
  const auto image = decode_image(craft::read_data("many_scans.jpg"));
  ASSERT_EQ(craft::code_of(image), "image.unsupported");
  EXPECT_NE(image.error().sentence.find("scans"), std::string::npos);
}

} // namespace
} // namespace oversketch
