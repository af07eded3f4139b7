#include "core/image/image.h"

#include <mutex>
#include <utility>

namespace oversketch {

struct Image::LazyHash {
  std::once_flag once;
  Hash value;
};

Image::Image() : Image(Raster<Rgba>()) {}

Image::Image(Raster<Rgba> pixels)
    : pixels_(std::make_shared<const Raster<Rgba>>(std::move(pixels))), hash_(std::make_shared<LazyHash>()) {}

Image Image::with_file(std::vector<std::byte> file) const {
  Image image = *this;
  image.file_ = std::make_shared<const std::vector<std::byte>>(std::move(file));
  return image;
}

Hash Image::content_hash() const {
  std::call_once(hash_->once,
                 [this] { hash_->value = Hasher().add(width()).add(height()).add(pixels_->values()).finish(); });
  return hash_->value;
}

bool Image::operator==(const Image& other) const {
  return pixels_ == other.pixels_ ||
         (width() == other.width() && height() == other.height() && content_hash() == other.content_hash());
}

} // namespace oversketch
