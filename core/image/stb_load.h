#pragma once

#include "core/image/decoded.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace oversketch {

/// What a file's header says of its picture, as the format's own file has read and checked it.
struct StbPicture {
  std::string_view format;
  std::int64_t width = 0;
  std::int64_t height = 0;
  /// What is asked for, 1…4; alpha that the file has is dropped where there is no room for it.
  int channels = 3;
  /// kU8, or kFloat for HDR's linear values as stored.
  Samples samples = Samples::kU8;
};

/// Decodes BMP, TGA or HDR with stb_image, which fills in what a file is too short for and reads some headers in its
/// own way.  Here both are errors: a read past the file's end, and a size other than `picture` has.
///
/// @errors image.truncated; image.damaged, with stb_image's reason; image.unsupported (a header that it does not know);
///   those of check_size, before anything is allocated; image.too-large also above 2 GiB of samples.
/// @throws std::bad_alloc
/// @threads safe from several threads.
Result<Decoded> load_with_stb(std::span<const std::byte> file, const StbPicture& picture);

} // namespace oversketch
