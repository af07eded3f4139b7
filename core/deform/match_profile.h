#pragma once

#include "core/deform/match.h"

#include <array>
#include <vector>

namespace oversketch {

/// Turning angles at three scales as weighted (cos, sin), then the direction as (cos, sin): one sample of a profile.
struct ShapeSample {
  std::array<float, 6> turning{};
  std::array<float, 2> direction{};
};

/// Weights of the three turning angles, fine to coarse.
inline constexpr std::array<double, 3> kTurningWeights{0.5, 1.0, 1.0};

/// A curve smoothed and measured along u in [0, 1), the part of its smoothed length.
struct MatchSource::Profile {
  explicit Profile(const ClosedCurve& curve);

  /// @param reach  what the three scales are multiplied by.
  ShapeSample sample(double u, double reach) const;
  std::vector<ShapeSample> samples(int count, double from, double to, double reach) const;
  /// Arc length (px) on the given curve, not wrapped: u + 1 is one length further.
  double s_at(double u) const;
  /// Inverse of s_at.
  double u_at(double s) const;

private:
  /// Integral of the smoothed curve over u from 0; any u.
  Point integral(double u) const;
  Point mean(double from, double to) const { return (1 / (to - from)) * (integral(to) - integral(from)); }

  double length_ = 0;
  /// At u = k / kSamples, k = 0…kSamples.
  std::vector<double> s_;
  Points sums_;
};

/// How much the direction counts, and by how much (cos, sin) the outline is turned before it is compared.
struct DirectionTerm {
  float weight = 0;
  float cosine = 1;
  float sine = 0;
};

/// Local cost of a sample of the outline and one of the sketch, >= 0.
inline float shape_cost(const ShapeSample& outline, const ShapeSample& sketch, const DirectionTerm& term) {
  constexpr float whole = static_cast<float>(kTurningWeights[0] + kTurningWeights[1] + kTurningWeights[2]);
  float same = 0;
  for (std::size_t k = 0; k < 6; ++k)
    same += outline.turning[k] * sketch.turning[k];
  const auto& a = outline.direction;
  const float x = term.cosine * a[0] - term.sine * a[1], y = term.sine * a[0] + term.cosine * a[1];
  return (whole - same) + term.weight * (1 - (x * sketch.direction[0] + y * sketch.direction[1]));
}

} // namespace oversketch
