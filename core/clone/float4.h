#pragma once

#include <cstddef>

namespace oversketch {

/// Red, green, blue and one more number, added and multiplied each by itself.  One SIMD register: the vectors of GCC
/// and Clang become SSE, NEON or plain code, whatever the processor has, with the same bits.
struct Float4 {
  using Lanes [[gnu::vector_size(16)]] = float;
  Lanes v{};

  Float4& operator+=(const Float4& b) {
    v += b.v;
    return *this;
  }
  Float4& operator-=(const Float4& b) {
    v -= b.v;
    return *this;
  }
  float operator[](std::size_t k) const { return v[k]; }
};

inline Float4 operator+(const Float4& a, const Float4& b) {
  return {a.v + b.v};
}
inline Float4 operator-(const Float4& a, const Float4& b) {
  return {a.v - b.v};
}
inline Float4 operator*(float by, const Float4& a) {
  return {by * a.v};
}

} // namespace oversketch
