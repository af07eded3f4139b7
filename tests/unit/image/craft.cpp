#include "tests/unit/image/craft.h"

#include "core/image/levels.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace oversketch::craft {

namespace {

std::uint32_t crc32(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const std::byte b : bytes) {
    crc ^= std::to_integer<std::uint32_t>(b);
    for (int i = 0; i < 8; ++i)
      crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

std::uint32_t adler32(std::span<const std::byte> bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::byte byte : bytes) {
    a = (a + std::to_integer<std::uint32_t>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

Bytes stored_zlib(const Bytes& raw) {
  Writer out;
  out.u8(0x78).u8(0x01);
  for (std::size_t at = 0; at < raw.size(); at += 65535) {
    const std::size_t size = std::min<std::size_t>(65535, raw.size() - at);
    out.u8(at + size == raw.size()).u16(static_cast<unsigned>(size)).u16(~static_cast<unsigned>(size) & 0xffff);
    out.bytes(std::span(raw).subspan(at, size));
  }
  return out.u32_big(adler32(raw)).done();
}

/// The rows of the pixels x0, x0 + dx, … of rows y0, y0 + dy, …
void add_pass(const Png& png, std::uint32_t x0, std::uint32_t y0, std::uint32_t dx, std::uint32_t dy, Writer& raw) {
  if (x0 >= png.width) return;
  const auto channels = static_cast<std::size_t>(png_channels(png.color_type));
  for (std::uint32_t y = y0; y < png.height; y += dy) {
    raw.u8(0);
    unsigned bits = 0, pending = 0;
    for (std::uint32_t x = x0; x < png.width; x += dx)
      for (std::size_t c = 0; c < channels; ++c) {
        const unsigned sample = png.samples.at((std::size_t{y} * png.width + x) * channels + c);
        if (png.depth == 16) raw.u16_big(sample);
        if (png.depth == 8) raw.u8(sample);
        if (png.depth >= 8) continue;
        bits = bits << png.depth | sample;
        pending += static_cast<unsigned>(png.depth);
        if (pending == 8) raw.u8(bits), bits = pending = 0;
      }
    if (pending > 0) raw.u8(bits << (8 - pending));
  }
}

} // namespace

Writer& Writer::u8(unsigned value) {
  bytes_.push_back(static_cast<std::byte>(value & 255));
  return *this;
}
Writer& Writer::u16(unsigned value) {
  return u8(value).u8(value >> 8);
}
Writer& Writer::u32(std::uint32_t value) {
  return u16(value & 0xffff).u16(value >> 16);
}
Writer& Writer::u16_big(unsigned value) {
  return u8(value >> 8).u8(value);
}
Writer& Writer::u32_big(std::uint32_t value) {
  return u16_big(value >> 16).u16_big(value & 0xffff);
}
Writer& Writer::text(std::string_view text) {
  for (const char c : text)
    u8(static_cast<unsigned char>(c));
  return *this;
}
Writer& Writer::bytes(std::span<const std::byte> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return *this;
}
Writer& Writer::zeros(std::size_t count) {
  bytes_.resize(bytes_.size() + count);
  return *this;
}

int png_channels(int color_type) {
  constexpr std::array kChannels{1, 0, 3, 1, 2, 0, 4};
  return kChannels.at(static_cast<std::size_t>(color_type));
}

Bytes png_chunk(std::string_view type, std::span<const std::byte> content) {
  const Bytes body = Writer().text(type).bytes(content).done();
  return Writer().u32_big(static_cast<std::uint32_t>(content.size())).bytes(body).u32_big(crc32(body)).done();
}

Bytes make_png(const Png& png) {
  Writer header;
  header.u32_big(png.width).u32_big(png.height).u8(static_cast<unsigned>(png.depth));
  header.u8(static_cast<unsigned>(png.color_type)).u8(0).u8(0).u8(png.interlaced ? 1 : 0);
  Writer raw;
  if (png.interlaced) {
    constexpr std::array<std::array<std::uint32_t, 4>, 7> kAdam7{
        {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
    for (const auto& [x0, y0, dx, dy] : kAdam7)
      add_pass(png, x0, y0, dx, dy, raw);
  } else {
    add_pass(png, 0, 0, 1, 1, raw);
  }
  Writer out;
  out.text("\x89PNG\r\n\x1a\n").bytes(png_chunk("IHDR", header.done())).bytes(png.before_pixels);
  out.bytes(png_chunk("IDAT", stored_zlib(raw.done()))).bytes(png.after_pixels);
  return out.bytes(png_chunk("IEND", {})).done();
}

Bytes tiff_block(unsigned orientation, bool big_endian) {
  Writer out;
  if (big_endian) {
    out.text("MM").u16_big(42).u32_big(8).u16_big(1);
    out.u16_big(0x0112).u16_big(3).u32_big(1).u16_big(orientation).u16_big(0).u32_big(0);
  } else {
    out.text("II").u16(42).u32(8).u16(1).u16(0x0112).u16(3).u32(1).u16(orientation).u16(0).u32(0);
  }
  return out.done();
}

Bytes exif_block(unsigned orientation, bool big_endian) {
  return Writer().text({"Exif\0\0", 6}).bytes(tiff_block(orientation, big_endian)).done();
}

Bytes with_app1(const Bytes& jpeg, std::span<const std::byte> content) {
  const auto length = static_cast<unsigned>(content.size() + 2);
  return Writer()
      .bytes(std::span(jpeg).first(2))
      .u8(0xff)
      .u8(0xe1)
      .u16_big(length)
      .bytes(content)
      .bytes(std::span(jpeg).subspan(2))
      .done();
}

Writer begin_tga(const TgaHeader& h) {
  Writer out;
  out.u8(0).u8(h.map_bits != 0 ? 1 : 0).u8(h.type).u16(0).u16(h.map_count).u8(h.map_bits).u16(0).u16(0);
  return out.u16(h.width).u16(h.height).u8(h.bits).u8(h.descriptor);
}

Writer begin_bmp(const BmpHeader& h) {
  const std::size_t behind = h.header_bytes == 40 ? h.masks.size() * 4 : 0;
  const std::size_t offset = 14 + h.header_bytes + behind + h.palette * 4 + h.gap;
  Writer out;
  out.text("BM").u32(0).u32(0).u32(static_cast<std::uint32_t>(offset)).u32(h.header_bytes);
  out.u32(static_cast<std::uint32_t>(h.width)).u32(static_cast<std::uint32_t>(h.height)).u16(1).u16(h.bits);
  out.u32(h.compression).u32(0).u32(0).u32(0).u32(h.palette).u32(0);
  for (const std::uint32_t mask : h.masks)
    out.u32(mask);
  return out.zeros(14 + h.header_bytes + behind - out.done().size());
}

Writer begin_hdr(std::string_view size_line, std::string_view lines) {
  return Writer().text("#?RADIANCE\n").text(lines).text("\n").text(size_line).text("\n");
}

Bytes read_data(std::string_view name) {
  std::ifstream file(std::string(OVERSKETCH_SOURCE_DIR "/tests/data/images/") + std::string(name), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return Writer().text(text).done();
}

std::vector<int> levels_of(const Image& image) {
  const std::vector<std::uint8_t> levels = to_rgba8(image);
  return {levels.begin(), levels.end()};
}

} // namespace oversketch::craft
