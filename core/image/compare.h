#pragma once

#include "core/base/result.h"
#include "core/image/image.h"

#include <cstdint>

namespace oversketch {

/// How far two pictures are apart as a viewer would get them: in 8-bit levels, after rounding and clamping.
struct Difference {
  /// Largest |a − b| over all pixels and channels, levels.
  double max_levels = 0;
  /// Mean |a − b| over all pixels and the four channels, levels.
  double mean_levels = 0;
  /// Pixels that differ in any channel.
  std::int64_t differing = 0;
  /// The first pixel, row by row, where max_levels is reached; 0, 0 when nothing differs.
  int x = 0;
  int y = 0;
};

/// Compares r, g, b and a of every pixel; the colour of transparent pixels counts too.
/// @errors image.size-differs, with both sizes.
/// @cost about 10 ns a pixel.
Result<Difference> compare(const Image& a, const Image& b);

/// |a − b| · gain in r, g and b (exported levels; a difference of alpha is added to all three), opaque, values may
/// pass 1. Both pictures must have one size (CHECK: compare() first).
Image difference_image(const Image& a, const Image& b, double gain = 1.0);

} // namespace oversketch
