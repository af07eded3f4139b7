#pragma once

#include "core/image/image.h"
#include "core/image/raster.h"

#include <cstdint>

namespace oversketch {

/// One pixel as screens take it: encoded (sRGB) values in 8 bits, alpha straight.
struct Rgba8 {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t a = 255;

  bool operator==(const Rgba8&) const = default;
};

/// Rounded to the nearest level and clamped to 0…255; what is not a number becomes 0.
Rgba8 to_display(const Rgba& pixel);
/// @cost about 2 ns a pixel.
Raster<Rgba8> to_display(const Image& image);

} // namespace oversketch
