#include "core/deform/cleanup.h"

#include "core/geometry/mask.h"
#include "tests/support/random_bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace oversketch {
namespace {

using testing::polar_shape;

Points round_points(int count, double radius) {
  return polar_shape(count, [&](double) { return radius; });
}

std::string code_of(const Points& points) {
  const auto clean = clean_sketch(points, 1.0);
  return clean ? "" : clean.error().code;
}

/// A round_points with a small loop drawn into it at every `every`-th point.
Points with_loops(int count, int every, double size) {
  Points points;
  const Points round = round_points(count, 200);
  for (int i = 0; i < count; ++i) {
    points.push_back(round[i]);
    if (i % every != 0) continue;
    const Point way = (round[(i + 1) % count] - round[i]) / length(round[(i + 1) % count] - round[i]);
    for (int k = 1; k < 8; ++k) {
      const double a = 2 * std::numbers::pi * k / 8;
      points.push_back(round[i] + size * (std::sin(a) * way + (std::cos(a) - 1) * turned(way)) +
                       0.0125 * k * size * way);
    }
  }
  return points;
}

TEST(Cleanup, RefusesWhatIsNoSketch) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of({}), "sketch.too-few-points");
  EXPECT_EQ(code_of({{0, 0}, {5, 5}}), "sketch.too-few-points");
  EXPECT_EQ(code_of({{0, 0}, {0, 0}, {5, 5}, {5, 5}, {0, 0}}), "sketch.too-few-points");
  EXPECT_EQ(code_of({{0, 0}, {9, nan}, {9, 9}}), "sketch.not-finite");
  EXPECT_EQ(code_of({{0, 0}, {9, HUGE_VAL}, {9, 9}}), "sketch.not-finite");
  EXPECT_EQ(code_of({{0, 0}, {kMaskCoordinateLimit, 0}, {9, 9}}), "sketch.too-far");
  EXPECT_EQ(code_of({{0, 0}, {100, 0}, {50, 0}}), "sketch.no-area");
  EXPECT_EQ(code_of({{0, 0}, {0.9, 0}, {0.9, 0.9}, {0, 0.9}}), "sketch.no-area");
  EXPECT_EQ(code_of({{0, 0}, {4000, 0}, {4000, 0.2}, {0, 0.2}}), "sketch.no-area");
}

TEST(Cleanup, RefusesAFigureEightAndNamesTheCrossing) {
  Points eight;
  for (int i = 0; i < 100; ++i) {
    const double a = 2 * std::numbers::pi * (i + 0.3) / 100;
    eight.push_back({500 + 200 * std::sin(a), 300 + 100 * std::sin(2 * a)});
  }
  const auto clean = clean_sketch(eight, 1.0);
  ASSERT_FALSE(clean.ok());
  EXPECT_EQ(clean.error().code, "sketch.crosses-itself");
  EXPECT_NE(clean.error().sentence.find("(500.0, 300.0)"), std::string::npos) << clean.error().sentence;
}

TEST(Cleanup, LeavesASimpleCurveItsPoints) {
  const Points given = round_points(50, 100);
  const auto clean = clean_sketch(given, 1.0);
  ASSERT_TRUE(clean.ok());
  EXPECT_EQ(clean->curve.size(), 50);
  EXPECT_EQ(clean->loops_cut, 0);
  EXPECT_EQ(clean->cut_length, 0);
  for (const Point p : clean->curve.points())
    EXPECT_NE(std::find(given.begin(), given.end(), p), given.end());
}

TEST(Cleanup, TheSameCurveWhereverItStartsAndWhicheverWayItRuns) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Points given = testing::bend_at_random(testing::fish_shape(), seed).sketch;
    const auto first = clean_sketch(given, 1.0);
    ASSERT_TRUE(first.ok()) << seed;
    Points other = given;
    std::rotate(other.begin(), other.begin() + 37, other.end());
    std::reverse(other.begin(), other.end());
    const auto second = clean_sketch(other, 1.0);
    ASSERT_TRUE(second.ok()) << seed;
    EXPECT_NE(first->reversed, second->reversed);
    ASSERT_EQ(first->curve.size(), second->curve.size()) << seed;
    for (int i = 0; i < first->curve.size(); ++i)
      EXPECT_LT(distance(first->curve.points()[i], second->curve.points()[i]), 1e-9) << seed;
  }
}

TEST(Cleanup, TurnsTheWayAskedFor) {
  const Points given = round_points(40, 60);
  EXPECT_GT(clean_sketch(given, 1.0)->curve.signed_area(), 0);
  EXPECT_LT(clean_sketch(given, -1.0)->curve.signed_area(), 0);
  EXPECT_TRUE(clean_sketch(given, -1.0)->reversed);
}

TEST(Cleanup, CutsSmallLoopsAndKeepsTheShape) {
  const Points given = with_loops(300, 25, 4);
  ASSERT_TRUE(find_self_crossing(given, true).has_value());
  const auto clean = clean_sketch(given, 1.0);
  ASSERT_TRUE(clean.ok()) << clean.error().sentence;
  EXPECT_EQ(clean->loops_cut, 12);
  EXPECT_FALSE(find_self_crossing(clean->curve.points(), true).has_value());
  EXPECT_NEAR(clean->curve.length() + clean->cut_length, perimeter(given), 1e-6);
  for (const Point p : clean->curve.points())
    EXPECT_NEAR(length(p), 200, 10);
}

TEST(Cleanup, AThousandTinyLoopsAreCutInOnePass) {
  const Points given = with_loops(4000, 4, 0.06);
  const auto clean = clean_sketch(given, 1.0);
  ASSERT_TRUE(clean.ok()) << clean.error().sentence;
  EXPECT_GE(clean->loops_cut, 900);
  EXPECT_NEAR(clean->curve.length(), 400 * std::numbers::pi, 15);
}

TEST(Cleanup, RefusesATangle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> one(-100, 100);
  Points scribble;
  for (int i = 0; i < 400; ++i)
    scribble.push_back({one(random), one(random)});
  EXPECT_EQ(code_of(scribble), "sketch.tangled");
}

TEST(Cleanup, ArcLengthOfTheGivenCurveGrowsAlongTheCleanOne) {
  for (const bool backwards : {false, true}) {
    Points given = with_loops(300, 25, 4);
    if (backwards) std::reverse(given.begin(), given.end());
    const auto clean = clean_sketch(given, 1.0);
    ASSERT_TRUE(clean.ok());
    Points run = given;
    if (clean->reversed) std::reverse(run.begin() + 1, run.end());
    const ClosedCurve along(run);
    int wraps = 0;
    double before = clean->to_given(0);
    for (int k = 1; k <= 2000; ++k) {
      const double s = clean->curve.length() * k / 2000, at = clean->to_given(s);
      EXPECT_GE(at, 0);
      EXPECT_LT(at, clean->given_length);
      if (at < before - 1e-9) ++wraps;
      EXPECT_LT(distance(along.at(at), clean->curve.at(s)), 1e-6);
      before = at;
    }
    EXPECT_EQ(wraps, 1);
  }
}

} // namespace
} // namespace oversketch
