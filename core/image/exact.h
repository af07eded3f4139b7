#pragma once

#include "core/base/result.h"
#include "core/image/image.h"
#include "core/image/image_io.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace oversketch {

/// The depth at which a PNG gives the picture back to the bit; none when neither does, as for HDR.
/// @cost about 4 ns a pixel each.
std::optional<BitDepth> exact_depth(const Image& image);

/// A picture in the smallest form that decode_image() gives back bit for bit.
struct ExactPicture {
  std::vector<std::byte> bytes;
  /// ".png", or ".osf" (see encode_floats).
  std::string_view extension;
};

/// @errors those of encode_png.
Result<ExactPicture> encode_exact(const Image& image);

/// Oversketch's own float form, for values that no PNG holds: the bytes "OSFLOAT1", width and height (32 bits each, low
/// byte first), then the pixels' 16 bytes (r g b a, IEEE floats, low byte first) in 16 planes: the first byte of every
/// pixel, the second of every pixel, …, which packs well.
/// @errors image.empty, image.not-finite.
Result<std::vector<std::byte>> encode_floats(const Image& image);

struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// First bytes that read_image_size() wants to see.
inline constexpr std::size_t kSizeHeaderBytes = 33;

/// What the first bytes of a PNG or a float picture say of its size.  Nothing is allocated for it.
/// @errors image.unknown-format (any other kind of file), image.truncated, image.damaged, image.too-large (more than
///   `most_pixels` or kMaxPixels).
Result<ImageSize> read_image_size(std::span<const std::byte> first_bytes, std::int64_t most_pixels = kMaxPixels);

} // namespace oversketch
