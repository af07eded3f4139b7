#pragma once

#include "core/base/result.h"
#include "core/image/image.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace oversketch {

/// Largest picture that is opened, pixels (200 megapixels: 3.2 GB as float RGBA).
inline constexpr std::int64_t kMaxPixels = 200'000'000;

/// Reads PNG (8 and 16 bit), JPEG, BMP, TGA or Radiance HDR; the EXIF orientation (1–8) is applied, alpha kept straight.
/// HDR's linear values are encoded with the sRGB curve, continued above 1.
///
/// @errors image.missing, image.unreadable (a folder, no permission), image.unknown-format, image.truncated,
///   image.damaged, image.too-large (before anything is allocated), image.not-finite; `where` is the path.
Result<Image> load_image(const std::filesystem::path& path);

/// The same from memory; `where` of errors is empty.
Result<Image> decode_image(std::span<const std::byte> bytes);

enum class BitDepth { k8, k16 };

/// Values are rounded to the nearest level and clamped to 0…1 here and only here.  Alpha is written when any pixel has
/// alpha below 1.
/// @errors image.empty.
Result<std::vector<std::byte>> encode_png(const Image& image, BitDepth depth = BitDepth::k8);

/// @param quality 1…100.  Alpha is dropped: composite first.
/// @errors image.empty.
Result<std::vector<std::byte>> encode_jpeg(const Image& image, int quality = 95);

/// Writes PNG or JPEG by the path's extension (.png, .jpg, .jpeg, any case).  The file appears whole or not at all: it is
/// written beside, synced, then renamed.
/// @errors image.unknown-extension, image.depth (16 bit asked of JPEG), file.write (with the system's reason).
Result<void> save_image(const Image& image, const std::filesystem::path& path, BitDepth depth = BitDepth::k8);

} // namespace oversketch
