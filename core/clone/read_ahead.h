#pragma once

#include <cstdint>

namespace oversketch {

/// What a stretch goes on with: asked for early, for it is read once and lies in no cache.
inline void read_ahead(const void* at) {
  constexpr std::uintptr_t kBytes = 1024;
  __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(at) + kBytes));
}

} // namespace oversketch
