#include "core/image/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

namespace oversketch {
namespace {

Image one_pixel(Rgba pixel) {
  return Image(Raster<Rgba>(1, 1, pixel));
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return {bytes.begin(), bytes.end()};
}

TEST(Exact, refuses_what_it_cannot_keep_or_read) {
  EXPECT_EQ(encode_exact(Image()).error().code, "image.empty");
  EXPECT_EQ(encode_floats(one_pixel({NAN, 0, 0, 1})).error().code, "image.not-finite");
  EXPECT_EQ(read_image_size({}).error().code, "image.unknown-format");
  EXPECT_EQ(read_image_size(bytes_of("\x89PNG\r\n\x1a\n")).error().code, "image.truncated");
  EXPECT_EQ(read_image_size(bytes_of("OSFLOAT1\1")).error().code, "image.truncated");
  EXPECT_EQ(read_image_size(bytes_of("\xff\xd8\xff jpeg, whatever it holds")).error().code, "image.unknown-format");

  auto bytes = *encode_floats(one_pixel({0.1f, 0, 0, 1}));
  bytes.pop_back();
  EXPECT_EQ(decode_image(bytes).error().code, "image.truncated");
  bytes.push_back(std::byte{0x7f});
  bytes[bytes.size() - 5] = std::byte{0x80};
  EXPECT_EQ(decode_image(bytes).error().code, "image.damaged") << "infinity";
  for (std::size_t i = 8; i < 16; ++i)
    bytes[i] = std::byte{0x7f};
  EXPECT_EQ(decode_image(bytes).error().code, "image.too-large");
  bytes[8] = bytes[9] = bytes[10] = bytes[11] = std::byte{0};
  EXPECT_EQ(decode_image(bytes).error().code, "image.damaged");
}

TEST(Exact, knows_the_depth_that_keeps_every_bit) {
  for (int level = 0; level <= 255; ++level)
    EXPECT_EQ(exact_depth(one_pixel({static_cast<float>(level) / 255.0f, 0, 0, 1})), BitDepth::k8) << level;
  for (int level = 0; level <= 65535; level += 7) {
    const float value = static_cast<float>(level) / 65535.0f;
    EXPECT_NE(exact_depth(one_pixel({0, value, 0, 1})), std::nullopt) << level;
  }
  EXPECT_EQ(exact_depth(one_pixel({0, 0, 1.0f / 65535.0f, 1})), BitDepth::k16);
  const float beside = std::nextafter(128.0f / 255.0f, 1.0f);
  for (const float value : {beside, 1.5f, -0.1f, -0.0f, 1e-30f, std::numeric_limits<float>::infinity(), NAN})
    EXPECT_EQ(exact_depth(one_pixel({0, 0, 0, value})), std::nullopt) << value;
  // The last pixel counts as much as the first.
  Raster<Rgba> pixels(1000, 3, {1, 0, 1, 1});
  EXPECT_EQ(exact_depth(Image(Raster<Rgba>(pixels))), BitDepth::k8);
  pixels.at(999, 2).b = beside;
  EXPECT_EQ(exact_depth(Image(std::move(pixels))), std::nullopt);
}

TEST(Exact, gives_every_bit_back) {
  Raster<Rgba> pixels(70, 41);
  float value = -3;
  for (Rgba& p : pixels.values())
    p = {value *= -1.013f, -0.0f, 1 / value, value * 1e-20f};
  for (const Image& image : {Image(std::move(pixels)), Image(Raster<Rgba>(9, 8, {0.2f, 0.4f, 1, 1})),
                             one_pixel({1.0f / 65535.0f, 0, 1, 0})}) {
    const auto encoded = encode_exact(image);
    ASSERT_TRUE(encoded.ok());
    EXPECT_EQ(encoded->extension, exact_depth(image) ? ".png" : ".osf");
    EXPECT_EQ(*read_image_size(std::span(encoded->bytes).first(kSizeHeaderBytes)),
              (ImageSize{image.width(), image.height()}));
    const auto again = decode_image(encoded->bytes);
    ASSERT_TRUE(again.ok()) << to_string(again.error());
    EXPECT_EQ(again->content_hash(), image.content_hash());
  }
}

} // namespace
} // namespace oversketch
