#pragma once

#include "core/geometry/point.h"
#include "core/image/image.h"

#include <array>
#include <cstddef>

namespace oversketch {

/// Which instructions the inner loops use.  The results are the same to the bit.
enum class Simd {
  /// AVX2 where the processor has it.
  kBest,
  /// Those that every processor of the kind has.
  kBaseline,
};

/// o + u a + v b + uv c.
struct BilinearForm {
  Point o, a, b, c;

  Point operator()(double u, double v) const {
    return {value(o.x, a.x, b.x, c.x, u, v), value(o.y, a.y, b.y, c.y, u, v)};
  }
  static double value(double o, double a, double b, double c, double u, double v) {
    return o + u * a + v * b + (u * v) * c;
  }
};

/// What the inverse of a bilinear cell needs along a row, where its three crossings are affine: at pixel i
///   s = √(B² + k V),  v = 2 V / (B + s),  u = 2 U / (area2 − B + s)  with B = b + i db, V = v + i dv, U = u + i du.
struct RowInverse {
  double b = 0, db = 0, v = 0, dv = 0, u = 0, du = 0;
  double area2 = 0, k = 0;
};

/// A row of a cell that is bent but gently, where the source is an affine function of the pixel plus a small rest.
///
/// With the crossings divided by D, e = (q × c) / D, V = (a × q) / D, U = (q × b) / D and κ = 4 (c × b) / D:
///   m = e (2 + e) + κ V,  σ = √(1 + m)  (s / D),
///   v − V = −V (e (1 + σ) + m) / ((1 + σ) (1 + e + σ)),   u − U = −U (m − e (1 + σ)) / ((1 + σ) (1 − e + σ)).
/// The affine part is double; the rest, in which nothing cancels, single precision: exact to 2⁻²⁰ of a cell's side.
struct GentleRow {
  /// The affine part: its first point and its step.
  Point first, step;
  float e = 0, de = 0, u = 0, du = 0, v = 0, dv = 0;
  float kappa = 0;
  /// The source's way along u and v.
  float ax = 0, ay = 0, bx = 0, by = 0;
};

/// A picture to sample: edge pixels are repeated outside, pixel centres are at (0.5, 0.5).
struct Texture {
  explicit Texture(const Raster<Rgba>& raster)
      : pixels(raster.values().data()), width(raster.width()), height(raster.height()) {}

  const Rgba* pixels;
  int width;
  int height;
};

/// The inner loops of the warp, on the pixels of one row.  Sampling rounds points to 2⁻²⁰ px of the texture, gives
/// exactly the pixel at a pixel's centre, and weighs colours by alpha; not-a-number reads as 0.
struct RowKernels {
  /// Pixels at once, and how many more values arrays of coordinates must have room for: the kernels work in blocks.
  static constexpr int kMost = 128;
  static constexpr int kBlock = 8;
  using Values = std::array<double, kMost + kBlock>;

  void (*map_gently)(const GentleRow& row, int count, double* x, double* y);
  void (*invert)(const RowInverse& row, int count, double* u, double* v);
  void (*evaluate)(const BilinearForm& form, int count, const double* u, const double* v, double* x, double* y);
  /// `ahead`: see MixInside.
  void (*bilinear)(const Texture& texture, int count, const double* x, const double* y, std::ptrdiff_t ahead,
                   Rgba* out);
  /// Catmull–Rom over 4 × 4 pixels.
  void (*bicubic)(const Texture& texture, int count, const double* x, const double* y, std::ptrdiff_t ahead, Rgba* out);
};

RowKernels row_kernels(Simd simd);

} // namespace oversketch
