#pragma once

#include "core/base/result.h"
#include "core/image/image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

/// What the decoders of image_io.cpp have in common.  Nobody outside this room needs it.
namespace oversketch {

enum class Samples { kU8, kU16, kFloat };

/// Pixels and how their memory is given back: stb_image has its own way.
using PixelMemory = std::unique_ptr<std::byte[], void (*)(void*)>;

/// Pixels as a file stores them: rows without padding, 1 (grey), 2 (grey, alpha), 3 or 4 samples a pixel in the
/// machine's byte order; kFloat is already encoded (1 is the 8-bit level 255).
struct Decoded {
  int width = 0;
  int height = 0;
  int channels = 4;
  Samples samples = Samples::kU8;
  /// EXIF orientation, 1…8: how stored rows and columns lie on the screen.
  int orientation = 1;
  PixelMemory data{nullptr, nullptr};

  std::size_t row_bytes() const;
  std::byte* row(int y) { return data.get() + static_cast<std::size_t>(y) * row_bytes(); }
  const std::byte* row(int y) const { return data.get() + static_cast<std::size_t>(y) * row_bytes(); }
};

/// Allocates without clearing, so that pages of a picture that turns out to be cut short are never touched.
Decoded make_decoded(int width, int height, int channels, Samples samples);

/// To encoded floats, turned upright.  v / 255 and v / 65535 are correctly rounded.
Image to_image(const Decoded& decoded);

/// @errors image.damaged when there are no pixels, image.too-large above `most_pixels`.
Result<void> check_size(std::int64_t width, std::int64_t height, std::string_view format, std::int64_t most_pixels);

Error image_truncated(std::string_view format);
Error image_damaged(std::string_view format, std::string_view reason);
Error image_unsupported(std::string_view format, std::string_view what);
Error image_too_large(std::string_view format, std::string_view why);

Result<Decoded> decode_png(std::span<const std::byte> file, std::int64_t most_pixels);
Result<Decoded> decode_jpeg(std::span<const std::byte> file, std::int64_t most_pixels);
Result<Decoded> decode_bmp(std::span<const std::byte> file, std::int64_t most_pixels);
Result<Decoded> decode_tga(std::span<const std::byte> file, std::int64_t most_pixels);
Result<Decoded> decode_hdr(std::span<const std::byte> file, std::int64_t most_pixels);
/// See exact.h.
Result<Decoded> decode_floats(std::span<const std::byte> file, std::int64_t most_pixels);

/// TGA has no signature: true when every field of the header has a value that the format knows.
bool looks_like_tga(std::span<const std::byte> file);

/// The orientation, 1…8, of an EXIF block that starts with "Exif\0\0"; 1 when there is none or it is not one of those.
/// Never fails: what a camera wrote beside a picture is no reason not to open it.
int exif_orientation(std::span<const std::byte> block);

/// Numbers out of a file, byte by byte; reading past the end gives 0 and is remembered.
class ByteReader {
public:
  explicit ByteReader(std::span<const std::byte> bytes, std::size_t at = 0) : bytes_(bytes), at_(at) {}

  bool past_end() const { return past_end_; }
  std::size_t position() const { return at_; }
  std::size_t left() const { return at_ < bytes_.size() ? bytes_.size() - at_ : 0; }
  void skip(std::size_t count) {
    if (count > left()) past_end_ = true;
    at_ += std::min(count, left());
  }
  std::uint8_t u8() {
    if (at_ >= bytes_.size()) return past_end_ = true, std::uint8_t{0};
    return std::to_integer<std::uint8_t>(bytes_[at_++]);
  }
  std::uint32_t u16() {
    const std::uint32_t low = u8();
    return low | static_cast<std::uint32_t>(u8()) << 8;
  }
  std::uint32_t u32() {
    const std::uint32_t low = u16();
    return low | u16() << 16;
  }
  std::uint32_t u32_big() {
    const std::uint32_t v = u32();
    return v >> 24 | (v >> 8 & 0xff00) | (v << 8 & 0xff0000) | v << 24;
  }
  /// `count` bytes; fewer, and past_end(), when there are not so many.
  std::span<const std::byte> take(std::size_t count) {
    const auto found = bytes_.subspan(std::min(at_, bytes_.size()), std::min(count, left()));
    skip(count);
    return found;
  }

private:
  std::span<const std::byte> bytes_;
  std::size_t at_;
  bool past_end_ = false;
};

} // namespace oversketch
