#pragma once

#include "core/geometry/mask.h"
#include "core/image/image.h"
#include "core/mesh/quad_mesh.h"

#include <cmath>
#include <cstdint>
#include <random>

namespace oversketch {

/// columns × rows cells of side `cell`, the first corner at `origin`.
inline QuadMesh grid_mesh(Point origin, double cell, int columns, int rows) {
  QuadMesh mesh;
  mesh.cell = cell;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x)
      mesh.vertices.push_back(origin + Point{x * cell, y * cell});
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int first = y * (columns + 1) + x;
      mesh.cells.push_back({first, first + 1, first + columns + 2, first + columns + 1});
    }
  mesh.coverage.assign(mesh.cells.size(), 1.0);
  return mesh;
}

inline Mask rect_mask(const Rect& r) {
  std::vector<Mask::Run> runs;
  for (int y = r.y; y < r.bottom(); ++y)
    runs.push_back({y, r.x, r.right()});
  return Mask(std::move(runs));
}

/// Noise in every channel; alpha from `alpha_low` to 1.
inline Image noise_image(int width, int height, unsigned seed, float alpha_low = 1.0F) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0.0F, 1.0F);
  Raster<Rgba> pixels(width, height);
  for (Rgba& p : pixels.values()) {
    p = {value(random), value(random), value(random), 1.0F};
    if (alpha_low < 1) p.a = alpha_low + (1 - alpha_low) * value(random);
  }
  return Image(std::move(pixels));
}

/// r = x, g = y of the pixel's centre: bilinear sampling gives back the point that was sampled.
inline Image coordinate_image(int width, int height) {
  Raster<Rgba> pixels(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      pixels.at(x, y) = {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, 0, 1};
  return Image(std::move(pixels));
}

} // namespace oversketch
