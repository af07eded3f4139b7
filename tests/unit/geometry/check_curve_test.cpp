#include "core/geometry/curve.h"
#include "core/geometry/mask.h"
#include "tests/unit/geometry/shapes.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

using testing::circle;

Error error_of(const Points& points, double least_area = 1.0) {
  const Result<Points> checked = check_closed_curve(points, "outline", least_area);
  return checked ? Error{"none", "", ""} : checked.error();
}

TEST(CheckClosedCurveTest, EveryFaultHasItsCodeAndPlace) {
  EXPECT_EQ(error_of({}).code, "curve.too-few-points");
  EXPECT_EQ(error_of({{1, 1}}).code, "curve.too-few-points");
  EXPECT_EQ(error_of({{1, 1}, {2, 2}}).code, "curve.too-few-points");
  EXPECT_EQ(error_of({{1, 1}, {1, 1}, {9, 9}, {9, 9}}).code, "curve.too-few-points");
  EXPECT_EQ(error_of({{0, 0}, {9, 0}, {0, 0}, {9, 0}}).code, "curve.too-few-points");

  EXPECT_EQ(error_of({{0, 0}, {9, 0}, {9, std::nan("")}}).code, "curve.not-finite");
  EXPECT_EQ(error_of({{0, 0}, {9, 0}, {9, std::nan("")}}).where, "outline point 2");
  EXPECT_EQ(error_of({{0, 0}, {HUGE_VAL, 0}, {9, 9}}).code, "curve.not-finite");

  EXPECT_EQ(error_of({{0, 0}, {kMaskCoordinateLimit, 0}, {9, 9}}).code, "curve.too-far");
  EXPECT_EQ(error_of({{0, 0}, {9, 0}, {9, -kMaskCoordinateLimit}}).where, "outline point 2");
  EXPECT_EQ(error_of({{0, 0}, {std::nextafter(kMaskCoordinateLimit, 0), 0}, {9, 9}}).code, "none");

  EXPECT_EQ(error_of({{0, 0}, {9, 9}, {4, 4}}).code, "curve.no-area") << "all on one line";
  EXPECT_EQ(error_of({{0, 0}, {1, 0}, {1, 1}}).code, "curve.no-area");
  EXPECT_EQ(error_of({{0, 0}, {1, 0}, {1, 1}}, 0.5).code, "none");
  EXPECT_EQ(error_of({{0, 0}, {9, 9}, {4, 4}}, 0).code, "curve.no-area");

  const Error crossing = error_of({{0, 0}, {0, 0}, {10, 10}, {10, 0}, {0, 10}});
  EXPECT_EQ(crossing.code, "curve.crosses-itself") << "though the area of a bow tie is 0";
  EXPECT_EQ(crossing.where, "outline point 1");
  EXPECT_EQ(crossing.sentence, "the outline crosses itself at (5.0, 5.0): draw it without crossings");
}

TEST(CheckClosedCurveTest, NamesWhatWasDrawn) {
  const auto checked = check_closed_curve({}, "sketch");
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.error().sentence, "the sketch has 0 different points: draw a line round an area");
  EXPECT_EQ(checked.error().where, "sketch");
}

TEST(CheckClosedCurveTest, OnlyExactRepeatsAreDropped) {
  const Points good = circle(40, {50, 50}, 20);
  EXPECT_EQ(check_closed_curve(good, "outline").value(), good);
  const Points back(good.rbegin(), good.rend());
  EXPECT_EQ(check_closed_curve(back, "outline").value(), back) << "either way round";
  Points closed = good;
  closed.insert(closed.begin() + 7, closed[7]);
  closed.push_back(closed.front());
  EXPECT_EQ(check_closed_curve(closed, "outline").value(), good);
  Points close = good;
  close.insert(close.begin() + 7, lerp(close[6], close[7], 1 - 1e-9));
  EXPECT_EQ(check_closed_curve(close, "outline").value(), close);
}

} // namespace
} // namespace oversketch
