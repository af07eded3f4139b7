#pragma once

// How the pixels round a point become one colour; see row_kernels.h.

#include "core/warp/row_kernels.h"

namespace oversketch {

/// Mixes `count` points whose taps all lie in the picture: `first` is the index of the upper left tap, tx and ty are
/// how far the points lie beyond the pixel centre before them, 0 ≤ t < 1.  What lies `ahead` pixels after the taps is
/// asked for early: rows of points seldom follow the picture's rows, so that the processor does not foresee them.
/// @returns false when not all taps are opaque; what is in `out` is then worth nothing.
using MixInside = bool(const Rgba* pixels, int width, int count, const int* first, const float* tx, const float* ty,
                       std::ptrdiff_t ahead, Rgba* out);

extern MixInside mix_bilinear_baseline, mix_bicubic_baseline;
#if defined(__x86_64__)
extern MixInside mix_bilinear_avx2, mix_bicubic_avx2;
#endif

/// 2 × 2 taps from the pixel before the point.
///   vertically, then horizontally: a + t (b − a).  A weight of 0 leaves the bits alone.
/// With alpha: Σ w a c / Σ w a, and Σ w a as alpha; transparent black where that is 0.
struct BilinearTaps {
  static constexpr int kBefore = 0, kAfter = 1;
  /// One point, anywhere; the same bits as MixInside gives.
  static Rgba mix(const Texture& texture, int x, int y, float tx, float ty);
  /// The same where all taps lie in the picture; `first` is the upper left one.
  static Rgba mix_inside(const Rgba* first, int width, float tx, float ty);
};

/// 4 × 4 taps, Catmull–Rom: the cubic through the middle two with slopes (p₂ − p₀) / 2 and (p₃ − p₁) / 2.
///
/// It overshoots by up to 9/32 of the taps' range, beside steep edges; colours are left so (they are clamped at export
/// alone), alpha is not.  With alpha: as bilinear, alpha within 0 and the largest of the taps, and colours within the
/// range of the taps that are visible, widened by 9/32 of it: what an opaque picture can reach anyway.
struct BicubicTaps {
  static constexpr int kBefore = 1, kAfter = 2;
  static Rgba mix(const Texture& texture, int x, int y, float tx, float ty);
  static Rgba mix_inside(const Rgba* first, int width, float tx, float ty);
};

} // namespace oversketch
