#include "core/base/rect.h"

#include <gtest/gtest.h>

#include <random>

namespace oversketch {
namespace {

/// Every pixel of a small window against the meaning of the operation.
template <class Expected>
void expect_pixels(const Rect& rect, Expected&& expected) {
  for (int y = -20; y < 20; ++y)
    for (int x = -20; x < 20; ++x)
      ASSERT_EQ(rect.contains(x, y), expected(x, y)) << x << ", " << y;
}

TEST(RectTest, EmptyOnesHaveNoPixels) {
  EXPECT_TRUE(Rect().empty());
  EXPECT_TRUE((Rect{3, 4, 0, 5}).empty());
  EXPECT_TRUE((Rect{3, 4, 5, 0}).empty());
  EXPECT_FALSE((Rect{3, 4, 1, 1}).empty());
  expect_pixels({3, 4, 0, 5}, [](int, int) { return false; });
  const Rect apart = intersect({0, 0, 2, 2}, {10, 10, 2, 2});
  EXPECT_TRUE(apart.empty());
  EXPECT_GE(apart.width, 0);
  EXPECT_GE(apart.height, 0);
}

TEST(RectTest, IntersectionIsTheCommonPixels) {
  std::mt19937 random(5);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int round = 0; round < 200; ++round) {
    const Rect a{pick(-9, 9), pick(-9, 9), pick(0, 9), pick(0, 9)}, b{pick(-9, 9), pick(-9, 9), pick(0, 9), pick(0, 9)};
    expect_pixels(intersect(a, b), [&](int x, int y) { return a.contains(x, y) && b.contains(x, y); });
    EXPECT_EQ(intersect(a, b), intersect(b, a));
  }
}

TEST(RectTest, UnionIsTheSmallestRoundBoth) {
  EXPECT_EQ(unite({0, 0, 2, 3}, {5, -1, 1, 1}), (Rect{0, -1, 6, 4}));
  EXPECT_EQ(unite({}, {5, 6, 1, 1}), (Rect{5, 6, 1, 1}));
  EXPECT_EQ(unite({5, 6, 1, 1}, {9, 9, 0, 3}), (Rect{5, 6, 1, 1}));
}

TEST(RectTest, MovesAndGrows) {
  EXPECT_EQ(translated({1, 2, 3, 4}, 10, -5), (Rect{11, -3, 3, 4}));
  EXPECT_EQ(grown({1, 2, 3, 4}, 2), (Rect{-1, 0, 7, 8}));
  EXPECT_EQ(grown(grown(Rect{1, 2, 3, 4}, 2), -2), (Rect{1, 2, 3, 4}));
  EXPECT_EQ((Rect{1, 2, 3, 4}).right(), 4);
  EXPECT_EQ((Rect{1, 2, 3, 4}).bottom(), 6);
}

} // namespace
} // namespace oversketch
