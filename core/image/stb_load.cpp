#include "core/image/stb_load.h"

#include "core/image/image_io.h"

#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <stb_image.h>

namespace oversketch {

namespace {

/// A file in memory as stb_image reads it, in blocks; a short block says nothing, a read with nothing left does.
class StbSource {
public:
  explicit StbSource(std::span<const std::byte> file) : left_(file) {}

  bool read_past_end() const { return read_past_end_; }

  bool at_end() const { return left_.empty(); }
  int read(char* to, int wanted) {
    if (left_.empty()) {
      // stb_image takes the end for zeros without end, and a run of no pixels would never fill an HDR's line.  A byte
      // at a time, so that at the end of a block the end of the file still shows.
      read_past_end_ = true;
      *to = 2;
      return 1;
    }
    const std::size_t count = std::min(left_.size(), static_cast<std::size_t>(wanted));
    std::memcpy(to, left_.data(), count);
    left_ = left_.subspan(count);
    return static_cast<int>(count);
  }
  /// Past the end too: the filling bytes of a BMP's last row may be missing.
  void skip(int count) { left_ = left_.subspan(std::min(left_.size(), static_cast<std::size_t>(count))); }

private:
  std::span<const std::byte> left_;
  bool read_past_end_ = false;
};

constexpr stbi_io_callbacks kCallbacks{
    [](void* source, char* to, int count) { return static_cast<StbSource*>(source)->read(to, count); },
    [](void* source, int count) { static_cast<StbSource*>(source)->skip(count); },
    [](void* source) { return static_cast<StbSource*>(source)->at_end() ? 1 : 0; }};

Error failure(std::string_view format) {
  const std::string_view reason = stbi_failure_reason();
  if (reason == "outofmem") throw std::bad_alloc();
  if (reason == "too large") return image_too_large(format, "its samples take more than 2 GiB");
  return image_damaged(format, "stb_image says: " + std::string(reason));
}

/// That stb_image reads the header as we do, so that it allocates no more than was allowed.
Result<void> check_header(std::span<const std::byte> file, const StbPicture& picture) {
  if (const auto size = check_size(picture.width, picture.height, picture.format, kMaxPixels); !size)
    return size.error();
  StbSource source(file);
  int width = 0, height = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, nullptr))
    return image_unsupported(picture.format,
                             "a header that stb_image does not know (" + std::string(stbi_failure_reason()) + ")");
  // A BMP's height is negative where its rows run down.
  if (width != picture.width || std::abs(std::int64_t{height}) != picture.height)
    return image_damaged(picture.format, "its header gives two sizes");
  return {};
}

} // namespace

Result<Decoded> load_with_stb(std::span<const std::byte> file, const StbPicture& picture) {
  // stb_image counts bytes in an int.
  if (file.size() > std::numeric_limits<int>::max()) return image_too_large(picture.format, "its file is above 2 GiB");
  if (const auto header = check_header(file, picture); !header) return header.error();
  StbSource source(file);
  int width = 0, height = 0, stored = 0;
  void* const pixels = picture.samples == Samples::kFloat
                           ? static_cast<void*>(stbi_loadf_from_callbacks(&kCallbacks, &source, &width, &height,
                                                                          &stored, picture.channels))
                           : stbi_load_from_callbacks(&kCallbacks, &source, &width, &height, &stored, picture.channels);
  PixelMemory data(static_cast<std::byte*>(pixels), stbi_image_free);
  if (source.read_past_end()) return image_truncated(picture.format);
  if (!data) return failure(picture.format);
  CHECK(width == picture.width && height == picture.height, "stb_image's header and picture differ");
  return Decoded{width, height, picture.channels, picture.samples, 1, std::move(data)};
}

} // namespace oversketch
