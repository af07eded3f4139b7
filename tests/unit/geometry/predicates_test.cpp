#include "core/geometry/predicates.h"

#include "tests/unit/geometry/shapes.h"

#include <gtest/gtest.h>

#include <limits>

#include <array>
#include <cstdint>
#include <utility>

namespace oversketch {
namespace {

__extension__ using Wide = __int128;

int sign(Wide value) {
  return (value > 0) - (value < 0);
}

/// Points on a fine grid far from the origin: every product needs more digits than a double has.
struct GridPoint {
  std::int64_t x;
  std::int64_t y;
  /// Exact: 2⁵² steps of 2⁻³² px.
  Point point() const { return {std::ldexp(static_cast<double>(x), -32), std::ldexp(static_cast<double>(y), -32)}; }
};

int orientation_by_integers(GridPoint a, GridPoint b, GridPoint c) {
  return sign(static_cast<Wide>(b.x - a.x) * (c.y - a.y) - static_cast<Wide>(b.y - a.y) * (c.x - a.x));
}

TEST(OrientationTest, PointsThatAreOneHaveNoTurn) {
  EXPECT_EQ(orientation({1, 2}, {1, 2}, {1, 2}), 0);
  EXPECT_EQ(orientation({1, 2}, {1, 2}, {3, 5}), 0);
  EXPECT_EQ(orientation({1, 2}, {3, 5}, {1, 2}), 0);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1) << "clockwise on the screen";
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), -1);
}

TEST(OrientationTest, AgreesWithIntegersOnNearlyStraightTriples) {
  std::mt19937_64 random(21);
  const auto pick = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  std::array<int, 3> seen{};
  for (int round = 0; round < 200'000; ++round) {
    const std::int64_t reach = std::int64_t{1} << 51;
    const GridPoint a{pick(-reach, reach), pick(-reach, reach)};
    const std::int64_t dx = pick(-1 << 20, 1 << 20), dy = pick(-1 << 20, 1 << 20), m = pick(1, 1 << 20),
                       n = pick(1, 1 << 20);
    const GridPoint b{a.x + m * dx, a.y + m * dy};
    const GridPoint c{a.x + n * dx + pick(-1, 1), a.y + n * dy + pick(-1, 1)};
    const int expected = orientation_by_integers(a, b, c);
    ASSERT_EQ(orientation(a.point(), b.point(), c.point()), expected) << "round " << round;
    ASSERT_EQ(orientation(b.point(), c.point(), a.point()), expected);
    ASSERT_EQ(orientation(b.point(), a.point(), c.point()), -expected);
    ++seen[static_cast<std::size_t>(expected + 1)];
  }
  for (const int count : seen)
    EXPECT_GT(count, 1000);
}

TEST(OrientationTest, StandsFarApartMagnitudes) {
  // The line through the first two passes the third by less than any rounding of the differences shows.
  EXPECT_EQ(orientation({0, 0}, {1e15, 1e15}, {1e-15, 1e-15}), 0);
  EXPECT_EQ(orientation({0, 0}, {1e15, 1e15}, {1e-15, std::nextafter(1e-15, 1.0)}), 1);
  EXPECT_EQ(orientation({1e15, 1e15}, {1e-15, std::nextafter(1e-15, 0.0)}, {0, 0}), -1);
}

TEST(SegmentsTouchTest, KnownCases) {
  const Point o{0, 0}, e{10, 0};
  EXPECT_TRUE(segments_touch(o, e, {5, -5}, {5, 5}));
  EXPECT_TRUE(segments_touch(o, e, {5, 0}, {5, 5})) << "an end on the other";
  EXPECT_TRUE(segments_touch(o, e, {10, 0}, {20, 5})) << "ends meet";
  EXPECT_TRUE(segments_touch(o, e, {10, 0}, {20, 0})) << "on one line, ends meet";
  EXPECT_TRUE(segments_touch(o, e, {3, 0}, {4, 0})) << "one within the other";
  EXPECT_TRUE(segments_touch({3, 0}, {4, 0}, o, e));
  EXPECT_TRUE(segments_touch({0, 0}, {0, 10}, {0, 5}, {0, 15})) << "upright";
  EXPECT_FALSE(segments_touch(o, e, {11, 0}, {20, 0})) << "on one line, apart";
  EXPECT_FALSE(segments_touch(o, e, {5, 1}, {5, 5}));
  EXPECT_FALSE(segments_touch(o, e, {11, -5}, {11, 5}));
  EXPECT_FALSE(segments_touch(o, e, {5, std::numeric_limits<double>::min()}, {5, 5}));
}

TEST(SegmentsTouchTest, DoesNotDependOnOrder) {
  std::mt19937 random(22);
  std::uniform_int_distribution<int> coordinate(0, 4);
  const auto pick = [&] { return Point{0.1 * coordinate(random), 0.1 * coordinate(random)}; };
  for (int round = 0; round < 20'000; ++round) {
    const Point a = pick(), b = pick(), c = pick(), d = pick();
    if (a == b || c == d) continue;
    const bool touch = segments_touch(a, b, c, d);
    ASSERT_EQ(segments_touch(b, a, c, d), touch);
    ASSERT_EQ(segments_touch(a, b, d, c), touch);
    ASSERT_EQ(segments_touch(c, d, a, b), touch);
  }
}

TEST(FoldsBackTest, OnlyAStraightTurnBack) {
  EXPECT_TRUE(folds_back({0, 0}, {10, 0}, {5, 0}));
  EXPECT_TRUE(folds_back({0, 0}, {10, 0}, {-5, 0}));
  EXPECT_TRUE(folds_back({0, 0}, {0, 10}, {0, 9}));
  EXPECT_TRUE(folds_back({0, 0}, {3, 7}, {0, 0}));
  EXPECT_FALSE(folds_back({0, 0}, {10, 0}, {15, 0}));
  EXPECT_FALSE(folds_back({0, 0}, {0, 10}, {0, 11}));
  EXPECT_FALSE(folds_back({0, 0}, {10, 0}, {5, 1e-300}));
}

} // namespace
} // namespace oversketch
