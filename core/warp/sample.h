#pragma once

#include "core/image/image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace oversketch {

/// Bilinear sampling of a picture at points; edge pixels are repeated outside, colours weighed by alpha.
class BilinearSampler {
public:
  static constexpr int kMostAtOnce = 64;

  /// `source` must have pixels and outlive the sampler.
  explicit BilinearSampler(const Raster<Rgba>& source)
      : pixels_(source.values().data()),
        width_(source.width()),
        high_x_(source.width() - 1),
        high_y_(source.height() - 1) {}

  /// The colour at (x, y) rounded to 2⁻²⁰ px; exactly the pixel's at its centre.  Not-a-number reads as the first
  /// pixel.
  Rgba operator()(double x, double y) const {
    Rgba out;
    sample_row(1, &x, &y, &out);
    return out;
  }

  /// The same for `count` ≤ kMostAtOnce points.
  void sample_row(int count, const double* x, const double* y, Rgba* out) const {
    // In three sweeps: coordinates (which the compiler turns into SIMD), addresses (whose fetches then overlap, where a
    // row of the target crosses many of the source), colours.
    Axis across, down;
    locate(count, x, high_x_, across);
    locate(count, y, high_y_, down);
    std::array<const Rgba*, kMostAtOnce> top;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      top[i] = pixels_ + down.low[i] * width_ + across.low[i];
      __builtin_prefetch(top[i] + down.step[i] * width_);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      out[i] = mix(top[i], across.step[i], down.step[i] * width_, across.part[i], down.part[i]);
  }

private:
  /// r, g, b, a in one register.
  using Lanes = float __attribute__((vector_size(16)));
  static_assert(sizeof(Rgba) == sizeof(Lanes));

  /// Pixel coordinate (0 = first centre), no further than one pixel outside.
  static double snapped(double x, int high) {
    // Adding and taking away 1.5 · 2³² leaves multiples of 2⁻²⁰: whole pixels that went through a mesh's rounding find
    // their own centre again.
    constexpr double kRound = 6442450944.0;
    return std::min(std::max(-1.0, x - 0.5), high + 1.0) + kRound - kRound;
  }

  static Lanes load(const Rgba* pixel) { return std::bit_cast<Lanes>(*pixel); }

  /// For each point the pixel below it on one axis, the step to the next one (0 at the edge) and how far it is between
  /// them. Left unset: filled and read in the same call.
  struct Axis {
    std::array<int, kMostAtOnce> low, step;
    std::array<float, kMostAtOnce> part;
  };

  static void locate(int count, const double* coordinates, int high, Axis& out) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const double c = snapped(coordinates[i], high);
      // Truncation is the floor here: c + 1 ≥ 0.
      const int floor = static_cast<int>(c + 1) - 1;
      out.low[i] = std::min(std::max(floor, 0), high);
      out.step[i] = std::min(floor + 1, high) - out.low[i];
      out.part[i] = static_cast<float>(c - floor);
    }
  }

  static Rgba mix(const Rgba* p, std::ptrdiff_t right, std::ptrdiff_t down, float tx, float ty) {
    const Rgba *q = p + right, *r = p + down, *s = r + right;
    const bool opaque = (p->a == 1) & (q->a == 1) & (r->a == 1) & (s->a == 1);
    if (!opaque) [[unlikely]]
      return mix_by_alpha(*p, *q, *r, *s, tx, ty);
    // A weight of 0 leaves the bits alone, so that a pixel's own centre gives the pixel.
    const Lanes a = load(p), b = load(q), c = load(r), d = load(s);
    const Lanes upper = a + tx * (b - a), lower = c + tx * (d - c);
    const Lanes mixed = upper + ty * (lower - upper);
    return std::bit_cast<Rgba>(mixed);
  }

  static Rgba mix_by_alpha(const Rgba& p, const Rgba& q, const Rgba& r, const Rgba& s, float tx, float ty) {
    if (tx == 0 && ty == 0) return p;
    const float wp = (1 - tx) * (1 - ty) * p.a, wq = tx * (1 - ty) * q.a, wr = (1 - tx) * ty * r.a, ws = tx * ty * s.a;
    const float alpha = wp + wq + wr + ws;
    if (!(alpha > 0)) return {0, 0, 0, 0};
    const auto blend = [=](float a, float b, float c, float d) { return (wp * a + wq * b + wr * c + ws * d) / alpha; };
    return {blend(p.r, q.r, r.r, s.r), blend(p.g, q.g, r.g, s.g), blend(p.b, q.b, r.b, s.b), alpha};
  }

  const Rgba* pixels_;
  std::ptrdiff_t width_;
  int high_x_;
  int high_y_;
};

} // namespace oversketch
