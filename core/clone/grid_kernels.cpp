#include "core/clone/grid_kernels.h"

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
  constexpr GridKernels k_##name = {relax_##name, relax_zero_##name, residual_##name, add_half_##name};

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
