#pragma once

#include <algorithm>
#include <cstdlib>

namespace oversketch::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kIsSanitized = false;
#endif

/// How often a random test tries: `times`; with the sanitizers, which slow it down tenfold, a quarter as often.  The
/// environment variable `setting` says otherwise, for a long night.
inline int tries(int times, const char* setting) {
  if (const char* given = std::getenv(setting)) return std::max(1, std::atoi(given));
  return kIsSanitized ? std::max(1, times / 4) : times;
}

} // namespace oversketch::testing
