#pragma once

#include <cstddef>

namespace oversketch {

/// Of what is counted by ints, which are not negative.
inline std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

} // namespace oversketch
