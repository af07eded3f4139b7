#pragma once

#include "core/base/rect.h"
#include "core/image/display.h"

#include <vector>

namespace oversketch {

/// A picture and its smaller versions, each of half the sides: a pixel is the mean of the four below it, colours
/// weighted with their alpha.
///
/// The sides are rounded up to multiples of 64, so that kCount levels halve exactly, and the last row and column are
/// repeated in what that adds.
class MipLevels {
public:
  static constexpr int kCount = 7;

  MipLevels() = default;
  MipLevels(int width, int height);

  bool empty() const { return levels_.empty(); }
  /// k = 0…kCount − 1; level 0 is the picture, with what was added at its right and bottom.
  const Raster<Rgba8>& level(int k) const { return levels_[static_cast<std::size_t>(k)]; }

  /// Puts `pixels` (row by row, `stride` pixels from row to row) into the picture and brings what depends on them up to
  /// date.
  /// @param rect  within the picture as it was asked for.
  /// @returns the part of level 0 that has changed: the rectangle, and what is repeated of it.
  /// @cost about 2 ns a pixel.
  Rect put(const Rect& rect, const Rgba8* pixels, int stride);

private:
  int width_ = 0;
  int height_ = 0;
  std::vector<Raster<Rgba8>> levels_;
};

/// The part of level k that depends on `rect` of level 0.
Rect shrunk(const Rect& rect, int k);

} // namespace oversketch
