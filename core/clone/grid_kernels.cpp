#include "core/clone/grid_kernels.h"

#include "core/base/processor.h"
#include "core/clone/guidance.h"
#include "core/clone/pixel_planes.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace oversketch {
namespace {

OVERSKETCH_INLINE void relax_body(float* __restrict u, const float* b, const GridNeighbours& at, std::size_t count,
                                  float inverse) {
  const float *w = at.west, *e = at.east, *n = at.north, *s = at.south;
  for (std::size_t i = 0; i < count; ++i)
    u[i] = (b[i] + ((w[i] + e[i]) + (n[i] + s[i]))) * inverse;
}

OVERSKETCH_INLINE void overrelax_body(float* __restrict u, const float* b, const GridNeighbours& at, std::size_t count,
                                      float step, float keep) {
  const float *w = at.west, *e = at.east, *n = at.north, *s = at.south;
  for (std::size_t i = 0; i < count; ++i)
    u[i] = (b[i] + ((w[i] + e[i]) + (n[i] + s[i]))) * step + keep * u[i];
}

OVERSKETCH_INLINE void relax_zero_body(float* __restrict u, const float* b, std::size_t count, float inverse) {
  for (std::size_t i = 0; i < count; ++i)
    u[i] = b[i] * inverse;
}

OVERSKETCH_INLINE void eliminate_body(float* __restrict r, const float* b, const GridNeighbours& at, std::size_t count,
                                      float inverse) {
  const float *w = at.west, *e = at.east, *n = at.north, *s = at.south;
  for (std::size_t i = 0; i < count; ++i)
    r[i] = b[i] + ((w[i] + e[i]) + (n[i] + s[i])) * inverse;
}

OVERSKETCH_INLINE void residual_body(float* __restrict r, const float* b, const float* u, const GridNeighbours& at,
                                     std::size_t count, float extra) {
  const float *w = at.west, *e = at.east, *n = at.north, *s = at.south;
  for (std::size_t i = 0; i < count; ++i) {
    const float here = u[i];
    r[i] = (b[i] - extra * here) + (((w[i] - here) + (e[i] - here)) + ((n[i] - here) + (s[i] - here)));
  }
}

OVERSKETCH_INLINE void add_half_body(float* __restrict u, const float* p, const float* q, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    u[i] += 0.5f * (p[i] + q[i]);
}

OVERSKETCH_INLINE void start_half_body(float* __restrict u, const float* b, const float* p, const float* q,
                                       std::size_t count, float inverse) {
  for (std::size_t i = 0; i < count; ++i)
    u[i] = b[i] * inverse + 0.5f * (p[i] + q[i]);
}

OVERSKETCH_INLINE void weigh_body(float* __restrict out, const float* middle, const float* above, const float* below,
                                  std::size_t count) {
  const float *next_above = above + kGridChannels, *next_below = below + kGridChannels;
  for (std::size_t i = 0; i < count; ++i)
    out[i] = middle[i] + 0.25f * ((above[i] + below[i]) + (next_above[i] + next_below[i]));
}

OVERSKETCH_INLINE float largest_body(const float* values, std::size_t count) {
  using Lanes = float __attribute__((vector_size(32)));
  constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(float);
  Lanes largest = {};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    Lanes size;
    std::memcpy(&size, values + i, sizeof size);
    size = size < 0 ? -size : size;
    largest = largest < size ? size : largest;
  }
  float out = 0;
  const auto raise = [&out](float size) { out = out < size ? size : out; };
  for (std::size_t k = 0; k < kLanes; ++k)
    raise(largest[k]);
  for (; i < count; ++i)
    raise(values[i] < 0 ? -values[i] : values[i]);
  return out;
}

/// Judges again, in double, the pairs so near kTie that float is too coarse to tell.
void judge_exactly(const std::array<float*, 3>& out, PixelPlanes p, PixelPlanes q, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    double difference[6], norms[2] = {};
    for (std::size_t k = 0; k < 6; ++k) {
      difference[k] = static_cast<double>(p.first[k * p.stride + i]) - q.first[k * q.stride + i];
      norms[k / 3] += difference[k] * difference[k];
    }
    const double more = norms[1] - norms[0], square = more * more, tie = kTie * (norms[0] + norms[1]);
    if (square < 0.25 * tie || square > 4 * tie) continue;
    const bool keeps = more > 0 && square > tie;
    for (std::size_t k = 0; k < 3; ++k)
      out[k][i] = keeps ? static_cast<float>(difference[3 + k] - difference[k]) : 0.0f;
  }
}

/// @returns whether float cannot tell of some of the pairs.
OVERSKETCH_INLINE bool surplus_block(float* __restrict red, float* __restrict green, float* __restrict blue,
                                     PixelPlanes p, PixelPlanes q, std::size_t count) {
  const float *p0 = p.first, *p1 = p0 + p.stride, *p2 = p1 + p.stride, *p3 = p2 + p.stride, *p4 = p3 + p.stride,
              *p5 = p4 + p.stride;
  const float *q0 = q.first, *q1 = q0 + q.stride, *q2 = q1 + q.stride, *q3 = q2 + q.stride, *q4 = q3 + q.stride,
              *q5 = q4 + q.stride;
  constexpr float kTieFloat = static_cast<float>(kTie);
  int doubtful = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float s0 = p0[i] - q0[i], s1 = p1[i] - q1[i], s2 = p2[i] - q2[i];
    const float t0 = p3[i] - q3[i], t1 = p4[i] - q4[i], t2 = p5[i] - q5[i];
    const float s = (s0 * s0 + s1 * s1) + s2 * s2, t = (t0 * t0 + t1 * t1) + t2 * t2, more = t - s;
    // Which of two noises is stronger cannot be foretold: no branch.
    const float square = more * more, tie = kTieFloat * (s + t), above = square - tie;
    const float least = above < more ? above : more;
    const float keep = least > 0 ? 1.0f : 0.0f;
    doubtful |= (square > 0.5f * tie ? 1 : 0) & (square < 2 * tie ? 1 : 0);
    red[i] = keep * (t0 - s0);
    green[i] = keep * (t1 - s1);
    blue[i] = keep * (t2 - s2);
  }
  return doubtful != 0;
}

OVERSKETCH_INLINE void surplus_body(float* out, std::size_t stride, PixelPlanes p, PixelPlanes q, std::size_t count) {
  // Doubtful pairs are rare, a row without one is rarer.
  constexpr std::size_t kBlock = 64;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    float *const red = out + begin, *const green = red + stride, *const blue = green + stride;
    const PixelPlanes from{p.first + begin, p.stride}, to{q.first + begin, q.stride};
    if (surplus_block(red, green, blue, from, to, size)) judge_exactly({red, green, blue}, from, to, size);
  }
}

OVERSKETCH_INLINE bool sum_pairs_body(GridSlots<float> sums, PixelPlanes row, PairPlanes above, PairPlanes below,
                                      std::size_t count) {
  // What is computed on the way stays in the nearest cache.
  constexpr std::size_t kBlock = 256, kStride = kBlock + 8;
  std::array<float, 3 * kStride> along, block;
  int bad = 0;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    const PixelPlanes here{row.first + begin, row.stride};
    surplus_body(along.data(), kStride, {here.first - 1, row.stride}, here, size + 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const float *const left = along.data() + k * kStride, *const right = left + 1;
      const float *const up = above.first + k * above.stride + begin, *const down =
                                                                          below.first + k * below.stride + begin;
      float* __restrict const sum = block.data() + k * kStride;
      for (std::size_t i = 0; i < size; ++i) {
        sum[i] = (right[i] - left[i]) + (down[i] - up[i]);
        // 0 · x is not 0 for infinite x and for not-a-numbers.
        bad |= 0.0f * sum[i] != 0 ? 1 : 0;
      }
    }
    to_slots(block.data(), kStride, size, sums.from(begin));
  }
  return bad == 0;
}

#define OVERSKETCH_KERNELS(name, target)                                                                               \
  target void relax_##name(float* u, const float* b, const GridNeighbours& at, std::size_t count, float inverse) {     \
    relax_body(u, b, at, count, inverse);                                                                              \
  }                                                                                                                    \
  target void overrelax_##name(float* u, const float* b, const GridNeighbours& at, std::size_t count, float step,      \
                               float keep) {                                                                           \
    overrelax_body(u, b, at, count, step, keep);                                                                       \
  }                                                                                                                    \
  target void relax_zero_##name(float* u, const float* b, std::size_t count, float inverse) {                          \
    relax_zero_body(u, b, count, inverse);                                                                             \
  }                                                                                                                    \
  target void eliminate_##name(float* r, const float* b, const GridNeighbours& at, std::size_t count, float inverse) { \
    eliminate_body(r, b, at, count, inverse);                                                                          \
  }                                                                                                                    \
  target void residual_##name(float* r, const float* b, const float* u, const GridNeighbours& at, std::size_t count,   \
                              float extra) {                                                                           \
    residual_body(r, b, u, at, count, extra);                                                                          \
  }                                                                                                                    \
  target void add_half_##name(float* u, const float* p, const float* q, std::size_t count) {                           \
    add_half_body(u, p, q, count);                                                                                     \
  }                                                                                                                    \
  target void start_half_##name(float* u, const float* b, const float* p, const float* q, std::size_t count,           \
                                float inverse) {                                                                       \
    start_half_body(u, b, p, q, count, inverse);                                                                       \
  }                                                                                                                    \
  target void weigh_##name(float* out, const float* middle, const float* above, const float* below,                    \
                           std::size_t count) {                                                                        \
    weigh_body(out, middle, above, below, count);                                                                      \
  }                                                                                                                    \
  target float largest_##name(const float* values, std::size_t count) {                                                \
    return largest_body(values, count);                                                                                \
  }                                                                                                                    \
  target void surplus_##name(float* out, std::size_t stride, PixelPlanes p, PixelPlanes q, std::size_t count) {        \
    surplus_body(out, stride, p, q, count);                                                                            \
  }                                                                                                                    \
  target bool sum_pairs_##name(GridSlots<float> sums, PixelPlanes row, PairPlanes above, PairPlanes below,             \
                               std::size_t count) {                                                                    \
    return sum_pairs_body(sums, row, above, below, count);                                                             \
  }                                                                                                                    \
  constexpr GridKernels k_##name = {relax_##name,    overrelax_##name, relax_zero_##name, eliminate_##name,            \
                                    residual_##name, add_half_##name,  start_half_##name, weigh_##name,                \
                                    largest_##name,  surplus_##name,   sum_pairs_##name};

OVERSKETCH_KERNELS(plain, )
#if defined(__x86_64__) && defined(__GNUC__)
OVERSKETCH_KERNELS(avx2, [[gnu::target("avx2")]])
#endif

} // namespace

GridKernels GridKernels::plain() {
  return k_plain;
}

GridKernels GridKernels::choose() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (has_avx2()) return k_avx2;
#endif
  return k_plain;
}

} // namespace oversketch
