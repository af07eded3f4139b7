#include "core/deform/start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace oversketch {
namespace {

/// A blob of no symmetry; the same for the same seed.
Points make_blob(unsigned seed, int count = 200) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  double sines[5], cosines[5];
  for (int k = 0; k < 5; ++k)
    sines[k] = value(random) * 15, cosines[k] = value(random) * 15;
  Points out;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    double radius = 100;
    for (int k = 0; k < 5; ++k)
      radius += sines[k] * std::sin((k + 1) * angle) + cosines[k] * std::cos((k + 1) * angle);
    out.push_back({300 + radius * std::cos(angle), 200 + radius * std::sin(angle)});
  }
  return out;
}

Points started_at(Points points, int first) {
  std::rotate(points.begin(), points.begin() + first, points.end());
  return points;
}

Points run_backwards(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}

Point start_point(const Points& outline, const Points& sketch) {
  const ClosedCurve curve(sketch);
  const double s = choose_start(ClosedCurve(outline), curve);
  EXPECT_GE(s, 0);
  EXPECT_LT(s, curve.length());
  return curve.at(s);
}

TEST(ChooseStart, FindsTheSimilarity) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Points outline = make_blob(seed);
    const Similarity map{std::polar(0.5 + 0.1 * seed, 0.3 * seed), {-70.0 * seed, 900}};
    const Points sketch = transformed(started_at(outline, 37), map);
    EXPECT_LT(distance(start_point(outline, sketch), map(outline[0])), 1e-6 * perimeter(sketch)) << "seed " << seed;
  }
}

TEST(ChooseStart, HardlyFeelsNoise) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Points outline = make_blob(seed);
    Points sketch = started_at(outline, 120);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 1);
    for (Point& p : sketch)
      p += {noise(random), noise(random)};
    EXPECT_LT(distance(start_point(outline, sketch), outline[0]), 0.02 * perimeter(outline)) << "seed " << seed;
  }
}

TEST(ChooseStart, DoesNotDependOnHowTheSketchIsGiven) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Points outline = make_blob(seed), sketch = make_blob(seed + 100);
    const double near = 1e-6 * perimeter(sketch);
    const Point expected = start_point(outline, sketch);
    EXPECT_LT(distance(start_point(outline, started_at(sketch, 61)), expected), near) << "seed " << seed;
    EXPECT_LT(distance(start_point(outline, run_backwards(sketch)), expected), near) << "seed " << seed;
    EXPECT_LT(distance(start_point(run_backwards(outline), sketch),
                       start_point(run_backwards(outline), run_backwards(sketch))),
              near);
    for (const Similarity& map : {Similarity{1e-3, {5e5, -5e5}}, Similarity{40.0, 0}, Similarity{1.0, {3, 4}}}) {
      const Point found = start_point(outline, transformed(sketch, map));
      EXPECT_LT(distance(found, map(expected)), near * std::abs(map.factor)) << "seed " << seed;
    }
  }
}

TEST(ChooseStart, PrefersNoRotationWhereShapesRepeat) {
  const Points bar{{0, 0}, {50, 0}, {100, 0}, {200, 0}, {200, 40}, {0, 40}};
  EXPECT_LT(distance(start_point(bar, started_at(bar, 4)), bar[0]), 1e-4);
  // A square turned by 30° has four equal answers; the one turned by 60° back is not taken.
  const Points square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  const Similarity turn{std::polar(1.0, std::numbers::pi / 6), 0};
  EXPECT_LT(distance(start_point(square, transformed(started_at(square, 2), turn)), turn(square[0])), 1e-4);
}

TEST(ChooseStart, LeavesACircleAsItStands) {
  Points circle;
  for (int i = 0; i < 360; ++i) {
    const double angle = 2 * std::numbers::pi * i / 360;
    circle.push_back({100 * std::cos(angle), 100 * std::sin(angle)});
  }
  EXPECT_LT(distance(start_point(circle, started_at(circle, 77)), circle[0]), perimeter(circle) / 256);
}

} // namespace
} // namespace oversketch
