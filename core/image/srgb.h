#pragma once

#include <cmath>

namespace oversketch {

/// Linear light to the sRGB encoding, IEC 61966-2-1: 12.92 x up to 0.0031308, 1.055 x^(1/2.4) − 0.055 beyond.
///
/// Defined for every finite value: the power branch goes on above 1, and negative values are mirrored, f(−x) = −f(x).
/// At the join the standard's rounded constants leave a step of 3·10⁻⁸.  Accuracy: that of std::pow.
inline double srgb_from_linear(double linear) {
  const double x = std::abs(linear);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

/// The sRGB encoding to linear light, the inverse of srgb_from_linear: x / 12.92 up to 0.04045, ((x + 0.055)
/// / 1.055)^2.4 beyond; continued and mirrored in the same way.
inline double linear_from_srgb(double encoded) {
  const double x = std::abs(encoded);
  const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  return std::copysign(linear, encoded);
}

} // namespace oversketch
