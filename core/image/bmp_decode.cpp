#include "core/image/decoded.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace oversketch {

namespace {

constexpr std::string_view kFormat = "BMP";

/// One colour of a pixel as bits of a number, given back as a level of 0…255.
struct Field {
  std::uint32_t mask = 0;
  int shift = 0;
  std::uint64_t top = 0;

  explicit Field(std::uint32_t bits = 0)
      : mask(bits), shift(bits ? std::countr_zero(bits) : 0), top(std::uint64_t{bits} >> shift) {}
  bool contiguous() const { return (top & (top + 1)) == 0; }
  std::uint8_t level(std::uint32_t pixel) const {
    if (top == 0) return 0;
    return static_cast<std::uint8_t>(((pixel & mask) >> shift) * std::uint64_t{255} / top +
                                     (((pixel & mask) >> shift) * std::uint64_t{255} % top * 2 >= top ? 1 : 0));
  }
};

struct Header {
  std::size_t pixels_at = 0;
  std::int64_t width = 0;
  std::int64_t height = 0;
  bool top_down = false;
  int bits = 0;
  std::array<Field, 4> fields;
  /// r g b of each entry.
  std::vector<std::array<std::uint8_t, 3>> palette;

  bool has_alpha() const { return fields[3].mask != 0; }
  /// Rows begin at multiples of 4 bytes; the last one need not be filled up.
  std::uint64_t row_bytes() const { return (static_cast<std::uint64_t>(width) * bits + 7) / 8; }
  std::uint64_t stride() const { return (row_bytes() + 3) / 4 * 4; }
};

/// Windows 3 and later: BITMAPINFOHEADER and its longer successors.
Result<void> read_info_header(ByteReader& reader, std::uint32_t header_bytes, Header& h, std::uint32_t& colors) {
  const std::size_t start = reader.position() - 4;
  h.width = static_cast<std::int32_t>(reader.u32());
  h.height = static_cast<std::int32_t>(reader.u32());
  reader.skip(2);
  h.bits = static_cast<int>(reader.u16());
  const std::uint32_t compression = reader.u32();
  reader.skip(12);
  colors = reader.u32();
  reader.skip(4);
  // 3 and 6: masks for three and four colours, in the longer headers or behind the short one.
  const bool masked = compression == 3 || compression == 6;
  if (compression != 0 && !masked) return image_unsupported(kFormat, "compressed pixels");
  if (masked && h.bits != 16 && h.bits != 32)
    return image_damaged(kFormat, "colour masks for pixels of other than 16 or 32 bits");
  if (masked) {
    const int count = header_bytes >= 56 || compression == 6 ? 4 : 3;
    for (int i = 0; i < count; ++i)
      h.fields[static_cast<std::size_t>(i)] = Field(reader.u32());
  }
  if (reader.position() < start + header_bytes) reader.skip(start + header_bytes - reader.position());
  return {};
}

Result<Header> read_header(ByteReader& reader, std::uint32_t& header_bytes, std::uint32_t& colors) {
  Header h;
  reader.skip(10);
  h.pixels_at = reader.u32();
  header_bytes = reader.u32();
  if (header_bytes == 12) {
    h.width = reader.u16();
    h.height = reader.u16();
    reader.skip(2);
    h.bits = static_cast<int>(reader.u16());
  } else if (header_bytes >= 40 && header_bytes <= 1024) {
    if (const auto info = read_info_header(reader, header_bytes, h, colors); !info) return info.error();
  } else if (!reader.past_end()) {
    return image_unsupported(kFormat, "a header of " + std::to_string(header_bytes) + " bytes");
  }
  if (reader.past_end()) return image_truncated(kFormat);
  h.top_down = h.height < 0;
  h.height = std::abs(h.height);
  return h;
}

Result<void> check_colors(Header& h) {
  constexpr std::array kDepths{1, 2, 4, 8, 16, 24, 32};
  if (std::find(kDepths.begin(), kDepths.end(), h.bits) == kDepths.end())
    return image_damaged(kFormat, std::to_string(h.bits) + " bits a pixel");
  if (h.bits >= 16 && h.fields[0].mask == 0 && h.fields[1].mask == 0 && h.fields[2].mask == 0) {
    // Without masks the order is blue, green, red; the fourth byte (the sixteenth bit) means nothing.
    if (h.bits == 16) h.fields = {Field(0x7c00), Field(0x03e0), Field(0x001f), Field()};
    if (h.bits != 16) h.fields = {Field(0xff0000), Field(0x00ff00), Field(0x0000ff), Field()};
  }
  for (const Field& field : h.fields)
    if (!field.contiguous()) return image_damaged(kFormat, "a colour mask has holes");
  return {};
}

Result<void> read_palette(ByteReader& reader, std::uint32_t header_bytes, std::uint32_t colors, Header& h) {
  if (h.pixels_at < reader.position()) return image_damaged(kFormat, "its pixels are said to lie inside its header");
  if (h.bits > 8) return {};
  const std::size_t most = std::size_t{1} << h.bits;
  if (colors > most) return image_damaged(kFormat, "its palette has more colours than its pixels can name");
  const std::size_t entry = header_bytes == 12 ? 3 : 4;
  const std::size_t room = (h.pixels_at - reader.position()) / entry;
  const std::size_t count = std::min(colors == 0 ? most : colors, room);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t blue = reader.u8(), green = reader.u8(), red = reader.u8();
    if (entry == 4) reader.skip(1);
    h.palette.push_back({red, green, blue});
  }
  if (reader.past_end()) return image_truncated(kFormat);
  return {};
}

/// False when a pixel names a colour that the palette does not have.
bool decode_indexed(const Header& h, std::span<const std::byte> row, std::byte* out) {
  const unsigned mask = (1U << h.bits) - 1, per_byte = 8U / static_cast<unsigned>(h.bits);
  for (std::size_t x = 0; x < static_cast<std::size_t>(h.width); ++x) {
    const unsigned shift = 8U - static_cast<unsigned>(h.bits) * (static_cast<unsigned>(x % per_byte) + 1);
    const std::size_t index = std::to_integer<unsigned>(row[x / per_byte]) >> shift & mask;
    if (index >= h.palette.size()) return false;
    for (const std::uint8_t level : h.palette[index])
      *out++ = std::byte{level};
  }
  return true;
}

void decode_direct(const Header& h, std::span<const std::byte> row, std::byte* out) {
  ByteReader reader(row);
  const std::size_t channels = h.has_alpha() ? 4 : 3;
  for (std::int64_t x = 0; x < h.width; ++x) {
    std::uint32_t pixel = reader.u16();
    if (h.bits == 24) pixel |= std::uint32_t{reader.u8()} << 16;
    if (h.bits == 32) pixel |= reader.u16() << 16;
    for (std::size_t c = 0; c < channels; ++c)
      *out++ = std::byte{h.fields[c].level(pixel)};
  }
}

void decode_bgr(const Header& h, std::span<const std::byte> row, std::byte* out) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(h.width) * 3; i += 3) {
    out[i] = row[i + 2];
    out[i + 1] = row[i + 1];
    out[i + 2] = row[i];
  }
}

} // namespace

Result<Decoded> decode_bmp(std::span<const std::byte> file) {
  ByteReader reader(file);
  std::uint32_t header_bytes = 0, colors = 0;
  Result<Header> header = read_header(reader, header_bytes, colors);
  if (!header) return header.error();
  Header& h = *header;
  if (const auto size = check_size(h.width, h.height, kFormat); !size) return size.error();
  if (const auto checked = check_colors(h); !checked) return checked.error();
  if (const auto palette = read_palette(reader, header_bytes, colors, h); !palette) return palette.error();
  const std::uint64_t needed = h.stride() * static_cast<std::uint64_t>(h.height - 1) + h.row_bytes();
  if (h.pixels_at > file.size() || file.size() - h.pixels_at < needed) return image_truncated(kFormat);

  Decoded decoded =
      make_decoded(static_cast<int>(h.width), static_cast<int>(h.height), h.has_alpha() ? 4 : 3, Samples::kU8);
  for (int y = 0; y < decoded.height; ++y) {
    const auto row = file.subspan(h.pixels_at + h.stride() * static_cast<std::uint64_t>(y), h.row_bytes());
    std::byte* const out = decoded.row(h.top_down ? y : decoded.height - 1 - y);
    if (h.bits == 24) decode_bgr(h, row, out);
    if (h.bits > 8 && h.bits != 24) decode_direct(h, row, out);
    if (h.bits <= 8 && !decode_indexed(h, row, out))
      return image_damaged(kFormat, "a pixel names a colour that the palette does not have");
  }
  return decoded;
}

} // namespace oversketch
