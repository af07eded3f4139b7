#pragma once

/// Of bodies that are inlined into functions for several processors.
#define OVERSKETCH_INLINE [[gnu::always_inline]] inline

namespace oversketch {

/// Whether functions for AVX2 may be called.
inline bool has_avx2() {
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

} // namespace oversketch
