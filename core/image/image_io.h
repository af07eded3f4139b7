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

/// Reads PNG (all kinds; 16 bits at 16 bits), JPEG (baseline and progressive, grey, colour, CMYK), BMP (uncompressed,
/// 1, 4, 8, 16, 24 or 32 bits), TGA (all kinds of pixels), Radiance HDR (rows from the top), and Oversketch's own
/// float pictures (exact.h); what a file is, its first bytes say, not its name.
///
/// - The EXIF orientation (1–8) of JPEG and PNG is applied; hostile or senseless EXIF counts as none.
/// - Values are taken as sRGB: colour profiles and PNG's gamma are not looked at.  CMYK is turned into RGB without a
///   profile, r = (1 − c)(1 − k).  HDR's linear values are encoded with the sRGB curve, continued above 1; its exposure
///   lines are not looked at.
/// - Alpha is kept straight.  A TGA of 32 bits (grey: 16) has alpha where its header counts alpha bits, a BMP where
///   its header (Windows 95's or later) has a mask for it.
/// - Of an animated PNG the still picture is read; of several JPEGs in one file the first.
/// - Nothing is filled in: a picture that is cut short, or a PNG with a wrong checksum anywhere, is an error.  JPEG has
///   no checksums, so that damage which still decodes cannot be seen.  What follows the picture's end is not read; the
///   filling bytes of a BMP's last row may be missing.
///
/// @errors image.missing, image.unreadable (a folder, no permission), image.unknown-format, image.truncated,
///   image.damaged, image.unsupported (a kind of these formats that is not read), image.too-large (above `most_pixels`
///   or kMaxPixels, before anything is allocated; or not enough memory); `where` is the path.
/// @cost about 14 ns a pixel for JPEG, 17 for PNG, of which turning it into floats takes 9, mostly for
///   fresh memory; 16 bytes a pixel and the file's own bytes (Image::file()) are kept and up to 8 (12 for HDR, 6 more
///   for a progressive JPEG) needed besides while reading.
/// @threads safe from several threads.
Result<Image> load_image(const std::filesystem::path& path, std::int64_t most_pixels = kMaxPixels);

/// The same from memory; `where` of errors is empty.
Result<Image> decode_image(std::span<const std::byte> bytes, std::int64_t most_pixels = kMaxPixels);

/// The same, and the picture keeps the bytes (Image::file()).
Result<Image> decode_file(std::vector<std::byte> bytes, std::int64_t most_pixels = kMaxPixels);

enum class BitDepth { k8, k16 };

/// Whether a PNG has alpha: where a pixel needs it, or also where all are opaque.
enum class PngAlpha { kWhereNeeded, kAlways };

/// What every encoder asks of a picture.
/// @errors image.empty, image.not-finite (a value is NaN or infinite).
Result<void> check_exportable(const Image& image);

/// Values become levels as levels.h says.  Colour is r, g, b marked as sRGB; alpha is needed when any pixel's rounds to
/// less than the highest level.
/// @errors those of check_exportable; image.encode (no memory).
/// @cost about 22 ns a pixel on photographs at 8 bits, 32 at 16.
Result<std::vector<std::byte>> encode_png(const Image& image, BitDepth depth = BitDepth::k8,
                                          PngAlpha alpha = PngAlpha::kWhereNeeded);

/// @param quality 1…100.  Alpha is dropped: composite first.
/// Colour is kept at full resolution (4:4:4).
/// @errors those of check_exportable; image.too-large (65500 pixels a side at most); image.encode (no memory).
/// @cost about 11 ns a pixel.
Result<std::vector<std::byte>> encode_jpeg(const Image& image, int quality = 95);

/// Whether save_image() writes transparency under that name.
bool keeps_alpha(const std::filesystem::path& path);

/// Writes PNG or JPEG by the path's extension (.png, .jpg, .jpeg, any case).  The file appears whole or not at all: it
/// is written beside, synced, then renamed.
/// @errors image.unknown-extension, image.depth (16 bit asked of JPEG), those of the encoders, file.write (with the
/// system's reason).
Result<void> save_image(const Image& image, const std::filesystem::path& path, BitDepth depth = BitDepth::k8);

} // namespace oversketch
