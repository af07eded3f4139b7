#include "core/geometry/curve.h"

#include "core/geometry/segment_tree.h"
#include "tests/unit/geometry/shapes.h"

#include <gtest/gtest.h>

#include <limits>

namespace oversketch {
namespace {

using testing::blob;
using testing::circle;
using testing::random_point;

const Points kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

void expect_near(Point a, Point b, double tolerance) {
  EXPECT_LE(distance(a, b), tolerance) << a.x << ", " << a.y;
}

TEST(ClosedCurveTest, WhatIsNoCurveIsABug) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ClosedCurve(Points{}), BugError);
  EXPECT_THROW(ClosedCurve({{1, 1}}), BugError);
  EXPECT_THROW(ClosedCurve({{1, 1}, {1, 1}, {1, 1}}), BugError);
  EXPECT_THROW(ClosedCurve({{0, 0}, {nan, 1}, {2, 0}}), BugError);
  EXPECT_THROW(ClosedCurve({{0, 0}, {1, HUGE_VAL}, {2, 0}}), BugError);
  const ClosedCurve curve(kSquare);
  EXPECT_THROW(static_cast<void>(curve.at(nan)), BugError);
  EXPECT_THROW(static_cast<void>(curve.at(HUGE_VAL)), BugError);
  EXPECT_THROW(static_cast<void>(curve.s_at(-1)), BugError);
  EXPECT_THROW(static_cast<void>(curve.s_at(4)), BugError);
  EXPECT_THROW(static_cast<void>(curve.nearest({nan, 0})), BugError);
  EXPECT_THROW(static_cast<void>(resample(curve, 2)), BugError);
}

TEST(ClosedCurveTest, MeasuresASquare) {
  const ClosedCurve curve(kSquare);
  EXPECT_EQ(curve.size(), 4);
  EXPECT_EQ(curve.length(), 40);
  EXPECT_EQ(curve.signed_area(), 100);
  EXPECT_EQ(curve.points(), kSquare);
  EXPECT_EQ(curve.s_at(3), 30);
  EXPECT_EQ(curve.at(5), (Point{5, 0}));
  EXPECT_EQ(curve.at(35), (Point{0, 5}));
  EXPECT_EQ(curve.at(-5), (Point{0, 5}));
  EXPECT_EQ(curve.at(40), (Point{0, 0}));
  EXPECT_EQ(curve.at(4015), (Point{10, 5}));
  EXPECT_EQ(curve.tangent(5), (Point{1, 0}));
  EXPECT_EQ(curve.tangent(10), (Point{0, 1}));
  EXPECT_EQ(curve.tangent(40), (Point{1, 0}));
  expect_near(curve.smooth_tangent(10, 2), Point{1, 1} / std::sqrt(2.0), 1e-15);
  EXPECT_EQ(curve.smooth_tangent(3, 20), curve.tangent(3)) << "half a length away on both sides is one point";
  EXPECT_EQ(curve.segment_at(10), 1);
  EXPECT_EQ(curve.segment_at(39.9), 3);
  EXPECT_EQ(curve.forward(35, 5), 10);
  EXPECT_EQ(curve.forward(5, 35), 30);
  EXPECT_EQ(curve.forward(7, 7), 0);
  EXPECT_EQ(curve.wrap(-0.0), 0);
  EXPECT_EQ(curve.wrap(-1e-300), 0) << "never the length itself";
}

TEST(ClosedCurveTest, PointsByArcLengthAgreeWithAWalkAlongIt) {
  std::mt19937 random(11);
  for (int round = 0; round < 20; ++round) {
    Points points;
    for (int i = 0; i < 40; ++i) {
      // Segments of very unequal length, some of none.
      points.push_back(i % 7 == 3 ? points.back() : random_point(random, 0, i % 5 == 0 ? 1000 : 1));
    }
    const ClosedCurve curve(points);
    EXPECT_NEAR(curve.length(), perimeter(points), 1e-9);
    for (int i = 0; i < curve.size(); ++i) {
      EXPECT_EQ(curve.at(curve.s_at(i)), points[static_cast<std::size_t>(i)]);
      const double s = curve.s_at(i);
      EXPECT_LE(curve.s_at(curve.segment_at(s)), s);
    }
    double walked = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point a = points[i], b = points[(i + 1) % points.size()];
      const double step = distance(a, b);
      if (step == 0) continue;
      expect_near(curve.at(walked + 0.25 * step), lerp(a, b, 0.25), 1e-9);
      expect_near(curve.tangent(walked + 0.25 * step), (b - a) / step, 1e-9);
      EXPECT_EQ(curve.segment_at(walked + 0.25 * step), static_cast<int>(i));
      walked += step;
    }
  }
}

TEST(ClosedCurveTest, NearestIsWhatTryingEverySegmentFinds) {
  std::mt19937 random(12);
  for (const int count : {2, 3, 4, 5, 16, 17, 63, 1000}) {
    Points points = blob(random, count, {300, 200}, 100, count > 16 ? 0.5 : 0);
    if (count == 63) points = Points(63, points[0]), points[40] = points[0] + Point{50, 0}, points[41] = {320, 230};
    const ClosedCurve curve(points);
    for (int query = 0; query < 2000; ++query) {
      Point p = random_point(random, 0, 600);
      if (query % 3 == 0) p = curve.at(p.x * 7) + Point{0.01 * p.y, 0};
      if (query % 50 == 1) p = points[static_cast<std::size_t>(query) % points.size()];
      if (query % 50 == 2) p = {300, 200};
      SegmentHit best;
      for (std::size_t i = 0; i < points.size(); ++i) {
        SegmentHit hit = nearest_on_segment(points[i], points[(i + 1) % points.size()], p);
        hit.segment = static_cast<int>(i);
        if (hit.squared < best.squared) best = hit;
      }
      const CurvePosition found = curve.nearest(p);
      ASSERT_EQ(found.distance, std::sqrt(best.squared)) << count << " points, query " << query;
      ASSERT_EQ(found.point, best.point);
      ASSERT_EQ(found.segment, best.segment);
      ASSERT_GE(found.s, 0);
      ASSERT_LT(found.s, curve.length());
      expect_near(curve.at(found.s), found.point, 1e-9);
    }
  }
}

TEST(ClosedCurveTest, NearestAgreesWithAFineWalk) {
  std::mt19937 random(13);
  const ClosedCurve curve(blob(random, 50, {0, 0}, 10, 0.6));
  for (int query = 0; query < 100; ++query) {
    const Point p = random_point(random, -20, 20);
    double least = HUGE_VAL;
    for (int i = 0; i < 20000; ++i)
      least = std::min(least, distance(p, curve.at(curve.length() * i / 20000)));
    EXPECT_LE(curve.nearest(p).distance, least);
    EXPECT_GE(curve.nearest(p).distance, least - curve.length() / 20000);
  }
}

TEST(ClosedCurveTest, EquallyNearPlacesGiveTheSmallerS) {
  const ClosedCurve curve(kSquare);
  EXPECT_EQ(curve.nearest({5, 5}).s, 5);
  EXPECT_EQ(curve.nearest({-3, -4}).s, 0);
  EXPECT_EQ(curve.nearest({-3, -4}).distance, 5);
  EXPECT_EQ(curve.nearest({13, -4}).s, 10);
  EXPECT_EQ(curve.nearest({-1, 5}).s, 35);
}

TEST(SegmentTreeTest, AnOpenLineHasNoClosingSegment) {
  const SegmentTree open(kSquare, false);
  EXPECT_EQ(open.segment_count(), 3);
  EXPECT_EQ(open.nearest({-1, 4}).point, (Point{0, 0}));
  EXPECT_EQ(open.nearest({-1, 6}).point, (Point{0, 10}));
  EXPECT_EQ(SegmentTree({{3, 4}}, false).nearest({0, 0}).squared, 25);
  EXPECT_THROW(SegmentTree({}, false), BugError);
}

TEST(MeasureTest, FewPointsHaveNoAreaAndNoInside) {
  EXPECT_EQ(signed_area({}), 0);
  EXPECT_EQ(signed_area({{1, 2}, {3, 4}}), 0);
  EXPECT_EQ(perimeter({}), 0);
  EXPECT_EQ(perimeter({{0, 0}, {3, 4}}), 10);
  EXPECT_EQ(path_length({{0, 0}, {3, 4}}), 5);
  EXPECT_EQ(path_length({{7, 7}}), 0);
  EXPECT_FALSE(contains({}, {0, 0}));
  EXPECT_FALSE(contains({{0, 0}}, {0, 0}));
}

TEST(MeasureTest, AreaTurnsItsSignWithTheCurveAndKeepsDigitsFarOut) {
  std::mt19937 random(14);
  Points points = blob(random, 100, {5, 5}, 3, 0.4);
  const double area = signed_area(points);
  EXPECT_GT(area, 0) << "increasing angle is clockwise on the screen";
  Points back(points.rbegin(), points.rend());
  EXPECT_NEAR(signed_area(back), -area, 1e-12);
  for (Point& p : points)
    p += Point{1 << 19, -(1 << 19)};
  EXPECT_NEAR(signed_area(points), area, 1e-8);
  EXPECT_NEAR(signed_area(circle(100'000, {3, 4}, 2)), 4 * std::numbers::pi, 1e-7);
}

TEST(ContainsTest, EdgesBelongToTheInsideOnTheirRightOrBelow) {
  EXPECT_TRUE(contains(kSquare, {0, 5}));
  EXPECT_FALSE(contains(kSquare, {10, 5}));
  EXPECT_TRUE(contains(kSquare, {5, 0}));
  EXPECT_FALSE(contains(kSquare, {5, 10}));
  EXPECT_TRUE(contains(kSquare, {0, 0}));
  EXPECT_FALSE(contains(kSquare, {10, 10}));
  EXPECT_FALSE(contains(kSquare, {-1e-300, 5}));
  const Points back(kSquare.rbegin(), kSquare.rend());
  EXPECT_TRUE(contains(back, {0, 5}));
  EXPECT_FALSE(contains(back, {10, 5}));
}

TEST(ContainsTest, AgreesWithTheSumOfAngles) {
  std::mt19937 random(15);
  const Points points = blob(random, 60, {0, 0}, 10, 0.7);
  for (int query = 0; query < 3000; ++query) {
    const Point p = random_point(random, -15, 15);
    double turn = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point a = points[i] - p, b = points[(i + 1) % points.size()] - p;
      turn += std::atan2(cross(a, b), dot(a, b));
    }
    EXPECT_EQ(contains(points, p), std::abs(turn) > 1) << p.x << ", " << p.y;
  }
}

TEST(ContainsTest, PolygonsThatShareAnEdgeShareNoPoint) {
  std::mt19937 random(16);
  // A fan of triangles round a point: whatever is in the whole is in exactly one of them.
  const Points rim = circle(7, {0.3, 0.1}, 8);
  for (int query = 0; query < 3000; ++query) {
    Point p = random_point(random, -8, 8);
    if (query % 2 == 0) p = {std::round(p.x), std::round(p.y)};
    const Point hub{1, 1};
    int inside = 0;
    for (std::size_t i = 0; i < rim.size(); ++i)
      inside += contains({hub, rim[i], rim[(i + 1) % rim.size()]}, p);
    EXPECT_EQ(inside, contains(rim, p) ? 1 : 0) << p.x << ", " << p.y;
  }
}

TEST(WithoutRepeatsTest, DropsOnlyExactRepeatsOfNeighbours) {
  EXPECT_EQ(without_repeats({}), Points{});
  EXPECT_EQ(without_repeats({{1, 1}, {1, 1}}), (Points{{1, 1}}));
  const Points tidy{{0, 0}, {1, 0}, {0, 0}, {0, 1}};
  EXPECT_EQ(without_repeats(tidy), tidy);
  EXPECT_EQ(without_repeats({{0, 0}, {0, 0}, {1, 0}, {1, 0}, {0, 0}, {0, 1}, {0, 1}, {0, 0}, {0, 0}}), tidy);
}

TEST(ResampleTest, PointsLieOnTheCurveAtEqualSteps) {
  std::mt19937 random(17);
  const ClosedCurve curve(blob(random, 80, {50, 50}, 20, 0.5));
  const Points points = resample(curve, 333);
  ASSERT_EQ(points.size(), 333u);
  EXPECT_EQ(points[0], curve.points()[0]);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(curve.nearest(points[i]).distance, 1e-12);
    EXPECT_NEAR(curve.nearest(points[i]).s, curve.length() * static_cast<double>(i) / 333, 1e-9);
  }
}

} // namespace
} // namespace oversketch
