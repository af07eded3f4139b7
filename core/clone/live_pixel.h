#pragma once

#include <cstdint>

namespace oversketch {

/// A pixel of the source: 64 · level + 32 of red, green, blue and alpha.  The half is for rounding down at the end.
struct LivePixel {
  static constexpr float kPerLevel = 64;
  static constexpr float kOpaque = kPerLevel * 255;

  std::int16_t r = 0;
  std::int16_t g = 0;
  std::int16_t b = 0;
  std::int16_t a = 0;

  bool is_opaque() const { return a >= 255 * 64 + 32; }
};

} // namespace oversketch
