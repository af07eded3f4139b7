#pragma once

#include "core/base/hash.h"
#include "core/image/raster.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace oversketch {

/// One pixel: encoded (sRGB) values where 1 is the 8-bit level 255, alpha straight (not premultiplied).  Values outside
/// 0…1 are allowed and kept until display or export.
struct Rgba {
  float r = 0;
  float g = 0;
  float b = 0;
  float a = 1;

  using PackedForHash = void;
  bool operator==(const Rgba&) const = default;
};

/// A picture as a value: pixels are shared and never change, so a copy costs a pointer.
///
/// @threads safe to read from several threads, content_hash() too.
class Image {
public:
  /// No pixels, 0 × 0.
  Image();
  explicit Image(Raster<Rgba> pixels);

  int width() const { return pixels_->width(); }
  int height() const { return pixels_->height(); }
  Rect rect() const { return pixels_->rect(); }
  bool empty() const { return pixels_->empty(); }
  const Rgba& at(int x, int y) const { return pixels_->at(x, y); }
  const Raster<Rgba>& pixels() const { return *pixels_; }
  /// The file that it was read from, byte for byte: decode_image() makes this picture of it again.  Empty where the
  /// pixels came from elsewhere.
  std::span<const std::byte> file() const {
    return file_ ? std::span<const std::byte>(*file_) : std::span<const std::byte>();
  }
  /// The same picture, read from that file.
  Image with_file(std::vector<std::byte> file) const;
  /// What it holds in memory, its file too.
  std::size_t bytes() const { return pixels_->values().size_bytes() + file().size(); }
  /// Of size and pixels; computed at the first call, about 6 GB/s.
  Hash content_hash() const;
  /// By content.
  bool operator==(const Image& other) const;

private:
  struct LazyHash;
  std::shared_ptr<const Raster<Rgba>> pixels_;
  std::shared_ptr<LazyHash> hash_;
  std::shared_ptr<const std::vector<std::byte>> file_;
};

} // namespace oversketch
