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
/// The part of a picture that lies in the rectangle, which must lie in the picture (CHECK).
Raster<Rgba8> to_display(const Raster<Rgba>& pixels, const Rect& part);
/// Exactly the values of a picture read from 8 bits.
inline Rgba from_display(const Rgba8& pixel) {
  const auto value = [](std::uint8_t level) { return static_cast<float>(level) / 255.0f; };
  return {value(pixel.r), value(pixel.g), value(pixel.b), value(pixel.a)};
}

} // namespace oversketch
