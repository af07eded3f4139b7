#include "core/image/display.h"

#include "core/base/check.h"

#include <algorithm>

namespace oversketch {

namespace {

std::uint8_t to_level(float value) {
  // A comparison with what is not a number is false: max() then gives 0.
  const float level = std::min(std::max(0.0f, 255.0f * value), 255.0f);
  return static_cast<std::uint8_t>(level + 0.5f);
}

} // namespace

Rgba8 to_display(const Rgba& pixel) {
  return {to_level(pixel.r), to_level(pixel.g), to_level(pixel.b), to_level(pixel.a)};
}

Raster<Rgba8> to_display(const Image& image) {
  Raster<Rgba8> out(image.width(), image.height());
  std::transform(image.pixels().values().begin(), image.pixels().values().end(), out.values().begin(),
                 [](const Rgba& pixel) { return to_display(pixel); });
  return out;
}

Raster<Rgba8> to_display(const Raster<Rgba>& pixels, const Rect& part) {
  CHECK(intersect(part, pixels.rect()) == part || part.empty(), "the part lies in the picture");
  Raster<Rgba8> out(part.width, part.height);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x)
      out.at(x, y) = to_display(pixels.at(part.x + x, part.y + y));
  return out;
}

} // namespace oversketch
