#include "core/warp/row_kernels.h"

#include "core/base/processor.h"
#include "core/warp/tap_mixers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

// Each loop stands once, as plain code that the compiler turns into vector code, and is compiled twice: as it is, and
// inlined into a function for AVX2.
#if defined(__x86_64__)
#define OVERSKETCH_AVX2 [[gnu::target("avx2"), gnu::flatten]]
#endif

namespace oversketch {
namespace {

constexpr int kMost = RowKernels::kMost, kBlock = RowKernels::kBlock;

/// No loop is left for the rest then, which would cost more than the few values too many.
OVERSKETCH_INLINE int whole_blocks(int count) {
  return (count + kBlock - 1) / kBlock * kBlock;
}

OVERSKETCH_INLINE void invert_row(const RowInverse& row, int count, double* __restrict u, double* __restrict v) {
  for (int at = 0; at < count; at += kBlock)
    for (int i = at; i < at + kBlock; ++i) {
      const double b = row.b + i * row.db, vn = row.v + i * row.dv, un = row.u + i * row.du;
      const double s = std::sqrt(std::max(0.0, b * b + row.k * vn));
      const double v_part = b + s, u_part = row.area2 - b + s;
      const double both = 2 / (v_part * u_part);
      v[i] = vn * u_part * both;
      u[i] = un * v_part * both;
    }
}

OVERSKETCH_INLINE void map_row_gently(const GentleRow& from, int count, double* __restrict x, double* __restrict y) {
  const GentleRow row = from;
  std::array<float, kMost + kBlock> rest_x, rest_y;
  const int padded = whole_blocks(count);
  for (int i = 0; i < padded; ++i) {
    const float n = static_cast<float>(i);
    const float e = row.e + n * row.de, u = row.u + n * row.du, v = row.v + n * row.dv;
    const float m = e * (2 + e) + row.kappa * v;
    // Positive in a gentle cell; what the block has beyond it may be not-a-number.
    const float sigma = std::sqrt(1 + m), more = 1 + sigma;
    const float v_part = more + e, u_part = more - e;
    const float over = -1 / (more * (v_part * u_part));
    const float rest_u = u * ((m - e * more) * v_part) * over, rest_v = v * ((m + e * more) * u_part) * over;
    rest_x[static_cast<std::size_t>(i)] = rest_u * row.ax + rest_v * row.bx;
    rest_y[static_cast<std::size_t>(i)] = rest_u * row.ay + rest_v * row.by;
  }
  for (int i = 0; i < padded; ++i) {
    x[i] = row.first.x + i * row.step.x + static_cast<double>(rest_x[static_cast<std::size_t>(i)]);
    y[i] = row.first.y + i * row.step.y + static_cast<double>(rest_y[static_cast<std::size_t>(i)]);
  }
}

OVERSKETCH_INLINE void evaluate_row(const BilinearForm& form, int count, const double* __restrict u,
                                    const double* __restrict v, double* __restrict x, double* __restrict y) {
  const BilinearForm f = form;
  for (int at = 0; at < count; at += kBlock)
    for (int i = at; i < at + kBlock; ++i) {
      x[i] = BilinearForm::value(f.o.x, f.a.x, f.b.x, f.c.x, u[i], v[i]);
      y[i] = BilinearForm::value(f.o.y, f.a.y, f.b.y, f.c.y, u[i], v[i]);
    }
}

/// The last pixel centre at or before a point on one axis, −1 … high + 1, and how far the point is beyond it.
struct Located {
  int low;
  float part;
};

OVERSKETCH_INLINE Located locate(double coordinate, double limit) {
  // Adding and taking away 1.5 · 2³² leaves multiples of 2⁻²⁰: whole pixels that went through a mesh's rounding find
  // their own centre again.
  constexpr double kRound = 6442450944.0;
  const double c = std::min(std::max(-1.0, coordinate - 0.5), limit) + kRound - kRound;
  // Truncation is the floor here: c + 1 ≥ 0.
  const int low = static_cast<int>(c + 1) - 1;
  return {low, static_cast<float>(c - low)};
}

/// In two sweeps: places, which the compiler makes vector code of, then colours.
template <class Taps, class MixInside>
OVERSKETCH_INLINE void sample_row(const Texture& texture, int count, const double* x, const double* y,
                                  std::ptrdiff_t ahead, Rgba* out, MixInside mix_inside) {
  if (count <= 0) return;
  std::array<int, kMost> first;
  std::array<float, kMost> part_x, part_y;
  const int width = texture.width, high_x = texture.width - 1, high_y = texture.height - 1;
  int outside = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Located across = locate(x[i], high_x + 1.0), down = locate(y[i], high_y + 1.0);
    const int left = across.low - Taps::kBefore, top = down.low - Taps::kBefore;
    outside |= left | top | (high_x - Taps::kAfter - across.low) | (high_y - Taps::kAfter - down.low);
    first[i] = top * width + left;
    part_x[i] = across.part, part_y[i] = down.part;
  }
  // No number that was joined is negative.
  if (outside >= 0) {
    if (mix_inside(texture.pixels, width, count, first.data(), part_x.data(), part_y.data(), ahead, out)) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      out[i] = Taps::mix_inside(texture.pixels + first[i], width, part_x[i], part_y[i]);
    return;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Located across = locate(x[i], high_x + 1.0), down = locate(y[i], high_y + 1.0);
    out[i] = Taps::mix(texture, across.low, down.low, across.part, down.part);
  }
}

void map_gently_baseline(const GentleRow& row, int count, double* x, double* y) {
  map_row_gently(row, count, x, y);
}
void invert_baseline(const RowInverse& row, int count, double* u, double* v) {
  invert_row(row, count, u, v);
}
void evaluate_baseline(const BilinearForm& form, int count, const double* u, const double* v, double* x, double* y) {
  evaluate_row(form, count, u, v, x, y);
}
void bilinear_baseline(const Texture& texture, int count, const double* x, const double* y, std::ptrdiff_t ahead,
                       Rgba* out) {
  sample_row<BilinearTaps>(texture, count, x, y, ahead, out, mix_bilinear_baseline);
}
void bicubic_baseline(const Texture& texture, int count, const double* x, const double* y, std::ptrdiff_t ahead,
                      Rgba* out) {
  sample_row<BicubicTaps>(texture, count, x, y, ahead, out, mix_bicubic_baseline);
}

#ifdef OVERSKETCH_AVX2
OVERSKETCH_AVX2 void map_gently_avx2(const GentleRow& row, int count, double* x, double* y) {
  map_row_gently(row, count, x, y);
}
OVERSKETCH_AVX2 void invert_avx2(const RowInverse& row, int count, double* u, double* v) {
  invert_row(row, count, u, v);
}
OVERSKETCH_AVX2 void evaluate_avx2(const BilinearForm& form, int count, const double* u, const double* v, double* x,
                                   double* y) {
  evaluate_row(form, count, u, v, x, y);
}
OVERSKETCH_AVX2 void bilinear_avx2(const Texture& texture, int count, const double* x, const double* y,
                                   std::ptrdiff_t ahead, Rgba* out) {
  sample_row<BilinearTaps>(texture, count, x, y, ahead, out, mix_bilinear_avx2);
}
OVERSKETCH_AVX2 void bicubic_avx2(const Texture& texture, int count, const double* x, const double* y,
                                  std::ptrdiff_t ahead, Rgba* out) {
  sample_row<BicubicTaps>(texture, count, x, y, ahead, out, mix_bicubic_avx2);
}
#endif

} // namespace

RowKernels row_kernels(Simd simd) {
#ifdef OVERSKETCH_AVX2
  if (simd == Simd::kBest && has_avx2())
    return {map_gently_avx2, invert_avx2, evaluate_avx2, bilinear_avx2, bicubic_avx2};
#endif
  (void)simd;
  return {map_gently_baseline, invert_baseline, evaluate_baseline, bilinear_baseline, bicubic_baseline};
}

} // namespace oversketch
