#include "core/image/image_io.h"

#include "core/base/file.h"
#include "core/image/decoded.h"
#include "core/image/levels.h"

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

namespace oversketch {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kFormatsRead = "PNG, JPEG, BMP, TGA and HDR pictures are read";

struct Format {
  std::string_view signature;
  Result<Decoded> (*decode)(std::span<const std::byte>, std::int64_t most_pixels);
  std::string_view name;
};

constexpr std::array kFormats{Format{"\x89PNG\r\n\x1a\n", decode_png, "PNG"},
                              Format{"\xff\xd8\xff", decode_jpeg, "JPEG"},
                              Format{"BM", decode_bmp, "BMP"},
                              Format{"#?RADIANCE", decode_hdr, "HDR"},
                              Format{"#?RGBE", decode_hdr, "HDR"},
                              Format{"OSFLOAT1", decode_floats, "float"}};

/// Pictures that people try to open and that are not read, to tell them so by name.
struct Foreign {
  std::size_t at;
  std::string_view signature;
  std::string_view name;
};

constexpr std::array kForeign{Foreign{0, "GIF8", "GIF"},       Foreign{8, "WEBP", "WebP"},
                              Foreign{0, "II*\0"sv, "TIFF"},   Foreign{0, "MM\0*"sv, "TIFF"},
                              Foreign{0, "8BPS", "Photoshop"}, Foreign{4, "ftypavif", "AVIF"},
                              Foreign{4, "ftyphei", "HEIC"},   Foreign{4, "ftypmif1", "HEIC"},
                              Foreign{0, "%PDF", "PDF"},       Foreign{0, "\x76\x2f\x31\x01", "OpenEXR"},
                              Foreign{0, "gimp xcf", "GIMP"},  Foreign{0, "\xff\x0a", "JPEG XL"},
                              Foreign{4, "JXL ", "JPEG XL"},   Foreign{0, "<svg", "SVG"}};

Error unknown_format(std::string_view text) {
  for (const Foreign& foreign : kForeign)
    if (text.size() > foreign.at && text.substr(foreign.at).starts_with(foreign.signature))
      return {"image.unknown-format",
              "This is a " + std::string(foreign.name) + " file: " + std::string(kFormatsRead) + ".", ""};
  return {"image.unknown-format",
          "This is not a picture, or one of an unknown kind: " + std::string(kFormatsRead) + ".", ""};
}

Result<Decoded> decode(std::span<const std::byte> bytes, std::int64_t most_pixels) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.empty()) return Error{"image.truncated", "The file is empty. Copy or download it again.", ""};
  for (const Format& format : kFormats) {
    if (text.starts_with(format.signature)) return format.decode(bytes, most_pixels);
    if (format.signature.starts_with(text)) return image_truncated(format.name);
  }
  if (looks_like_tga(bytes)) return decode_tga(bytes, most_pixels);
  return unknown_format(text);
}

/// The reader's errors under the names that opening a picture has for them.
Error opening_error(const Error& error) {
  constexpr std::array<std::array<std::string_view, 2>, 3> kNames{{{"file.missing", "image.missing"},
                                                                   {"file.unreadable", "image.unreadable"},
                                                                   {"file.too-large", "image.too-large"}}};
  Error named = error;
  for (const auto& [from, to] : kNames)
    if (error.code == from) named.code = to;
  return named;
}

} // namespace

Result<void> check_exportable(const Image& image) {
  if (image.empty()) return Error{"image.empty", "There are no pixels to save.", ""};
  if (!is_finite(image.pixels().values()))
    return Error{"image.not-finite", "The picture holds values that are no numbers and cannot be saved.", ""};
  return {};
}

Result<Image> decode_image(std::span<const std::byte> bytes, std::int64_t most_pixels) try {
  const Result<Decoded> decoded = decode(bytes, most_pixels);
  if (!decoded) return decoded.error();
  return to_image(*decoded);
} catch (const std::bad_alloc&) {
  return Error{"image.too-large", "There is not enough memory to open this picture.", ""};
}

Result<Image> decode_file(std::vector<std::byte> bytes, std::int64_t most_pixels) {
  auto image = decode_image(bytes, most_pixels);
  if (!image) return image.error();
  return image->with_file(std::move(bytes));
}

Result<Image> load_image(const std::filesystem::path& path, std::int64_t most_pixels) {
  // A pipe or a device may never end.
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  if (kind == std::filesystem::file_type::fifo || kind == std::filesystem::file_type::character ||
      kind == std::filesystem::file_type::socket)
    return Error{"image.unreadable", "The picture cannot be opened: it is no regular file.", path.string()};
  auto bytes = read_file(path);
  if (!bytes) return opening_error(bytes.error());
  Result<Image> image = decode_file(std::move(*bytes), most_pixels);
  if (!image) return at(path.string(), image.error());
  return image;
}

bool keeps_alpha(const std::filesystem::path& path) {
  return ending_of(path) == ".png";
}

Result<void> save_image(const Image& image, const std::filesystem::path& path, BitDepth depth) {
  const std::string extension = ending_of(path);
  const bool png = extension == ".png", jpeg = extension == ".jpg" || extension == ".jpeg";
  if (!png && !jpeg)
    return Error{"image.unknown-extension",
                 "Pictures are saved as .png, .jpg or .jpeg: give the file one of these names.", path.string()};
  if (jpeg && depth == BitDepth::k16)
    return Error{"image.depth", "A JPEG has 8 bits a colour: save 16 bits as a .png.", path.string()};
  const auto bytes = png ? encode_png(image, depth) : encode_jpeg(image);
  if (!bytes) return at(path.string(), bytes.error());
  return write_file(path, std::span<const std::byte>(*bytes));
}

} // namespace oversketch
