#include "core/image/decoded.h"

#include <spng.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace oversketch {

namespace {

constexpr std::string_view kFormat = "PNG";
constexpr std::size_t kSignatureBytes = 8;
/// No byte of a deflate stream can stand for more than this many (RFC 1951: 258 bytes from 2 bits).
constexpr std::uint64_t kMostInflation = 1032;

constexpr std::uint32_t chunk(const char (&name)[5]) {
  std::uint32_t type = 0;
  for (int i = 0; i < 4; ++i)
    type = type << 8 | static_cast<unsigned char>(name[i]);
  return type;
}

/// What can be known of a PNG without decoding it.
struct Layout {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int depth = 0;
  int color_type = 0;
  bool has_transparency = false;
  std::uint64_t compressed_bytes = 0;
  std::span<const std::byte> exif;
};

Result<Layout> read_header(ByteReader& reader, std::int64_t most_pixels) {
  Layout layout;
  const std::uint32_t length = reader.u32_big(), type = reader.u32_big();
  layout.width = reader.u32_big();
  layout.height = reader.u32_big();
  layout.depth = reader.u8();
  layout.color_type = reader.u8();
  reader.skip(3 + 4);
  if (reader.past_end()) return image_truncated(kFormat);
  if (length != 13 || type != chunk("IHDR")) return image_damaged(kFormat, "it does not begin with its header");
  if (const auto size = check_size(layout.width, layout.height, kFormat, most_pixels); !size) return size.error();
  return layout;
}

/// Walks from chunk to chunk to IEND: a file that was cut off anywhere is found here.
Result<Layout> read_layout(std::span<const std::byte> file, std::int64_t most_pixels) {
  ByteReader reader(file, kSignatureBytes);
  Result<Layout> header = read_header(reader, most_pixels);
  if (!header) return header;
  Layout& layout = *header;
  for (std::uint32_t type = 0; type != chunk("IEND");) {
    const std::uint32_t length = reader.u32_big();
    type = reader.u32_big();
    const auto content = reader.take(length);
    reader.skip(4);
    if (reader.past_end()) return image_truncated(kFormat);
    if (type == chunk("IDAT")) layout.compressed_bytes += length;
    if (type == chunk("tRNS") && layout.compressed_bytes == 0) layout.has_transparency = true;
    if (type == chunk("eXIf") && layout.exif.empty()) layout.exif = content;
  }
  if (layout.compressed_bytes == 0) return image_damaged(kFormat, "it has no pixels");
  const std::uint64_t least_bits = std::uint64_t{layout.width} * layout.height * static_cast<unsigned>(layout.depth);
  if (least_bits / 8 > layout.compressed_bytes * kMostInflation)
    return image_damaged(kFormat, "it is too short for the size that its header tells");
  return header;
}

int png_orientation(std::span<const std::byte> exif) {
  if (exif.empty()) return 1;
  constexpr std::array<char, 6> kPrefix{'E', 'x', 'i', 'f', '\0', '\0'};
  std::vector<std::byte> block(kPrefix.size() + exif.size());
  std::transform(kPrefix.begin(), kPrefix.end(), block.begin(), [](char c) { return static_cast<std::byte>(c); });
  std::copy(exif.begin(), exif.end(), block.begin() + kPrefix.size());
  return exif_orientation(block);
}

Error to_error(int code) {
  if (code == SPNG_IO_EOF) return image_truncated(kFormat);
  if (code == SPNG_EMEM || code == SPNG_EOVERFLOW) return image_too_large(kFormat, "there is not enough memory");
  return image_damaged(kFormat, spng_strerror(code));
}

} // namespace

Result<Decoded> decode_png(std::span<const std::byte> file, std::int64_t most_pixels) {
  const Result<Layout> layout = read_layout(file, most_pixels);
  if (!layout) return layout.error();
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
  if (!context) return image_too_large(kFormat, "there is not enough memory");
  spng_set_crc_action(context.get(), SPNG_CRC_ERROR, SPNG_CRC_ERROR);
  if (const int code = spng_set_png_buffer(context.get(), file.data(), file.size())) return to_error(code);

  const bool wide = layout->depth == 16;
  const bool alpha = layout->has_transparency || (layout->color_type & 4) != 0;
  const int format = wide ? SPNG_FMT_RGBA16 : alpha ? SPNG_FMT_RGBA8 : SPNG_FMT_RGB8;
  Decoded decoded = make_decoded(static_cast<int>(layout->width), static_cast<int>(layout->height),
                                 format == SPNG_FMT_RGB8 ? 3 : 4, wide ? Samples::kU16 : Samples::kU8);
  const std::size_t bytes = decoded.row_bytes() * layout->height;
  if (const int code = spng_decode_image(context.get(), decoded.data.get(), bytes, format, SPNG_DECODE_TRNS))
    return to_error(code);
  // The chunks behind the pixels too: a damaged one means that the file is not what was written.
  if (const int code = spng_decode_chunks(context.get())) return to_error(code);
  decoded.orientation = png_orientation(layout->exif);
  return decoded;
}

} // namespace oversketch
