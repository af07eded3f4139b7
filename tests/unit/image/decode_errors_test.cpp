#include "core/image/image_io.h"
#include "core/image/levels.h"
#include "tests/unit/image/craft.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <unistd.h>

namespace oversketch {
namespace {

using craft::Bytes;
using craft::code_of;
using craft::Writer;
namespace fs = std::filesystem;

std::string decode_code(const Bytes& bytes) {
  return code_of(decode_image(bytes));
}

class Folder {
public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "oversketch-image-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path operator/(const char* name) const { return path_ / name; }

private:
  fs::path path_;
};

TEST(DecodeErrors, NamesWhatIsNotAPicture) {
  EXPECT_EQ(decode_code({}), "image.truncated");
  for (const std::string_view text : {"x", "hello, world, this is no picture at all", "GIF89a......", "%PDF-1.4 ....."})
    EXPECT_EQ(decode_code(Writer().text(text).done()), "image.unknown-format") << text;
  EXPECT_EQ(decode_code(Writer().zeros(1000).done()), "image.unknown-format");
  const auto webp = decode_image(Writer().text("RIFF").u32(100).text("WEBPVP8 ").zeros(50).done());
  ASSERT_FALSE(webp);
  EXPECT_NE(webp.error().sentence.find("WebP"), std::string::npos);
  EXPECT_NE(webp.error().sentence.find("PNG, JPEG, BMP, TGA and HDR"), std::string::npos);
}

TEST(DecodeErrors, RefusesGiantHeadersAtOnce) {
  const Bytes ihdr = Writer().u32_big(60000).u32_big(60000).u8(8).u8(2).u8(0).u8(0).u8(0).done();
  const Bytes giant_png = Writer().text("\x89PNG\r\n\x1a\n").bytes(craft::png_chunk("IHDR", ihdr)).done();
  EXPECT_EQ(decode_code(giant_png), "image.too-large");
  Bytes jpeg = encode_jpeg(filled(8, 8, {0.5f, 0.5f, 0.5f, 1})).value();
  for (std::size_t i = 0; i + 9 < jpeg.size(); ++i)
    if (jpeg[i] == std::byte{0xff} && jpeg[i + 1] == std::byte{0xc0})
      for (std::size_t k = 5; k < 9; ++k)
        jpeg[i + k] = std::byte{k % 2 == 1 ? std::uint8_t{0xea} : std::uint8_t{0x60}};
  EXPECT_EQ(decode_code(jpeg), "image.too-large");
  EXPECT_EQ(decode_code(craft::begin_bmp({.width = 60000, .height = 60000}).done()), "image.too-large");
  EXPECT_EQ(decode_code(craft::begin_bmp({.width = 1, .height = std::numeric_limits<int>::min()}).done()),
            "image.too-large");
  EXPECT_EQ(decode_code(craft::begin_tga({.width = 60000, .height = 60000}).done()), "image.too-large");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 60000 +X 60000").done()), "image.too-large");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 2000000000 +X 2000000000").done()), "image.too-large");
}

TEST(DecodeErrors, RefusesLargePicturesInTinyFiles) {
  // 196 megapixels are allowed, but not out of a hundred bytes.
  const Bytes ihdr = Writer().u32_big(14000).u32_big(14000).u8(8).u8(6).u8(0).u8(0).u8(0).done();
  const Bytes png = Writer()
                        .text("\x89PNG\r\n\x1a\n")
                        .bytes(craft::png_chunk("IHDR", ihdr))
                        .bytes(craft::png_chunk("IDAT", Writer().zeros(20).done()))
                        .bytes(craft::png_chunk("IEND", {}))
                        .done();
  EXPECT_EQ(decode_code(png), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_bmp({.width = 14000, .height = 14000}).zeros(50).done()), "image.truncated");
  EXPECT_EQ(decode_code(craft::begin_tga({.width = 14000, .height = 14000}).zeros(50).done()), "image.truncated");
  EXPECT_EQ(decode_code(craft::begin_tga({.type = 10, .width = 14000, .height = 14000}).zeros(50).done()),
            "image.truncated");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 14000 +X 14000").zeros(50).done()), "image.truncated");
}

TEST(DecodeErrors, RefusesSizeZero) {
  const Bytes ihdr = Writer().u32_big(0).u32_big(7).u8(8).u8(2).u8(0).u8(0).u8(0).done();
  EXPECT_EQ(decode_code(Writer().text("\x89PNG\r\n\x1a\n").bytes(craft::png_chunk("IHDR", ihdr)).done()),
            "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_bmp({.width = 0, .height = 5}).zeros(50).done()), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_bmp({.width = -5, .height = 5}).zeros(50).done()), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 0 +X 5").zeros(50).done()), "image.damaged");
}

TEST(DecodeErrors, SaysWhatIsUnsupportedOrDamaged) {
  EXPECT_EQ(decode_code(craft::begin_bmp({.bits = 8, .palette = 2, .compression = 1}).zeros(50).done()),
            "image.unsupported");
  EXPECT_EQ(decode_code(craft::begin_bmp({.bits = 7}).zeros(50).done()), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_bmp({.bits = 8, .palette = 300}).zeros(2000).done()), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_bmp({.bits = 16, .compression = 3, .masks = {5, 8, 16}}).zeros(9).done()),
            "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_bmp({.bits = 24, .compression = 3, .masks = {5, 8, 16}}).zeros(9).done()),
            "image.damaged");
  // A pixel beyond the palette.
  EXPECT_EQ(decode_code(craft::begin_bmp({.bits = 8, .palette = 1}).zeros(4).u32(1).done()), "image.damaged");
  for (const unsigned type : {1U, 9U})
    for (const unsigned bits : {8U, 16U}) {
      Writer file = craft::begin_tga({.type = type, .map_count = 1, .map_bits = 24, .bits = bits});
      EXPECT_EQ(decode_code((type == 9 ? file.zeros(3).u8(0) : file.zeros(3)).u16(bits == 8 ? 1 : 256).done()),
                "image.damaged");
    }
  // A packet of more pixels than the picture has.
  EXPECT_EQ(decode_code(craft::begin_tga({.type = 10}).u8(0x83).u8(1).u8(2).u8(3).done()), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 1 +X 1", "FORMAT=32-bit_rle_xyze\n").zeros(9).done()),
            "image.unsupported");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 1 -Y 1").zeros(9).done()), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y x +X 1").zeros(9).done()), "image.damaged");
  // A line of another length, and a run that goes past its end.
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 1 +X 8").u8(2).u8(2).u8(0).u8(9).zeros(99).done()), "image.damaged");
  EXPECT_EQ(decode_code(craft::begin_hdr("-Y 1 +X 8").u8(2).u8(2).u8(0).u8(8).u8(137).zeros(99).done()),
            "image.damaged");
}

TEST(DecodeErrors, SaysWhichKindsAreNotRead) {
  const auto expect_unsupported = [](const Writer& file) {
    EXPECT_EQ(decode_code(Writer(file).zeros(2000).done()), "image.unsupported");
  };
  expect_unsupported(craft::begin_bmp({.bits = 2, .palette = 4}));
  expect_unsupported(craft::begin_bmp({.header_bytes = 64}));
  expect_unsupported(craft::begin_bmp({.gap = 4}));
  const std::vector<std::uint32_t> rgb{0xff0000, 0xff00, 0xff}, rgba{0xff0000, 0xff00, 0xff, 0xff000000};
  expect_unsupported(craft::begin_bmp({.bits = 32, .compression = 6, .masks = rgba}));
  expect_unsupported(craft::begin_bmp({.bits = 32, .compression = 3, .masks = rgb, .header_bytes = 56}));
  expect_unsupported(craft::begin_bmp({.bits = 32, .compression = 3, .masks = {0x3ff00000, 0xffc00, 0x3ff}}));
  // OS/2's header with a palette.
  expect_unsupported(Writer().text("BM").u32(0).u32(0).u32(32).u32(12).u16(2).u16(1).u16(1).u16(1));
  expect_unsupported(craft::begin_tga({.type = 2, .map_count = 1, .map_bits = 24}));
  Bytes map_from_one = craft::begin_tga({.type = 1, .map_count = 2, .map_bits = 24, .bits = 8}).done();
  map_from_one[3] = std::byte{1};
  expect_unsupported(Writer().bytes(map_from_one));
  expect_unsupported(craft::begin_hdr("-Y 1 +X 1", ""));
  // Runs as they were once coded: of a pixel, and of nothing.
  expect_unsupported(craft::begin_hdr("-Y 1 +X 261").u8(9).u8(8).u8(7).u8(130).u8(1).u8(1).u8(1).u8(3));
  expect_unsupported(craft::begin_hdr("-Y 1 +X 2").u8(1).u8(1).u8(1).u8(1));
  for (const char* order : {"-Y 2 -X 3", "+Y 2 -X 3", "+Y 2 +X 3", "+X 2 -Y 3", "-X 2 -Y 3", "-X 2 +Y 3", "+X 2 +Y 3"})
    expect_unsupported(craft::begin_hdr(order));
}

TEST(DecodeErrors, SaysWhatStbImageSays) {
  const auto image = decode_image(craft::begin_hdr("-Y 1 +X 8").u8(2).u8(2).u8(0).u8(9).zeros(99).done());
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().sentence.find("invalid decoded scanline length"), std::string::npos);
}

TEST(DecodeErrors, LoadNamesThePath) {
  const Folder folder;
  const auto missing = load_image(folder / "no.png");
  ASSERT_EQ(code_of(missing), "image.missing");
  EXPECT_NE(missing.error().where.find("no.png"), std::string::npos);
  EXPECT_EQ(code_of(load_image(folder / ".")), "image.unreadable");
  std::ofstream(folder / "text.png") << "not a picture, though its name says so";
  const auto text = load_image(folder / "text.png");
  ASSERT_EQ(code_of(text), "image.unknown-format");
  EXPECT_NE(text.error().where.find("text.png"), std::string::npos);
}

TEST(EncodeErrors, RefusesWhatCannotBeSaved) {
  const Folder folder;
  const Image good = filled(3, 2, {0.5f, 0.25f, 0.75f, 1});
  EXPECT_EQ(code_of(encode_png(Image())), "image.empty");
  EXPECT_EQ(code_of(encode_jpeg(Image())), "image.empty");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()})
    for (int channel = 0; channel < 4; ++channel) {
      Raster<Rgba> pixels(5, 3);
      (&pixels.at(4, 2).r)[channel] = bad;
      EXPECT_EQ(code_of(encode_png(Image(pixels))), "image.not-finite");
      EXPECT_EQ(code_of(encode_png(Image(pixels), BitDepth::k16)), "image.not-finite");
      EXPECT_EQ(code_of(encode_jpeg(Image(pixels))), "image.not-finite");
    }
  EXPECT_THROW((void)encode_jpeg(good, 0), BugError);
  EXPECT_THROW((void)encode_jpeg(good, 101), BugError);
  EXPECT_EQ(code_of(encode_jpeg(filled(70000, 1, {}))), "image.too-large");
  EXPECT_EQ(code_of(save_image(good, folder / "a.gif")), "image.unknown-extension");
  EXPECT_EQ(code_of(save_image(good, folder / "png")), "image.unknown-extension");
  EXPECT_EQ(code_of(save_image(good, folder / "a.JPG", BitDepth::k16)), "image.depth");
  EXPECT_EQ(code_of(save_image(good, folder / "no/such/a.png")), "file.write");
  EXPECT_FALSE(fs::exists(folder / "a.JPG"));
}

TEST(SaveImage, WritesByTheExtensionInAnyCase) {
  const Folder folder;
  const Image image = filled(20, 10, {0.2f, 0.6f, 1, 1});
  for (const char* name : {"a.png", "b.PNG", "c.jpg", "d.JPEG", "e.Jpg"}) {
    ASSERT_EQ(code_of(save_image(image, folder / name)), "") << name;
    const auto back = load_image(folder / name);
    ASSERT_TRUE(back) << name;
    EXPECT_EQ(craft::levels_of(*back).size(), 20U * 10 * 4);
  }
}

} // namespace
} // namespace oversketch
