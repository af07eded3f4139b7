#pragma once

#include "core/base/bulk_allocator.h"
#include "core/base/check.h"
#include "core/base/rect.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oversketch {

/// Asks for pixels that hold anything, for who sets each of them before it is read.
struct Unset {};

/// width × height values, row by row, no padding: the mutable workshop form of pictures and masks.
template <class T>
class Raster {
public:
  Raster() = default;
  /// Sizes must not be negative (CHECK).
  Raster(int width, int height, T fill = T{})
      : width_(width), height_(height), values_(checked_count(width, height), fill) {}
  Raster(int width, int height, Unset) : width_(width), height_(height), values_(checked_count(width, height)) {}
  /// In the memory of one that is not needed any more, where that is enough and not more than twice what is: pages new
  /// from the system, which must clear them, cost as much as a quarter of what is drawn into them.
  Raster(int width, int height, Unset, Raster&& spare) : width_(width), height_(height) {
    const std::size_t count = checked_count(width, height), room = spare.values_.capacity();
    if (room >= count && room / 2 <= count) values_ = std::move(spare.values_);
    spare = Raster();
    values_.resize(count);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  Rect rect() const { return {0, 0, width_, height_}; }
  bool empty() const { return values_.empty(); }
  T& at(int x, int y) { return values_[index(x, y)]; }
  const T& at(int x, int y) const { return values_[index(x, y)]; }
  std::span<T> row(int y) { return std::span<T>(values_).subspan(index(0, y), static_cast<std::size_t>(width_)); }
  std::span<const T> row(int y) const {
    return std::span<const T>(values_).subspan(index(0, y), static_cast<std::size_t>(width_));
  }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  bool operator==(const Raster&) const = default;

private:
  static std::size_t checked_count(int width, int height) {
    CHECK(width >= 0 && height >= 0, "raster of negative size");
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T, BulkAllocator<T>> values_;
};

} // namespace oversketch
