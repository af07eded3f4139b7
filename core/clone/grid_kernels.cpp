#include "core/clone/grid_kernels.h"

#include "core/clone/guidance.h"

namespace oversketch {
namespace {

// Bodies that are inlined into functions for several processors.
#define OVERSKETCH_INLINE [[gnu::always_inline]] inline

OVERSKETCH_INLINE void relax_body(float* __restrict u, const float* b, const GridNeighbours& at, std::size_t count,
                                  float inverse) {
  const float *w = at.west, *e = at.east, *n = at.north, *s = at.south;
  for (std::size_t i = 0; i < count; ++i)
    u[i] = (b[i] + ((w[i] + e[i]) + (n[i] + s[i]))) * inverse;
}

OVERSKETCH_INLINE void relax_zero_body(float* __restrict u, const float* b, std::size_t count, float inverse) {
  for (std::size_t i = 0; i < count; ++i)
    u[i] = b[i] * inverse;
}

OVERSKETCH_INLINE void residual_body(float* __restrict r, const float* b, const float* u, const GridNeighbours& at,
                                     std::size_t count, float extra) {
  const float *w = at.west, *e = at.east, *n = at.north, *s = at.south;
  for (std::size_t i = 0; i < count; ++i) {
    const float here = u[i];
    r[i] = (b[i] - extra * here) + (((w[i] - here) + (e[i] - here)) + ((n[i] - here) + (s[i] - here)));
  }
}

OVERSKETCH_INLINE void add_half_body(float* __restrict u, const GridNeighbours& at, std::size_t count) {
  const float *w = at.west, *e = at.east, *n = at.north, *s = at.south;
  for (std::size_t i = 0; i < count; ++i)
    u[i] += 0.5f * ((w[i] + e[i]) + (n[i] + s[i]));
}

OVERSKETCH_INLINE void surplus_body(float* __restrict red, float* __restrict green, float* __restrict blue,
                                    PixelPlanes p, PixelPlanes q, std::size_t count) {
  const float *p0 = p.first, *p1 = p0 + p.stride, *p2 = p1 + p.stride, *p3 = p2 + p.stride, *p4 = p3 + p.stride,
              *p5 = p4 + p.stride;
  const float *q0 = q.first, *q1 = q0 + q.stride, *q2 = q1 + q.stride, *q3 = q2 + q.stride, *q4 = q3 + q.stride,
              *q5 = q4 + q.stride;
  constexpr float kTieFloat = static_cast<float>(kTie);
  for (std::size_t i = 0; i < count; ++i) {
    const float s0 = p0[i] - q0[i], s1 = p1[i] - q1[i], s2 = p2[i] - q2[i];
    const float t0 = p3[i] - q3[i], t1 = p4[i] - q4[i], t2 = p5[i] - q5[i];
    const float s = (s0 * s0 + s1 * s1) + s2 * s2, t = (t0 * t0 + t1 * t1) + t2 * t2, more = t - s;
    // Which of two noises is stronger cannot be foretold: no branch.
    const float above = more * more - kTieFloat * (s + t);
    const float least = above < more ? above : more;
    const float keep = least > 0 ? 1.0f : 0.0f;
    red[i] = keep * (t0 - s0);
    green[i] = keep * (t1 - s1);
    blue[i] = keep * (t2 - s2);
  }
}

OVERSKETCH_INLINE void add_pairs_body(float* sum, std::size_t sum_stride, const float* along, std::size_t along_stride,
                                      const float* down, std::size_t down_stride, std::size_t count) {
  for (std::size_t k = 0; k < 3; ++k) {
    float* __restrict const to = sum + k * sum_stride;
    const float *const from = along + k * along_stride, *const more = down + k * down_stride;
    for (std::size_t i = 0; i < count; ++i)
      to[i] = (from[i + 1] - from[i]) + more[i];
  }
}

OVERSKETCH_INLINE bool are_finite_body(const float* values, std::size_t count) {
  // 0 · x is not 0 for infinite x and for not-a-number.
  int bad = 0;
  for (std::size_t i = 0; i < count; ++i)
    bad |= 0.0f * values[i] != 0 ? 1 : 0;
  return bad == 0;
}

#define OVERSKETCH_KERNELS(name, target)                                                                               \
  target void relax_##name(float* u, const float* b, const GridNeighbours& at, std::size_t count, float inverse) {     \
    relax_body(u, b, at, count, inverse);                                                                              \
  }                                                                                                                    \
  target void relax_zero_##name(float* u, const float* b, std::size_t count, float inverse) {                          \
    relax_zero_body(u, b, count, inverse);                                                                             \
  }                                                                                                                    \
  target void residual_##name(float* r, const float* b, const float* u, const GridNeighbours& at, std::size_t count,   \
                              float extra) {                                                                           \
    residual_body(r, b, u, at, count, extra);                                                                          \
  }                                                                                                                    \
  target void add_half_##name(float* u, const GridNeighbours& at, std::size_t count) {                                 \
    add_half_body(u, at, count);                                                                                       \
  }                                                                                                                    \
  target void surplus_##name(float* out, std::size_t stride, PixelPlanes p, PixelPlanes q, std::size_t count) {        \
    surplus_body(out, out + stride, out + 2 * stride, p, q, count);                                                    \
  }                                                                                                                    \
  target void add_pairs_##name(float* sum, std::size_t sum_stride, const float* along, std::size_t along_stride,       \
                               const float* down, std::size_t down_stride, std::size_t count) {                        \
    add_pairs_body(sum, sum_stride, along, along_stride, down, down_stride, count);                                    \
  }                                                                                                                    \
  target bool are_finite_##name(const float* values, std::size_t count) {                                              \
    return are_finite_body(values, count);                                                                             \
  }                                                                                                                    \
  constexpr GridKernels k_##name = {relax_##name,   relax_zero_##name, residual_##name,  add_half_##name,              \
                                    surplus_##name, add_pairs_##name,  are_finite_##name};

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
  if (__builtin_cpu_supports("avx2")) return k_avx2;
#endif
  return k_plain;
}

} // namespace oversketch
