#include "core/geometry/curve.h"
#include "core/geometry/segment_tree.h"
#include "tests/unit/geometry/shapes.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

using testing::blob;
using testing::circle;

TEST(SimplifyTest, ToleranceMustBeANumberAndFewPointsStay) {
  EXPECT_THROW(static_cast<void>(simplify({{0, 0}, {1, 1}, {2, 0}}, -1, false)), BugError);
  EXPECT_THROW(static_cast<void>(simplify({{0, 0}, {1, 1}, {2, 0}}, std::nan(""), false)), BugError);
  EXPECT_EQ(simplify({}, 1, true), Points{});
  EXPECT_EQ(simplify({{1, 1}, {2, 2}}, 1, true), (Points{{1, 1}, {2, 2}}));
  EXPECT_EQ(simplify({{1, 1}, {1, 1}, {1, 1}}, 1, true), (Points{{1, 1}}));
}

TEST(SimplifyTest, DropsWhatLiesOnAChord) {
  EXPECT_EQ(simplify({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}, 0, false), (Points{{0, 0}, {2, 0}, {2, 2}}));
  EXPECT_EQ(simplify({{0, 0}, {5, 0}, {10, 0}, {10, 5}, {10, 10}, {5, 10}, {0, 10}, {0, 5}}, 0.1, true),
            (Points{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  EXPECT_EQ(simplify({{0, 0}, {20, 0}, {10, 0}}, 0.1, false), (Points{{0, 0}, {20, 0}, {10, 0}}))
      << "beyond the chord's end is not on the chord";
}

/// `kept` picks its points from `all` in order; every one between two kept ones lies near their chord.
void expect_within(const Points& all, const Points& kept, double tolerance, bool closed) {
  std::size_t k = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (k < kept.size() && all[i] == kept[k]) {
      ++k;
      continue;
    }
    ASSERT_GT(k, 0u) << "the first point stays";
    ASSERT_TRUE(closed || k < kept.size()) << "the last point of an open line stays";
    const double squared = nearest_on_segment(kept[k - 1], kept[k % kept.size()], all[i]).squared;
    ASSERT_LE(squared, tolerance * tolerance) << "point " << i;
  }
  EXPECT_EQ(k, kept.size()) << "a subset in order";
}

TEST(SimplifyTest, EveryDroppedPointIsWithinToleranceOfItsChord) {
  std::mt19937 random(41);
  for (int round = 0; round < 40; ++round) {
    const Points all = blob(random, 500, {100, 100}, 80, 0.6);
    const double tolerance = 0.02 * round;
    for (const bool closed : {true, false}) {
      const Points kept = simplify(all, tolerance, closed);
      expect_within(all, kept, tolerance, closed);
      EXPECT_LT(kept.size(), round > 4 ? all.size() / 2 : all.size() + 1);
    }
  }
}

TEST(SimplifyTest, ClosedCurvesKeepTheFirstPointAndTheFurthestFromIt) {
  const Points kept = simplify(circle(100, {0, 0}, 10), 1000, true);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0], (Point{10, 0}));
  EXPECT_NEAR(kept[1].x, -10, 1e-12);
}

TEST(SimplifyTest, ManyPointsNeedNoDeepStack) {
  Points zigzag;
  for (int i = 0; i < 1'000'000; ++i)
    zigzag.push_back({0.001 * i, i % 50'000 == 500 ? 5.0 : 0.0});
  expect_within(zigzag, simplify(zigzag, 0.5, false), 0.5, false);
}

} // namespace
} // namespace oversketch
