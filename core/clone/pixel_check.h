#pragma once

#include "core/base/result.h"
#include "core/image/image.h"

#include <cmath>
#include <string>

namespace oversketch {

/// Values of a picture beyond ± this are not blended: the largest number of half-precision pictures.  In linear light
/// it is 4·10¹¹, whose squares are added up in float.
inline constexpr float kLargestBlended = 65504;

/// Whether a pixel can be blended.
inline bool is_blendable(const Rgba& p) {
  // Written so that not-a-number fails.
  return std::abs(p.r) <= kLargestBlended && std::abs(p.g) <= kLargestBlended && std::abs(p.b) <= kLargestBlended &&
         std::abs(p.a) <= kLargestBlended;
}

/// Whether it can be pasted as it is.
inline bool is_number(const Rgba& p) {
  return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.a);
}

/// Of a pixel that is not blendable, or not a number: what is wrong.
/// @param picture  "source" or "target".
inline Error refuse_pixel(const std::string& picture, const Rgba& pixel, int x, int y) {
  const std::string where = picture + " pixel " + std::to_string(x) + ", " + std::to_string(y);
  if (!is_number(pixel))
    return {"clone.not-finite", "The " + picture + " has a pixel that is not a number, or infinite.", where};
  return {"clone.out-of-range",
          "The " + picture + " has a pixel brighter or darker than ±65504 times white: darken the picture.", where};
}

} // namespace oversketch
