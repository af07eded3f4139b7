#pragma once

#include <array>
#include <cstddef>

namespace oversketch {

/// Red, green, blue of one pixel while it is computed with; the fourth is 0 and fills the SIMD register.
struct alignas(32) Channels {
  std::array<double, 4> v{};

  Channels& operator+=(const Channels& b) {
    for (std::size_t k = 0; k < 4; ++k)
      v[k] += b.v[k];
    return *this;
  }
  Channels& operator-=(const Channels& b) {
    for (std::size_t k = 0; k < 4; ++k)
      v[k] -= b.v[k];
    return *this;
  }
  Channels& operator*=(double by) {
    for (std::size_t k = 0; k < 4; ++k)
      v[k] *= by;
    return *this;
  }
};

inline Channels operator+(const Channels& a, const Channels& b) {
  Channels out = a;
  return out += b;
}
inline Channels operator-(const Channels& a, const Channels& b) {
  Channels out = a;
  return out -= b;
}
inline Channels operator*(double by, const Channels& a) {
  Channels out = a;
  return out *= by;
}

inline double norm_squared(const Channels& a) {
  return a.v[0] * a.v[0] + a.v[1] * a.v[1] + a.v[2] * a.v[2] + a.v[3] * a.v[3];
}

} // namespace oversketch
