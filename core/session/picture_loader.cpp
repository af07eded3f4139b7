#include "core/session/picture_loader.h"

#include "core/image/image_io.h"

namespace oversketch {

Result<void> PictureLoader::load_into(Command& command) {
  for (ImageRef* ref : images_to_load(command)) {
    auto known = loaded_.find(ref->name);
    if (known == loaded_.end()) {
      auto image = load_image(folder_ / ref->name);
      if (!image) return image.error();
      known = loaded_.emplace(ref->name, std::move(*image)).first;
    }
    ref->image = known->second;
  }
  return {};
}

} // namespace oversketch
