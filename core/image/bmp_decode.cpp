#include "core/image/decoded.h"
#include "core/image/stb_load.h"

#include <algorithm>
#include <array>
#include <bit>

namespace oversketch {

namespace {

constexpr std::string_view kBmp = "BMP";
constexpr std::size_t kFileHeaderBytes = 14;

struct BmpHeader {
  std::size_t pixels_at = 0;
  /// Of the information header behind the file's header: 12 is OS/2's, 40 and more are Windows'.
  std::uint32_t bytes = 0;
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::uint32_t bits = 0;
  std::uint32_t compression = 0;
  /// Red, green, blue, alpha; of all but the longest headers the first three, behind the header.
  std::array<std::uint32_t, 4> masks{};

  bool masked() const { return compression == 3; }
  bool long_header() const { return bytes >= 108; }
  bool has_alpha() const { return masked() && long_header() && masks[3] != 0; }
  std::size_t end() const { return kFileHeaderBytes + bytes + (masked() && !long_header() ? 12 : 0); }
  std::size_t palette_colors() const { return (pixels_at - end()) / 4; }
  /// Rows begin at multiples of 4 bytes; the last one need not be filled up.
  std::uint64_t row_bytes() const { return (static_cast<std::uint64_t>(width) * bits + 7) / 8; }
  std::uint64_t stride() const { return (row_bytes() + 3) / 4 * 4; }
};

template <class T>
bool one_of(T value, std::initializer_list<T> allowed) {
  return std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

Result<BmpHeader> read_header(std::span<const std::byte> file) {
  ByteReader reader(file, 10);
  BmpHeader h;
  h.pixels_at = reader.u32();
  h.bytes = reader.u32();
  if (reader.past_end()) return image_truncated(kBmp);
  if (!one_of<std::uint32_t>(h.bytes, {12, 40, 56, 108, 124}))
    return image_unsupported(kBmp, "a header of " + std::to_string(h.bytes) + " bytes");
  const bool oldest = h.bytes == 12;
  h.width = oldest ? static_cast<std::int64_t>(reader.u16()) : static_cast<std::int32_t>(reader.u32());
  h.height = std::abs(oldest ? static_cast<std::int64_t>(reader.u16()) : static_cast<std::int32_t>(reader.u32()));
  reader.skip(2);
  h.bits = reader.u16();
  if (!oldest) {
    h.compression = reader.u32();
    reader.skip(20);
  }
  for (std::size_t i = 0; h.masked() && i < (h.long_header() ? 4U : 3U); ++i)
    h.masks[i] = reader.u32();
  if (reader.past_end() || h.end() > file.size()) return image_truncated(kBmp);
  return h;
}

/// stb_image misreads some of what is refused here, and says less of the rest.
Result<void> check_kind(const BmpHeader& h) {
  if (h.compression != 0 && !h.masked()) return image_unsupported(kBmp, "compressed pixels");
  if (h.masked() && h.bits != 16 && h.bits != 32)
    return image_damaged(kBmp, "colour masks for pixels of other than 16 or 32 bits");
  if (h.masked() && h.bytes == 56) return image_unsupported(kBmp, "colour masks in a header of 56 bytes");
  if (h.bits == 2) return image_unsupported(kBmp, "2 bits a pixel");
  if (!one_of<std::uint32_t>(h.bits, {1, 4, 8, 16, 24, 32}))
    return image_damaged(kBmp, std::to_string(h.bits) + " bits a pixel");
  if (h.bytes == 12 && h.bits != 24) return image_unsupported(kBmp, "OS/2's header for other than 24 bits a pixel");
  for (std::size_t i = 0; h.masked() && i < 4; ++i) {
    const std::uint32_t mask = h.masks[i], shifted = mask == 0 ? 0 : mask >> std::countr_zero(mask);
    if (i < 3 && mask == 0) return image_damaged(kBmp, "a colour has no bits");
    if ((shifted & (shifted + 1)) != 0) return image_damaged(kBmp, "a colour mask has holes");
    if (shifted > 255) return image_unsupported(kBmp, "more than 8 bits a colour");
  }
  if (h.pixels_at < h.end()) return image_damaged(kBmp, "its pixels are said to lie inside its header");
  if (h.bits > 8 && h.pixels_at > h.end()) return image_unsupported(kBmp, "a gap between header and pixels");
  if (h.bits <= 8 && (h.palette_colors() == 0 || h.palette_colors() > 256))
    return image_damaged(kBmp, "its palette has no colours, or more than 256");
  return {};
}

/// stb_image looks colours up without asking whether the palette has them.
bool palette_has_all(const BmpHeader& h, std::span<const std::byte> file) {
  const unsigned mask = (1U << h.bits) - 1, per_byte = 8 / h.bits;
  if (h.palette_colors() > mask) return true;
  for (std::int64_t y = 0; y < h.height; ++y) {
    const auto row = file.subspan(h.pixels_at + h.stride() * static_cast<std::uint64_t>(y), h.row_bytes());
    for (std::size_t x = 0; x < static_cast<std::size_t>(h.width); ++x) {
      const unsigned shift = 8 - h.bits * (static_cast<unsigned>(x % per_byte) + 1);
      if ((std::to_integer<unsigned>(row[x / per_byte]) >> shift & mask) >= h.palette_colors()) return false;
    }
  }
  return true;
}

} // namespace

Result<Decoded> decode_bmp(std::span<const std::byte> file, std::int64_t most_pixels) {
  const Result<BmpHeader> h = read_header(file);
  if (!h) return h.error();
  if (const auto size = check_size(h->width, h->height, kBmp, most_pixels); !size) return size.error();
  if (const auto kind = check_kind(*h); !kind) return kind.error();
  const std::uint64_t needed = h->stride() * static_cast<std::uint64_t>(h->height - 1) + h->row_bytes();
  if (h->pixels_at > file.size() || file.size() - h->pixels_at < needed) return image_truncated(kBmp);
  if (h->bits <= 8 && !palette_has_all(*h, file))
    return image_damaged(kBmp, "a pixel names a colour that the palette does not have");
  // Without masks the fourth byte means nothing.
  return load_with_stb(file, {kBmp, h->width, h->height, h->has_alpha() ? 4 : 3});
}

} // namespace oversketch
