#pragma once

#include <cstddef>

namespace oversketch {

/// Channels that are solved at once, one after the other in memory: a slot.
inline constexpr int kGridChannels = 3;

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

/// The inner loops of MaskMultigrid and of mixed gradients: on `count` floats, whose neighbours are `count` floats
/// each.  Each float is computed by the same operations in the same order, whatever the processor: all sets give the
/// same bits.
struct GridKernels {
  /// u = (b + w + e + n + s) · inverse
  void (*relax)(float* u, const float* b, const GridNeighbours& at, std::size_t count, float inverse);
  /// The same with neighbours of 0.
  void (*relax_zero)(float* u, const float* b, std::size_t count, float inverse);
  /// r = b + (w + e + n + s) · inverse, the neighbours those of b: what is left where u = 0 when u = b · inverse beside
  /// it.
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
  /// sum_i = (along_{i + 1} − along_i) + down_i of three planes each, all `stride`s in floats.
  void (*add_pairs)(float* sum, std::size_t sum_stride, const float* along, std::size_t along_stride, const float* down,
                    std::size_t down_stride, std::size_t count);
  /// Whether all are finite numbers.
  bool (*are_finite)(const float* values, std::size_t count);

  /// The fastest for this processor.
  static GridKernels choose();
  /// The one that every processor has.
  static GridKernels plain();
};

} // namespace oversketch
