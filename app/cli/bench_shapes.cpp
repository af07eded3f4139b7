#include "app/cli/bench_shapes.h"

#include "app/cli/bench_cases.h"

#include "core/geometry/curve.h"

#include <cmath>
#include <numbers>

namespace oversketch::cli {

Raster<Rgba> make_picture(int width, int height, std::uint32_t seed) {
  BenchRandom random(seed);
  const double tilt = random.between(0.2, 0.5), wave = random.between(0.02, 0.05);
  Raster<Rgba> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double base = 0.5 + 0.15 * std::sin(wave * x + tilt) * std::cos(wave * tilt * y) + tilt * x / width - 0.25;
      const auto level = [&](double by) { return static_cast<float>(by * base + random.between(-0.02, 0.02)); };
      picture.at(x, y) = {level(1.0), level(0.9), level(0.8), 1};
    }
  return picture;
}

Mask make_blob(double pixels) {
  Points points;
  for (int i = 0; i < 400; ++i) {
    const double a = 2 * std::numbers::pi * i / 400;
    const double r = 1 + 0.18 * std::cos(2 * a + 1) + 0.14 * std::sin(3 * a) + 0.08 * std::cos(5 * a);
    points.push_back({r * std::cos(a), r * std::sin(a)});
  }
  const double scale = std::sqrt(pixels / signed_area(points));
  const Point low = bounds(points).low;
  for (Point& p : points)
    p = scale * (p - low) + Point{8, 8};
  const Point high = bounds(points).high;
  return rasterize_polygon(points, {0, 0, static_cast<int>(high.x) + 8, static_cast<int>(high.y) + 8});
}

Mask make_snake(double pixels) {
  // As high as 16 widths; what the winding adds to the length it takes from the width across.
  const double width = std::sqrt(pixels / 16), height = 16 * width, swing = 2 * width;
  std::vector<Mask::Run> runs;
  for (int y = 0; y < static_cast<int>(height); ++y) {
    const double middle = 8 + swing + width / 2 + swing * std::sin(4 * std::numbers::pi * y / height);
    runs.push_back({y + 8, static_cast<int>(middle - width / 2), static_cast<int>(middle + width / 2)});
  }
  return Mask(std::move(runs));
}

Mask make_holed(double pixels) {
  const Mask blob = make_blob(1.08 * pixels);
  const int every = static_cast<int>(std::sqrt(pixels) / 5.5), radius = static_cast<int>(0.16 * every);
  const auto is_hole = [&](int x, int y) {
    const int u = x % every - every / 2, v = y % every - every / 2;
    return u * u + v * v <= radius * radius;
  };
  std::vector<Mask::Run> runs;
  for (const Mask::Run& run : blob.runs())
    for (int x = run.x0; x < run.x1; ++x)
      if (!is_hole(x, run.y)) runs.push_back({run.y, x, x + 1});
  return Mask(std::move(runs));
}

} // namespace oversketch::cli
