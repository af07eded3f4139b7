#include "core/geometry/mask.h"

#include "core/base/check.h"
#include "core/geometry/curve.h"
#include "tests/unit/geometry/shapes.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace oversketch {
namespace {

using testing::blob;
using testing::circle;
using testing::random_point;

using Pixels = std::set<std::pair<int, int>>;

Pixels pixels_of(const Mask& mask) {
  Pixels all;
  for (const Mask::Run& run : mask.runs())
    for (int x = run.x0; x < run.x1; ++x)
      all.insert({x, run.y});
  return all;
}

std::vector<Mask::Run> random_runs(std::mt19937& random, int count, int size) {
  std::uniform_int_distribution<int> place(-size, size), width(-1, 5);
  std::vector<Mask::Run> runs;
  for (int i = 0; i < count; ++i) {
    const int x = place(random);
    runs.push_back({place(random), x, x + width(random)});
  }
  return runs;
}

/// What the class promises of its runs, and that its numbers follow from them.
void expect_tidy(const Mask& mask) {
  std::int64_t count = 0;
  Rect bounds;
  for (std::size_t i = 0; i < mask.runs().size(); ++i) {
    const Mask::Run run = mask.runs()[i];
    ASSERT_LT(run.x0, run.x1);
    count += run.x1 - run.x0;
    bounds = unite(bounds, {run.x0, run.y, run.x1 - run.x0, 1});
    if (i == 0) continue;
    const Mask::Run before = mask.runs()[i - 1];
    ASSERT_TRUE(before.y < run.y || (before.y == run.y && before.x1 < run.x0));
  }
  EXPECT_EQ(mask.count(), count);
  EXPECT_EQ(mask.bounds(), bounds);
  EXPECT_EQ(mask.empty(), count == 0);
}

TEST(MaskTest, EmptyInEveryWay) {
  for (const Mask& mask :
       {Mask(), Mask(std::vector<Mask::Run>{}), Mask({{3, 5, 5}, {4, 9, 2}}), grown(Mask()), translated(Mask(), 3, 4),
        intersect(Mask({{0, 0, 5}}), {7, 0, 3, 3}), intersect(Mask({{0, 0, 5}}), {}),
        rasterize_polygon({}, {0, 0, 9, 9}), rasterize_polygon({{1, 1}, {5, 5}}, {0, 0, 9, 9}),
        rasterize_polygon(circle(9, {4, 4}, 3), {20, 20, 9, 9}), rasterize_polygon(circle(9, {4, 4}, 3), {})}) {
    EXPECT_TRUE(mask.empty());
    EXPECT_EQ(mask, Mask());
    EXPECT_EQ(mask.bounds(), Rect());
    EXPECT_FALSE(mask.contains(0, 0));
  }
}

TEST(MaskTest, SortsAndMergesRuns) {
  const Mask mask({{1, 5, 8}, {0, 3, 4}, {1, 8, 9}, {1, 0, 2}, {1, 6, 7}, {2, 9, 9}});
  EXPECT_EQ(mask.runs(), (std::vector<Mask::Run>{{0, 3, 4}, {1, 0, 2}, {1, 5, 9}}));
  EXPECT_EQ(mask.bounds(), (Rect{0, 0, 9, 2}));
  EXPECT_EQ(mask.count(), 7);
}

TEST(MaskTest, OperationsActOnPixels) {
  std::mt19937 random(51);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Mask::Run> runs = random_runs(random, round % 40, 8);
    Pixels pixels, moved, swollen, cut;
    for (const Mask::Run& run : runs)
      for (int x = run.x0; x < run.x1; ++x)
        pixels.insert({x, run.y});
    const Rect window{-3 + round % 4, -4, 6, round % 9};
    for (const auto& [x, y] : pixels) {
      moved.insert({x + 3, y - 7});
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          swollen.insert({x + dx, y + dy});
      if (window.contains(x, y)) cut.insert({x, y});
    }
    const Mask mask(runs);
    for (const auto& [result, expected] : {std::pair{mask, pixels},
                                           {translated(mask, 3, -7), moved},
                                           {grown(mask), swollen},
                                           {intersect(mask, window), cut}}) {
      expect_tidy(result);
      ASSERT_EQ(pixels_of(result), expected) << "round " << round;
    }
    for (int y = -9; y < 9; ++y)
      for (int x = -9; x < 14; ++x)
        ASSERT_EQ(mask.contains(x, y), pixels.contains({x, y}));
  }
}

TEST(MaskTest, GrowingTakesNoRoomForTheBox) {
  const Mask far({{-1'000'000'000, -1'000'000'000, -999'999'999}, {1'000'000'000, 1'000'000'000, 1'000'000'001}});
  EXPECT_EQ(grown(far).count(), 18);
  EXPECT_EQ(grown(far).runs().size(), 6u);
}

TEST(RasterizeTest, PolygonsBeyondTheLimitAreABug) {
  const Rect clip{0, 0, 10, 10};
  EXPECT_THROW(static_cast<void>(rasterize_polygon({{0, 0}, {kMaskCoordinateLimit, 0}, {0, 5}}, clip)), BugError);
  EXPECT_THROW(static_cast<void>(rasterize_polygon({{0, 0}, {5, -kMaskCoordinateLimit}, {0, 5}}, clip)), BugError);
  EXPECT_THROW(static_cast<void>(rasterize_polygon({{0, 0}, {std::nan(""), 0}, {0, 5}}, clip)), BugError);
}

TEST(RasterizeTest, CentresOnEdgesBelongRightAndBelow) {
  const Rect clip{-10, -10, 40, 40};
  EXPECT_EQ(rasterize_polygon({{0.5, 0.5}, {3.5, 0.5}, {3.5, 2.5}, {0.5, 2.5}}, clip).runs(),
            (std::vector<Mask::Run>{{0, 0, 3}, {1, 0, 3}}));
  EXPECT_EQ(rasterize_polygon({{0, 0}, {3, 0}, {3, 2}, {0, 2}}, clip).runs(),
            (std::vector<Mask::Run>{{0, 0, 3}, {1, 0, 3}}));
  EXPECT_EQ(rasterize_polygon({{-0.49, -0.49}, {0.49, -0.49}, {0.49, 0.49}, {-0.49, 0.49}}, clip).count(), 0);
}

TEST(RasterizeTest, NonzeroWindingFillsWhatIsGoneRoundTwice) {
  // Twice round the outer square the same way: even-odd would leave it empty.
  Points twice{{1, 1}, {6, 1}, {6, 6}, {1, 6}, {1, 1}, {6, 1}, {6, 6}, {1, 6}};
  EXPECT_EQ(rasterize_polygon(twice, {0, 0, 9, 9}).count(), 25);
  // The second time round the other way: nothing is left.
  std::reverse(twice.begin() + 4, twice.end());
  EXPECT_EQ(rasterize_polygon({{1, 1}, {6, 1}, {6, 6}, {1, 6}, {1, 1}, {1, 6}, {6, 6}, {6, 1}}, {0, 0, 9, 9}).count(),
            0);
}

TEST(RasterizeTest, AgreesWithTheExactInsideTestOfEveryPixel) {
  std::mt19937 random(52);
  for (int round = 0; round < 300; ++round) {
    Points polygon;
    for (int i = 0; i < 3 + round % 12; ++i) {
      const Point p = random_point(random, -20, 20);
      // On the grid of the fixed point, so that its rounding changes nothing; often through centres of pixels.
      const double grid = round % 3 == 0 ? 2 : round % 3 == 1 ? 4 : 65536;
      polygon.push_back({std::round(p.x * grid) / grid, std::round(p.y * grid) / grid});
    }
    const Rect clip{-15, -17, 30, 32};
    const Mask mask = rasterize_polygon(polygon, clip);
    expect_tidy(mask);
    for (int y = -22; y < 22; ++y)
      for (int x = -22; x < 22; ++x)
        ASSERT_EQ(mask.contains(x, y), clip.contains(x, y) && contains(polygon, {x + 0.5, y + 0.5}))
            << "round " << round << " at " << x << ", " << y;
  }
}

TEST(RasterizeTest, PolygonsThatShareEdgesTileWithoutGapOrOverlap) {
  std::mt19937 random(53);
  for (int round = 0; round < 50; ++round) {
    const Points rim = blob(random, 30, {50, 50}, 40, 0.3);
    const Rect clip{0, 0, 100, 100};
    std::int64_t sum = 0;
    std::vector<Mask::Run> all;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const Mask part = rasterize_polygon({{50.1, 49.7}, rim[i], rim[(i + 1) % rim.size()]}, clip);
      sum += part.count();
      all.insert(all.end(), part.runs().begin(), part.runs().end());
    }
    const Mask whole = rasterize_polygon(rim, clip);
    EXPECT_EQ(sum, whole.count());
    EXPECT_EQ(Mask(all), whole);
  }
}

TEST(RasterizeTest, MovesWithItsPolygonAndKeepsToAnyClip) {
  std::mt19937 random(54);
  const Points polygon = blob(random, 200, {500, 400}, 300, 0.4);
  const Rect whole{0, 0, 1000, 1000};
  const Mask mask = rasterize_polygon(polygon, whole);
  EXPECT_NEAR(static_cast<double>(mask.count()), signed_area(polygon), 0.5 * perimeter(polygon));
  for (const auto& [dx, dy] : {std::pair{-900'000, 17}, {3, -800'000}, {500'000, 500'000}}) {
    Points moved = polygon;
    for (Point& p : moved)
      p += Point{static_cast<double>(dx), static_cast<double>(dy)};
    EXPECT_EQ(rasterize_polygon(moved, translated(whole, dx, dy)), translated(mask, dx, dy));
  }
  const Points back(polygon.rbegin(), polygon.rend());
  EXPECT_EQ(rasterize_polygon(back, whole), mask);
  const Rect window{321, 234, 150, 3};
  EXPECT_EQ(rasterize_polygon(polygon, window), intersect(mask, window));
}

TEST(RasterizeTest, LongEdgesStayExact) {
  // A sliver across the whole range of coordinates, clipped to its far end.
  const double far = kMaskCoordinateLimit - 1;
  const Points sliver{{-far, -far + 0.25}, {far, far - 3}, {far, far}};
  const Rect clip{(1 << 20) - 60, (1 << 20) - 60, 60, 60};
  const Mask mask = rasterize_polygon(sliver, clip);
  EXPECT_GT(mask.count(), 0);
  for (int y = clip.y; y < clip.bottom(); ++y)
    for (int x = clip.x; x < clip.right(); ++x)
      ASSERT_EQ(mask.contains(x, y), contains(sliver, {x + 0.5, y + 0.5}));
}

} // namespace
} // namespace oversketch
