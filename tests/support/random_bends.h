#pragma once

#include "core/geometry/curve.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

/// Curve pairs made up at random: a shape, bent by a smooth map, turned, scaled, and drawn with a trembling hand.
namespace oversketch::testing {

struct BentPair {
  Points outline;
  Points sketch;
  /// Where each outline point belongs.
  Points truth;
};

/// A star-shaped closed curve r(φ), about 200 px in radius.
template <class Radius>
Points polar_shape(int count, Radius radius) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * std::numbers::pi * i / count, r = radius(a);
    points.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return points;
}

inline Points bar_shape() {
  return {{-200, -30}, {200, -30}, {200, 30}, {-200, 30}};
}
inline Points star_shape() {
  Points points;
  for (int i = 0; i < 10; ++i) {
    const double a = std::numbers::pi * (i / 5.0 - 0.5), r = i % 2 == 0 ? 200 : 95;
    points.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return points;
}
inline Points ellipse_shape() {
  Points points = polar_shape(160, [](double) { return 1.0; });
  for (Point& p : points)
    p = {200 * p.x, 110 * p.y};
  return points;
}
inline Points blob_shape() {
  return polar_shape(
      160, [](double a) { return 150 + 28 * std::cos(2 * a + 1) + 22 * std::sin(3 * a) + 12 * std::cos(5 * a); });
}
inline Points fish_shape() {
  return {{200, 0},    {170, 28},  {110, 62},  {40, 82},  {-40, 70},   {-95, 38},   {-125, 18},
          {-160, 60},  {-195, 90}, {-185, 40}, {-178, 0}, {-185, -40}, {-195, -90}, {-160, -60},
          {-125, -18}, {-95, -38}, {-40, -70}, {40, -82}, {110, -62},  {170, -28}};
}
inline Points pineapple_shape() {
  Points points;
  for (int i = 0; i <= 60; ++i) {
    const double a = std::numbers::pi * (-0.28 + 1.56 * i / 60);
    points.push_back({100 * std::cos(a), 60 + 125 * std::sin(a)});
  }
  const Points leaves{{-95, -85}, {-45, -80}, {-62, -150}, {-22, -105}, {0, -190},
                      {22, -105}, {62, -150}, {45, -80},   {95, -85}};
  points.insert(points.end(), leaves.begin(), leaves.end());
  return points;
}
inline Points cactus_shape() {
  return {{-40, 200}, {-40, 60},   {-110, 60},  {-125, 45}, {-125, -50}, {-105, -72}, {-85, -50}, {-85, 15},
          {-40, 15},  {-40, -170}, {-20, -198}, {20, -198}, {40, -170},  {40, 60},    {85, 60},   {85, -20},
          {105, -42}, {125, -20},  {125, 90},   {110, 105}, {40, 105},   {40, 200}};
}

inline std::vector<std::pair<std::string_view, Points>> named_shapes() {
  return {{"fish", fish_shape()}, {"pineapple", pineapple_shape()}, {"cactus", cactus_shape()},  {"bar", bar_shape()},
          {"star", star_shape()}, {"blob", blob_shape()},           {"ellipse", ellipse_shape()}};
}

/// z ↦ z + Σ a sin(k·z + φ), low frequencies, injective on the shape's box.
class SmoothBend {
public:
  SmoothBend(std::mt19937& random, double strength) {
    std::uniform_real_distribution<double> one(-1, 1);
    for (int k = 0; k < 4; ++k) {
      const double turn = std::numbers::pi * one(random), length = 350 + 250 * one(random);
      const double wave = 2 * std::numbers::pi / length;
      waves_.push_back({wave * Point{std::cos(turn), std::sin(turn)}, strength / wave * Point{one(random), one(random)},
                        std::numbers::pi * one(random)});
    }
  }
  Point operator()(Point z) const {
    Point out = z;
    for (const Wave& w : waves_)
      out += std::sin(dot(w.wave, z) + w.phase) * w.push;
    return out;
  }
  Points all(const Points& points) const {
    Points out;
    for (const Point p : points)
      out.push_back((*this)(p));
    return out;
  }
  /// Least determinant of the derivative on a grid over a box of half side `reach`.
  double least_determinant(double reach) const {
    double least = HUGE_VAL;
    for (double x = -reach; x <= reach; x += reach / 20)
      for (double y = -reach; y <= reach; y += reach / 20) {
        Point dx{1, 0}, dy{0, 1};
        for (const Wave& w : waves_) {
          const double c = std::cos(dot(w.wave, {x, y}) + w.phase);
          dx += c * w.wave.x * w.push;
          dy += c * w.wave.y * w.push;
        }
        least = std::min(least, cross(dx, dy));
      }
    return least;
  }

private:
  struct Wave {
    Point wave, push;
    double phase = 0;
  };
  std::vector<Wave> waves_;
};

/// @param seed  decides everything but the shape.
inline BentPair bend_at_random(const Points& shape, std::uint32_t seed, double strength = 0.3, double noise_px = 1.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> one(-1, 1);
  const Points dense = resample(ClosedCurve(shape), 400);
  SmoothBend bend(random, strength);
  while (bend.least_determinant(210) < 0.25 || find_self_crossing(bend.all(dense), true))
    bend = SmoothBend(random, strength);
  const double turn = 0.7 * one(random), scale = std::exp(0.4 * one(random));
  const Similarity place{std::polar(scale, turn), {300 * one(random), 300 * one(random)}};
  BentPair pair;
  pair.outline = dense;
  for (const Point p : pair.outline)
    pair.truth.push_back(place(bend(p)));
  const ClosedCurve exact(pair.truth);
  const int count = 140 + static_cast<int>(60 * one(random));
  const double start = exact.length() * 0.5 * (1 + one(random));
  for (int i = 0; i < count; ++i)
    pair.sketch.push_back(exact.at(start + exact.length() * i / count) +
                          scale * noise_px * Point{one(random), one(random)});
  return pair;
}

} // namespace oversketch::testing
