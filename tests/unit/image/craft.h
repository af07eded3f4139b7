#pragma once

#include "core/base/result.h"
#include "core/image/image.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Picture files made byte by byte, independently of the encoders under test.
namespace oversketch::craft {

using Bytes = std::vector<std::byte>;

/// Appends numbers and text.
class Writer {
public:
  Writer& u8(unsigned value);
  Writer& u16(unsigned value);
  Writer& u32(std::uint32_t value);
  Writer& u16_big(unsigned value);
  Writer& u32_big(std::uint32_t value);
  Writer& text(std::string_view text);
  Writer& bytes(std::span<const std::byte> bytes);
  Writer& zeros(std::size_t count);
  const Bytes& done() const { return bytes_; }

private:
  Bytes bytes_;
};

struct Png {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  int depth = 8;
  /// 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA.
  int color_type = 2;
  bool interlaced = false;
  /// width · height · channels samples of `depth` bits.
  std::vector<unsigned> samples = {};
  /// Whole chunks put before and after the pixels (see png_chunk).
  Bytes before_pixels = {};
  Bytes after_pixels = {};
};

int png_channels(int color_type);
/// Length, type, content and CRC.
Bytes png_chunk(std::string_view type, std::span<const std::byte> content);
/// Filter 0, stored deflate blocks, one IDAT.
Bytes make_png(const Png& png);

/// "Exif\0\0", a TIFF header and one IFD with the orientation.
Bytes exif_block(unsigned orientation, bool big_endian = false);
/// The same without the first six bytes, as PNG keeps it.
Bytes tiff_block(unsigned orientation, bool big_endian = false);
/// `jpeg` with an APP1 segment behind its first marker.
Bytes with_app1(const Bytes& jpeg, std::span<const std::byte> content);

/// 18 bytes.
struct TgaHeader {
  unsigned type = 2;
  unsigned map_count = 0;
  unsigned map_bits = 0;
  unsigned width = 1;
  unsigned height = 1;
  unsigned bits = 24;
  unsigned descriptor = 0x20;
};
Writer begin_tga(const TgaHeader& header);

/// File header and an information header of `header_bytes`, 40 or more, with `palette` entries to come.  `masks`, by
/// compression 3, are written here: behind a header of 40 bytes, inside a longer one.
struct BmpHeader {
  int width = 1;
  int height = 1;
  unsigned bits = 24;
  unsigned palette = 0;
  unsigned compression = 0;
  std::vector<std::uint32_t> masks = {};
  unsigned header_bytes = 40;
  /// Bytes between header or palette and the pixels; the caller writes them.
  unsigned gap = 0;
};
Writer begin_bmp(const BmpHeader& header);

Writer begin_hdr(std::string_view size_line, std::string_view lines = "FORMAT=32-bit_rle_rgbe\n");

Bytes read_data(std::string_view name);

/// Pixels of one row after the other as "r g b a" levels, for comparing at a glance.
std::vector<int> levels_of(const Image& image);
/// The code of the error, or "" when there is none.
template <class T>
std::string code_of(const Result<T>& result) {
  return result ? std::string() : result.error().code;
}

/// The same numbers on every machine (xorshift64*).
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL + 1) {}
  std::uint64_t next() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return state_ * 0x2545f4914f6cdd1dULL;
  }
  std::size_t below(std::size_t end) { return static_cast<std::size_t>((next() >> 11) % end); }
  float unit() { return static_cast<float>(next() >> 40) / 16777216.0f; }

private:
  std::uint64_t state_;
};

} // namespace oversketch::craft
