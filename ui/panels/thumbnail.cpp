#include "ui/panels/thumbnail.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

constexpr int kSamples = 4;

/// The mean of a grid of samples over the rectangle that one small pixel covers; colours weighted by their alpha.
Rgba8 mean_of(const Raster<Rgba8>& picture, double x0, double y0, double step) {
  int r = 0, g = 0, b = 0, a = 0;
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const int x = std::min(static_cast<int>(x0 + (i + 0.5) * step / kSamples), picture.width() - 1);
      const int y = std::min(static_cast<int>(y0 + (j + 0.5) * step / kSamples), picture.height() - 1);
      const Rgba8& pixel = picture.at(x, y);
      r += pixel.r * pixel.a;
      g += pixel.g * pixel.a;
      b += pixel.b * pixel.a;
      a += pixel.a;
    }
  }
  if (a == 0) return {0, 0, 0, 0};
  const auto level = [&](int sum) { return static_cast<std::uint8_t>((sum + a / 2) / a); };
  return {level(r), level(g), level(b),
          static_cast<std::uint8_t>((a + kSamples * kSamples / 2) / (kSamples * kSamples))};
}

} // namespace

std::shared_ptr<const Raster<Rgba8>> make_thumbnail(const Raster<Rgba8>& picture, int most_px) {
  if (picture.empty()) return nullptr;
  const int longer = std::max(picture.width(), picture.height());
  const double step = std::max(1.0, static_cast<double>(longer) / most_px);
  const auto size_of = [&](int side) { return std::max(1, static_cast<int>(std::lround(side / step))); };
  Raster<Rgba8> small(size_of(picture.width()), size_of(picture.height()));
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      small.at(x, y) = mean_of(picture, x * step, y * step, step);
  return std::make_shared<const Raster<Rgba8>>(std::move(small));
}

} // namespace oversketch
