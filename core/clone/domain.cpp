#include "core/clone/domain.h"

#include <cmath>

namespace oversketch {
namespace {

template <class F>
Channels by_channel(const Channels& in, F f) {
  Channels out;
  for (std::size_t k = 0; k < 3; ++k)
    out.v[k] = std::copysign(f(std::abs(in.v[k])), in.v[k]);
  return out;
}

// The curve's slope where it is straight, near black; nowhere is the encoding steeper.
constexpr double kToeSlope = 12.92;
constexpr double kToeEncoded = 0.04045;

double decode(double encoded) {
  return encoded <= kToeEncoded ? encoded / kToeSlope : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encode(double linear) {
  return linear <= kToeEncoded / kToeSlope ? linear * kToeSlope : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

} // namespace

Channels to_domain(const Rgba& pixel, Domain domain) {
  const Channels encoded{{pixel.r, pixel.g, pixel.b, 0}};
  switch (domain) {
  case Domain::kEncoded:
    return encoded;
  case Domain::kLinear:
    return by_channel(encoded, decode);
  case Domain::kLog:
    return by_channel(encoded, [](double x) { return std::log1p(x / kLogEpsilon); });
  }
  return encoded;
}

Channels from_domain(const Channels& values, Domain domain) {
  switch (domain) {
  case Domain::kEncoded:
    return values;
  case Domain::kLinear:
    return by_channel(values, encode);
  case Domain::kLog:
    return by_channel(values, [](double y) { return kLogEpsilon * std::expm1(y); });
  }
  return values;
}

double largest_slope(Domain domain, double most) {
  switch (domain) {
  case Domain::kEncoded:
    return 1;
  case Domain::kLinear:
    return kToeSlope;
  case Domain::kLog:
    return most + kLogEpsilon;
  }
  return 1;
}

} // namespace oversketch
