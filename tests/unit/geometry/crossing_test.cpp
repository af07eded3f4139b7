#include "core/geometry/curve.h"
#include "tests/unit/geometry/shapes.h"

#include <gtest/gtest.h>

#include <utility>

namespace oversketch {
namespace {

using testing::blob;
using testing::circle;

using Pair = std::pair<int, int>;

Pair first_pair(const Points& points, bool closed) {
  const auto crossing = find_self_crossing(points, closed);
  return crossing ? Pair{crossing->first, crossing->second} : Pair{-1, -1};
}

constexpr Pair kNone{-1, -1};

TEST(CrossingTest, TooFewPointsCrossNothing) {
  EXPECT_EQ(first_pair({}, true), kNone);
  EXPECT_EQ(first_pair({{1, 1}}, true), kNone);
  EXPECT_EQ(first_pair({{1, 1}, {1, 1}, {1, 1}}, true), kNone);
  EXPECT_EQ(first_pair({{1, 1}, {2, 1}}, false), kNone);
  EXPECT_EQ(first_pair({{0, 0}, {1, 0}, {0, 1}}, true), kNone);
  EXPECT_THROW(static_cast<void>(find_self_crossing({{0, 0}, {std::nan(""), 0}}, true)), BugError);
}

TEST(CrossingTest, KnownCases) {
  EXPECT_EQ(first_pair({{0, 0}, {10, 10}, {10, 0}, {0, 10}}, true), (Pair{0, 2})) << "a bow tie";
  EXPECT_EQ(first_pair({{0, 0}, {10, 10}, {10, 0}, {0, 10}}, false), (Pair{0, 2}));
  EXPECT_EQ(first_pair({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}, true), (Pair{0, 2})) << "a corner on an edge";
  EXPECT_EQ(first_pair({{0, 0}, {10, 0}, {10, 10}, {0, 0}, {0, 10}}, false), (Pair{0, 2})) << "through its start";
  EXPECT_EQ(first_pair({{0, 0}, {10, 0}, {5, 0}, {5, 5}}, false), (Pair{0, 1})) << "folds back";
  EXPECT_EQ(first_pair({{0, 0}, {10, 0}, {10, 5}, {20, 5}, {20, 0}}, true), (Pair{0, 4})) << "folds back at the seam";
  EXPECT_EQ(first_pair({{0, 0}, {10, 0}}, true), (Pair{0, 1})) << "there and back";
  EXPECT_EQ(first_pair({{0, 0}, {10, 0}, {20, 0}, {20, 5}}, true), kNone) << "straight on is no fold";
}

TEST(CrossingTest, TellsThePlace) {
  const auto tie = find_self_crossing({{0, 0}, {10, 10}, {10, 0}, {0, 10}}, true);
  ASSERT_TRUE(tie.has_value());
  EXPECT_EQ(tie->point, (Point{5, 5}));
  const auto corner = find_self_crossing({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}, true);
  ASSERT_TRUE(corner.has_value());
  EXPECT_EQ(corner->point, (Point{5, 0}));
  const auto overlap = find_self_crossing({{0, 0}, {10, 0}, {10, 5}, {20, 5}, {20, 0}, {7, 0}}, false);
  ASSERT_TRUE(overlap.has_value());
  EXPECT_EQ(overlap->point.y, 0);
  EXPECT_GE(overlap->point.x, 7);
  EXPECT_LE(overlap->point.x, 10);
}

TEST(CrossingTest, RepeatedPointsCountAsOneAndNumbersAreThoseGiven) {
  const Points tie{{0, 0}, {0, 0}, {10, 10}, {10, 10}, {10, 10}, {10, 0}, {0, 10}, {0, 0}};
  EXPECT_EQ(first_pair(tie, true), (Pair{1, 5}));
  Points ring = circle(50, {0, 0}, 10);
  Points twice;
  for (const Point p : ring)
    twice.insert(twice.end(), {p, p});
  twice.push_back(ring[0]);
  EXPECT_EQ(first_pair(twice, true), kNone);
  ring.push_back(ring[0]);
  EXPECT_EQ(first_pair(ring, true), kNone) << "the closing repeat is no touch";
  EXPECT_EQ(first_pair(ring, false), (Pair{0, 49})) << "an open line that ends at its start touches it";
}

// Small whole coordinates make touching, overlapping and folding common; the reference tests all pairs in integers.
struct Lattice {
  std::vector<std::pair<int, int>> points;
  std::pair<int, int> at(std::size_t i) const { return points[i % points.size()]; }

  static int turn(std::pair<int, int> a, std::pair<int, int> b, std::pair<int, int> c) {
    const int value = (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
    return (value > 0) - (value < 0);
  }
  static bool on(std::pair<int, int> a, std::pair<int, int> b, std::pair<int, int> p) {
    return turn(a, b, p) == 0 && std::min(a.first, b.first) <= p.first && p.first <= std::max(a.first, b.first) &&
           std::min(a.second, b.second) <= p.second && p.second <= std::max(a.second, b.second);
  }
  bool touch(std::size_t i, std::size_t j) const {
    const auto a = at(i), b = at(i + 1), c = at(j), d = at(j + 1);
    if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return true;
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
  }
  bool fold(std::size_t i) const {
    const auto a = at(i), b = at(i + 1), c = at(i + 2);
    const int forward = (b.first - a.first) * (c.first - b.first) + (b.second - a.second) * (c.second - b.second);
    return turn(a, b, c) == 0 && forward < 0;
  }
  Pair first(bool closed) const {
    const std::size_t n = points.size(), segments = closed ? n : n - 1;
    for (std::size_t i = 0; i < segments; ++i)
      for (std::size_t j = i + 1; j < segments; ++j) {
        const bool follows = j == i + 1, seam = closed && i == 0 && j == n - 1;
        const bool hit = follows || seam ? (follows && fold(i)) || (seam && fold(j)) : touch(i, j);
        if (hit) return {static_cast<int>(i), static_cast<int>(j)};
      }
    return kNone;
  }
};

TEST(CrossingTest, AgreesWithAllPairsInIntegers) {
  std::mt19937 random(31);
  int clean = 0;
  for (int round = 0; round < 30'000; ++round) {
    Lattice lattice;
    Points points;
    const int count = 2 + round % 9, size = 3 + round % 30;
    std::uniform_int_distribution<int> coordinate(0, size);
    while (static_cast<int>(points.size()) < count) {
      const std::pair<int, int> p{coordinate(random), coordinate(random)};
      if (!points.empty() && (p == lattice.points.back() || p == lattice.points.front())) continue;
      lattice.points.push_back(p);
      // An odd scale and shift, the same for all, that rounds: touching must survive only where it is exact.
      points.push_back({0.25 * p.first + 1024, 0.25 * p.second - 512});
    }
    for (const bool closed : {true, false}) {
      const Pair expected = lattice.first(closed);
      ASSERT_EQ(first_pair(points, closed), expected) << "round " << round << (closed ? " closed" : " open");
      clean += expected == kNone;
    }
  }
  EXPECT_GT(clean, 5000);
}

TEST(CrossingTest, FindsTheOneCrossingOfALongCurve) {
  std::mt19937 random(32);
  for (int round = 0; round < 50; ++round) {
    Points points = blob(random, 2000, {0, 0}, 300, 0.5);
    ASSERT_EQ(first_pair(points, true), kNone);
    // Pull a point across the far side.
    const std::size_t pulled = random() % points.size();
    points[pulled] = -3.0 * points[pulled];
    const auto crossing = find_self_crossing(points, true);
    ASSERT_TRUE(crossing.has_value());
    const auto near_pulled = [&](int segment) {
      return segment == static_cast<int>(pulled) || (segment + 1) % 2000 == static_cast<int>(pulled);
    };
    EXPECT_TRUE(near_pulled(crossing->first) || near_pulled(crossing->second));
  }
}

Points spiral(int count) {
  Points there, back;
  for (int i = 0; i < count; ++i) {
    const double turns = 0.02 * i, radius = 1 + turns;
    there.push_back(radius * Point{std::cos(turns), std::sin(turns)});
    back.push_back((radius + 2) * Point{std::cos(turns), std::sin(turns)});
  }
  there.insert(there.end(), back.rbegin(), back.rend());
  return there;
}

/// Long straight strokes side by side in the direction (dx, dy), closed round the far side.
Points hatching(int strokes, Point along) {
  Points points;
  const Point across = turned(along) / length(along);
  for (int i = 0; i < strokes; ++i) {
    const Point start = 0.01 * i * across;
    points.push_back(i % 2 == 0 ? start : start + along);
    points.push_back(i % 2 == 0 ? start + along : start);
  }
  points.push_back(points.back() - along);
  points.push_back(points.front() - along);
  return points;
}

TEST(CrossingTest, LargeAndUnevenCurvesAreWithinReach) {
  EXPECT_EQ(first_pair(circle(100'000, {500, 500}, 400), true), kNone);
  EXPECT_EQ(first_pair(spiral(10'000), true), kNone);
  EXPECT_EQ(first_pair(hatching(10'000, {700, 0}), true), kNone);
  EXPECT_EQ(first_pair(hatching(10'000, {700, 313}), true), kNone);
  // Very many tiny segments in a corner of one giant triangle.
  Points mixed = circle(300'000, {0, 0}, 1e-3);
  mixed.push_back({1e6, -2e6});
  mixed.push_back({1e6, -1});
  EXPECT_EQ(first_pair(mixed, true), kNone);
  mixed.push_back({-1, 1e-6});
  EXPECT_NE(first_pair(mixed, true), kNone);
}

} // namespace
} // namespace oversketch
