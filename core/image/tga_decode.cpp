#include "core/image/decoded.h"
#include "core/image/stb_load.h"

#include <algorithm>

namespace oversketch {

namespace {

constexpr std::string_view kTga = "TGA";
constexpr std::size_t kHeaderBytes = 18;

struct Header {
  std::size_t id_bytes = 0;
  int map_kind = 0;
  /// 1 indexed, 2 direct, 3 grey; the run-length coded ones likewise.
  int kind = 0;
  bool packed = false;
  std::size_t map_first = 0;
  std::size_t map_count = 0;
  int map_bits = 0;
  int width = 0;
  int height = 0;
  int bits = 0;
  int alpha_bits = 0;
  bool from_right = false;
  bool reserved = false;

  /// Bits of what a colour is made of: the pixel's own, or the colour map's.
  int color_bits() const { return kind == 1 ? map_bits : bits; }
  /// The header tells how many bits of a pixel are alpha; where it says none, the fourth byte means nothing.
  int channels() const { return kind == 3 ? bits / 8 : color_bits() == 32 && alpha_bits > 0 ? 4 : 3; }
  std::size_t pixel_bytes() const { return static_cast<std::size_t>(bits + 7) / 8; }
  std::size_t map_bytes() const { return map_count * (static_cast<std::size_t>(map_bits + 7) / 8); }
  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

Header read_header(std::span<const std::byte> file) {
  ByteReader reader(file);
  Header h;
  h.id_bytes = reader.u8();
  h.map_kind = reader.u8();
  const int type = reader.u8();
  h.kind = type & ~8;
  h.packed = (type & 8) != 0;
  h.map_first = reader.u16();
  h.map_count = reader.u16();
  h.map_bits = reader.u8();
  reader.skip(4);
  h.width = static_cast<int>(reader.u16());
  h.height = static_cast<int>(reader.u16());
  h.bits = reader.u8();
  const int descriptor = reader.u8();
  h.alpha_bits = descriptor & 15;
  h.from_right = (descriptor & 16) != 0;
  h.reserved = (descriptor & 0xc0) != 0;
  return h;
}

bool one_of(int value, std::initializer_list<int> allowed) {
  return std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

/// stb_image takes the first colour for one that the map does not have.
Result<void> check_colors(const Header& h, std::span<const std::byte> pixels) {
  const std::size_t size = h.pixel_bytes();
  for (std::size_t i = 0; h.kind == 1 && i < pixels.size(); i += size) {
    const unsigned high = size == 2 ? std::to_integer<unsigned>(pixels[i + 1]) : 0;
    if ((high << 8 | std::to_integer<unsigned>(pixels[i])) >= h.map_count)
      return image_damaged(kTga, "a pixel names a colour that the colour map does not have");
  }
  return {};
}

/// stb_image fills up packets that are cut short and cuts those that are too long.
Result<void> check_packets(const Header& h, ByteReader& reader) {
  const std::size_t size = h.pixel_bytes();
  for (std::size_t left = h.pixel_count(); left > 0;) {
    const unsigned packet = reader.u8();
    const std::size_t count = (packet & 127) + 1;
    const auto content = reader.take((packet & 128) != 0 ? size : count * size);
    if (reader.past_end()) return image_truncated(kTga);
    if (count > left) return image_damaged(kTga, "a run of pixels goes past the picture's end");
    if (const auto colors = check_colors(h, content); !colors) return colors.error();
    left -= count;
  }
  return {};
}

Result<void> check_pixels(const Header& h, std::span<const std::byte> file) {
  ByteReader reader(file, kHeaderBytes);
  reader.skip(h.id_bytes);
  reader.skip(h.map_bytes());
  if (reader.past_end()) return image_truncated(kTga);
  if (h.packed) return check_packets(h, reader);
  const auto pixels = reader.take(h.pixel_count() * h.pixel_bytes());
  if (reader.past_end()) return image_truncated(kTga);
  return check_colors(h, pixels);
}

} // namespace

bool looks_like_tga(std::span<const std::byte> file) {
  if (file.size() < kHeaderBytes) return false;
  const Header h = read_header(file);
  if (h.width == 0 || h.height == 0 || h.reserved || h.map_kind > 1) return false;
  if (h.map_kind == 1 && !one_of(h.map_bits, {15, 16, 24, 32})) return false;
  if (h.map_kind == 0 && (h.map_count != 0 || h.map_bits != 0 || h.map_first != 0)) return false;
  switch (h.kind) {
  case 1:
    return h.map_kind == 1 && one_of(h.bits, {8, 16});
  case 2:
    return one_of(h.bits, {15, 16, 24, 32}) && one_of(h.alpha_bits, {0, 1, 8});
  case 3:
    return h.bits == 8 || (h.bits == 16 && h.alpha_bits == 8);
  default:
    return false;
  }
}

Result<Decoded> decode_tga(std::span<const std::byte> file, std::int64_t most_pixels) {
  const Header h = read_header(file);
  if (const auto size = check_size(h.width, h.height, kTga, most_pixels); !size) return size.error();
  if (h.map_kind == 1 && h.kind != 1) return image_unsupported(kTga, "a colour map beside pixels with colours");
  // stb_image counts the entries that are left out as bytes.
  if (h.map_first != 0) return image_unsupported(kTga, "a part of a colour map");
  if (const auto pixels = check_pixels(h, file); !pixels) return pixels.error();
  Result<Decoded> decoded = load_with_stb(file, {kTga, h.width, h.height, h.channels()});
  // stb_image sees to the rows' order, not to that of the pixels in a row.
  if (decoded && h.from_right) decoded->orientation = 2;
  return decoded;
}

} // namespace oversketch
