#include "core/image/decoded.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace oversketch {

namespace {

constexpr std::string_view kFormat = "TGA";
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
  bool from_top = false;
  bool reserved = false;

  /// Bits of what a colour is made of: the pixel's own, or the colour map's.
  int color_bits() const { return kind == 1 ? map_bits : bits; }
  /// The header tells how many bits of a pixel are alpha; where it says none, the fourth byte means nothing.
  bool has_alpha() const { return alpha_bits > 0 && (color_bits() == 32 || color_bits() == 16); }
  int channels() const { return (kind == 3 ? 1 : 3) + (has_alpha() ? 1 : 0); }
  std::size_t pixel_bytes() const { return static_cast<std::size_t>(bits + 7) / 8; }
};

Header read_header(ByteReader& reader) {
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
  h.from_top = (descriptor & 32) != 0;
  h.reserved = (descriptor & 0xc0) != 0;
  return h;
}

bool one_of(int value, std::initializer_list<int> allowed) {
  return std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

/// One pixel or colour of the map as levels: little-endian blue, green, red, alpha, or 1-5-5-5 bits, or grey.
void write_levels(const Header& h, const std::byte* in, std::byte* out) {
  if (h.kind == 3) {
    out[0] = in[0];
    if (h.has_alpha()) out[1] = in[1];
    return;
  }
  if (h.color_bits() <= 16) {
    const unsigned pixel = std::to_integer<unsigned>(in[0]) | std::to_integer<unsigned>(in[1]) << 8;
    const auto level = [&](int shift) { return static_cast<std::byte>(((pixel >> shift & 31) * 255 + 15) / 31); };
    out[0] = level(10);
    out[1] = level(5);
    out[2] = level(0);
    if (h.has_alpha()) out[3] = std::byte{(pixel & 0x8000) != 0 ? std::uint8_t{255} : std::uint8_t{0}};
    return;
  }
  out[0] = in[2];
  out[1] = in[1];
  out[2] = in[0];
  if (h.has_alpha()) out[3] = in[3];
}

/// The pixels as stored, runs written out.
Result<std::vector<std::byte>> unpack(const Header& h, ByteReader& reader) {
  const std::size_t size = h.pixel_bytes();
  std::size_t left = static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height);
  // A packet of 128 pixels takes at least 1 + size bytes: nothing is allocated for a file that is far too short.
  if ((left + 127) / 128 * (1 + size) > reader.left()) return image_truncated(kFormat);
  std::vector<std::byte> pixels(left * size);
  std::byte* out = pixels.data();
  while (left > 0) {
    const unsigned packet = reader.u8();
    const std::size_t count = (packet & 127) + 1;
    const bool run = (packet & 128) != 0;
    const auto content = reader.take(run ? size : count * size);
    if (reader.past_end()) return image_truncated(kFormat);
    if (count > left) return image_damaged(kFormat, "a run of pixels goes past the picture's end");
    for (std::size_t i = 0; run && i < count; ++i)
      std::memcpy(out + i * size, content.data(), size);
    if (!run) std::memcpy(out, content.data(), content.size());
    out += count * size;
    left -= count;
  }
  return pixels;
}

Result<Decoded> to_levels(const Header& h, std::span<const std::byte> map, std::span<const std::byte> pixels) {
  Decoded decoded = make_decoded(h.width, h.height, h.channels(), Samples::kU8);
  const std::size_t size = h.pixel_bytes(), map_size = static_cast<std::size_t>(h.map_bits + 7) / 8;
  const std::size_t count = static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height);
  std::byte* out = decoded.data.get();
  for (std::size_t i = 0; i < count; ++i, out += h.channels()) {
    const std::byte* in = pixels.data() + i * size;
    if (h.kind == 1) {
      std::size_t index = std::to_integer<std::size_t>(in[0]);
      if (size == 2) index |= std::to_integer<std::size_t>(in[1]) << 8;
      if (index < h.map_first || index - h.map_first >= h.map_count)
        return image_damaged(kFormat, "a pixel names a colour that the colour map does not have");
      in = map.data() + (index - h.map_first) * map_size;
    }
    write_levels(h, in, out);
  }
  decoded.orientation = h.from_top ? (h.from_right ? 2 : 1) : (h.from_right ? 3 : 4);
  return decoded;
}

} // namespace

bool looks_like_tga(std::span<const std::byte> file) {
  if (file.size() < kHeaderBytes) return false;
  ByteReader reader(file);
  const Header h = read_header(reader);
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

Result<Decoded> decode_tga(std::span<const std::byte> file) {
  ByteReader reader(file);
  const Header h = read_header(reader);
  if (const auto size = check_size(h.width, h.height, kFormat); !size) return size.error();
  reader.skip(h.id_bytes);
  const auto map = reader.take(h.map_count * (static_cast<std::size_t>(h.map_bits + 7) / 8));
  if (reader.past_end()) return image_truncated(kFormat);
  if (!h.packed) {
    const std::size_t bytes = static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height) * h.pixel_bytes();
    const auto pixels = reader.take(bytes);
    if (reader.past_end()) return image_truncated(kFormat);
    return to_levels(h, map, pixels);
  }
  const auto pixels = unpack(h, reader);
  if (!pixels) return pixels.error();
  return to_levels(h, map, *pixels);
}

} // namespace oversketch
