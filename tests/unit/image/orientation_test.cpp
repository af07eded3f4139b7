#include "core/image/image_io.h"
#include "core/image/levels.h"
#include "tests/unit/image/craft.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace oversketch {
namespace {

using craft::Bytes;
using craft::Writer;

constexpr int kBlock = 48;

/// "ABC/DEF" as blocks of grey, A the darkest.
Image stored_picture() {
  Raster<Rgba> pixels(3 * kBlock, 2 * kBlock);
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) {
      const float v = static_cast<float>((x / kBlock + 3 * (y / kBlock)) * 50) / 255.0f;
      pixels.at(x, y) = {v, v, v, 1};
    }
  return Image(std::move(pixels));
}

/// The blocks as letters again; '?' for a block of more than one grey.
std::string letters(const Image& image) {
  std::string text;
  for (int top = 0; top < image.height(); top += kBlock) {
    if (top > 0) text += '/';
    for (int left = 0; left < image.width(); left += kBlock) {
      const float first = image.at(left, top).r * 255.0f / 50.0f;
      bool one = std::abs(first - std::round(first)) < 0.05f;
      for (int y = top; y < top + kBlock; ++y)
        for (int x = left; x < left + kBlock; ++x)
          one = one && std::abs(image.at(x, y).r - image.at(left, top).r) < 0.01f;
      text += one ? static_cast<char>('A' + static_cast<int>(std::round(first))) : '?';
    }
  }
  return text;
}

/// EXIF 2.32, tag 0x0112: the stored first row is the picture's top, top, bottom, bottom, left, right, right, left; the
/// first column its left, right, right, left, top, top, bottom, bottom.
constexpr std::array<std::string_view, 9> kUpright{"",         "ABC/DEF",  "CBA/FED",  "FED/CBA", "DEF/ABC",
                                                   "AD/BE/CF", "DA/EB/FC", "FC/EB/DA", "CF/BE/AD"};

TEST(Orientation, SenselessExifCountsAsNone) {
  const Bytes jpeg = encode_jpeg(stored_picture(), 100).value();
  std::vector<Bytes> blocks{craft::exif_block(0),
                            craft::exif_block(9),
                            craft::exif_block(65535),
                            {},
                            Writer().text({"Exif\0\0", 6}).done(),
                            Writer().text("http://ns.adobe.com/xap/1.0/").done()};
  Bytes loop = craft::exif_block(6);
  loop[6 + 4] = std::byte{0xff}; // the first directory far outside
  blocks.push_back(loop);
  Bytes many = craft::exif_block(6);
  many[6 + 10] = many[6 + 11] = std::byte{0xff}; // an unknown tag in place of the orientation
  blocks.push_back(many);
  for (const Bytes& block : blocks) {
    const auto image = decode_image(craft::with_app1(jpeg, block));
    ASSERT_TRUE(image);
    EXPECT_EQ(letters(*image), kUpright[1]);
  }
}

TEST(Orientation, OfJpegIsApplied) {
  const Bytes jpeg = encode_jpeg(stored_picture(), 100).value();
  EXPECT_EQ(letters(decode_image(jpeg).value()), kUpright[1]);
  for (unsigned orientation = 1; orientation <= 8; ++orientation)
    for (const bool big_endian : {false, true}) {
      const auto image = decode_image(craft::with_app1(jpeg, craft::exif_block(orientation, big_endian)));
      ASSERT_TRUE(image);
      EXPECT_EQ(letters(*image), kUpright[orientation]) << orientation;
    }
}

TEST(Orientation, OfPngIsAppliedBeforeAndBehindThePixels) {
  const Image picture = stored_picture();
  craft::Png png{.width = 3 * kBlock, .height = 2 * kBlock, .color_type = 0};
  for (const Rgba& p : picture.pixels().values())
    png.samples.push_back(static_cast<unsigned>(std::lround(p.r * 255.0f)));
  for (unsigned orientation = 1; orientation <= 8; ++orientation) {
    const Bytes chunk = craft::png_chunk("eXIf", craft::tiff_block(orientation, orientation % 2 == 0));
    craft::Png before = png, behind = png;
    before.before_pixels = behind.after_pixels = chunk;
    EXPECT_EQ(letters(decode_image(craft::make_png(before)).value()), kUpright[orientation]) << orientation;
    EXPECT_EQ(letters(decode_image(craft::make_png(behind)).value()), kUpright[orientation]) << orientation;
  }
}

TEST(Orientation, TheFirstExifBlockCounts) {
  const Bytes jpeg = encode_jpeg(stored_picture(), 100).value();
  const Bytes twice = craft::with_app1(craft::with_app1(jpeg, craft::exif_block(3)), craft::exif_block(6));
  EXPECT_EQ(letters(decode_image(twice).value()), kUpright[6]);
}

TEST(Orientation, HostileExifDoesNoHarm) {
  const Bytes jpeg = encode_jpeg(filled(8, 8, {0.5f, 0.5f, 0.5f, 1}), 90).value();
  craft::Random random(11);
  for (int i = 0; i < 4000; ++i) {
    Writer block;
    block.bytes(craft::exif_block(1 + static_cast<unsigned>(random.below(8)), random.below(2) == 0));
    const std::size_t more = random.below(200);
    for (std::size_t k = 0; k < more; ++k)
      block.u8(static_cast<unsigned>(random.next() >> 56));
    Bytes bytes = block.done();
    for (std::size_t k = random.below(12); k > 0; --k)
      bytes[6 + random.below(bytes.size() - 6)] = static_cast<std::byte>(random.next() >> 56);
    EXPECT_TRUE(decode_image(craft::with_app1(jpeg, bytes))) << "variant " << i;
  }
}

} // namespace
} // namespace oversketch
