#include "core/session/picture_loader.h"

#include "core/image/image_io.h"

#include <algorithm>

namespace oversketch {

Result<void> PictureLoader::load_into(Command& command) {
  for (ImageRef* ref : images_to_load(command)) {
    auto known = loaded_.find(ref->name);
    if (known == loaded_.end()) {
      const std::size_t most = std::min<std::size_t>(memory_left_ / sizeof(Rgba), kMaxPixels);
      auto image = load_image(folder_ / ref->name, static_cast<std::int64_t>(most));
      if (!image) return image.error();
      if (image->bytes() > memory_left_)
        return Error{"image.too-large", "The picture and its file need more memory than the program may take.",
                     (folder_ / ref->name).string()};
      memory_left_ -= image->bytes();
      known = loaded_.emplace(ref->name, std::move(*image)).first;
    }
    ref->image = known->second;
  }
  return count_canvas(command);
}

Result<void> PictureLoader::count_canvas(const Command& command) {
  const auto* begin = std::get_if<DocumentNew>(&command);
  if (begin == nullptr || begin->target || begin->width.value_or(0) <= 0 || begin->height.value_or(0) <= 0) return {};
  const std::size_t bytes =
      static_cast<std::size_t>(*begin->width) * static_cast<std::size_t>(*begin->height) * sizeof(Rgba);
  if (bytes > memory_left_)
    return Error{"image.too-large", "the canvas needs more memory than the program may take", ""};
  memory_left_ -= bytes;
  return {};
}

} // namespace oversketch
