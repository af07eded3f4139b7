#pragma once

#include <cstddef>

namespace oversketch {

/// Channels that are solved at once, one after the other in memory: a slot.
inline constexpr int kGridChannels = 3;

/// Where the slots of a run's pixels are: from `even` the 1st, 3rd…, from `odd` the 2nd, 4th… (see GridLevel).
template <class Value>
struct GridSlots {
  Value* even = nullptr;
  Value* odd = nullptr;

  Value* at(std::size_t pixel) const { return (pixel % 2 == 0 ? even : odd) + kGridChannels * (pixel / 2); }
  /// From that pixel on.
  GridSlots from(std::size_t pixel) const { return {at(pixel), at(pixel + 1)}; }
};

/// The left, right, upper and lower neighbours of values that lie one after the other.
struct GridNeighbours {
  const float* west;
  const float* east;
  const float* north;
  const float* south;
};

/// Pixels one after the other in planes: the source's red, green, blue, then the target's, `stride` floats apart.
struct PixelPlanes {
  const float* first;
  std::size_t stride;
};

/// Three channels of what belongs to pairs of pixels, in planes.
struct PairPlanes {
  const float* first;
  std::size_t stride;
};

/// The inner loops of MaskMultigrid and of mixed gradients: on `count` floats, whose neighbours are `count` floats
/// each.  Each float is computed by the same operations in the same order, whatever the processor: all sets give the
/// same bits.
struct GridKernels {
  /// u = (b + w + e + n + s) · inverse
  void (*relax)(float* u, const float* b, const GridNeighbours& at, std::size_t count, float inverse);
  /// u = (b + w + e + n + s) · step + keep · u
  void (*overrelax)(float* u, const float* b, const GridNeighbours& at, std::size_t count, float step, float keep);
  /// As relax with neighbours of 0.
  void (*relax_zero)(float* u, const float* b, std::size_t count, float inverse);
  /// r = b + (w + e + n + s) · inverse: what is left where u = 0 when u is the neighbours · inverse beside it.
  void (*eliminate)(float* r, const float* b, const GridNeighbours& at, std::size_t count, float inverse);
  /// r = b + (w − u) + (e − u) + (n − u) + (s − u) − extra u: accurate where u is smooth.
  void (*residual)(float* r, const float* b, const float* u, const GridNeighbours& at, std::size_t count, float extra);
  /// u += (p + q) / 2
  void (*add_half)(float* u, const float* p, const float* q, std::size_t count);
  /// u = b · inverse + (p + q) / 2
  void (*start_half)(float* u, const float* b, const float* p, const float* q, std::size_t count, float inverse);
  /// out_i = middle_i + (above_i + below_i + above_{i + 1} + below_{i + 1}) / 4, i + 1 the next slot.
  void (*weigh)(float* out, const float* middle, const float* above, const float* below, std::size_t count);
  /// The largest |value|, at least 0; not-a-number is passed over.
  float (*largest)(const float* values, std::size_t count);
  /// For `count` pairs of pixels p, q: (f*_p − f*_q) − (g_p − g_q) where the target is stronger (guidance.h), else 0;
  /// judged in double where float cannot tell.
  /// Three planes, `stride` floats apart.
  void (*surplus)(float* out, std::size_t stride, PixelPlanes p, PixelPlanes q, std::size_t count);
  /// Sums up the surplus of a run's pixels: of the pairs along `row`, each pixel with the next, from the one before the
  /// first to the one after the last, and of those with the pixels above and below, which are given.
  /// @returns whether all are finite numbers.
  bool (*sum_pairs)(GridSlots<float> sums, PixelPlanes row, PairPlanes above, PairPlanes below, std::size_t count);

  /// The fastest for this processor.
  static GridKernels choose();
  /// The one that every processor has.
  static GridKernels plain();
};

} // namespace oversketch
