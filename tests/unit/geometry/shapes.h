#pragma once

#include "core/geometry/point.h"

#include <numbers>
#include <random>

namespace oversketch::testing {

inline Points circle(int count, Point centre, double radius) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.push_back(centre + radius * Point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

/// A smooth simple closed curve: a circle whose radius swings by up to `swing` (below 1) times itself.
inline Points blob(std::mt19937& random, int count, Point centre, double radius, double swing) {
  std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
  const double a = phase(random), b = phase(random), c = phase(random);
  Points points = circle(count, {}, 1);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const double wave = (std::cos(2 * angle + a) + std::cos(3 * angle + b) + std::cos(5 * angle + c)) / 3;
    Point& p = points[static_cast<std::size_t>(i)];
    p = centre + radius * (1 + swing * wave) * p;
  }
  return points;
}

inline Point random_point(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> value(low, high);
  const double x = value(random);
  return {x, value(random)};
}

} // namespace oversketch::testing
