#include "ui/canvas/view.h"

#include "core/base/check.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

void expect_same(Point a, Point b) {
  EXPECT_NEAR(a.x, b.x, 1e-9);
  EXPECT_NEAR(a.y, b.y, 1e-9);
}

TEST(View, does_not_fit_nothing) {
  EXPECT_THROW(fitted({0, 10}, {100, 100}), BugError);
  EXPECT_THROW(fitted({10, 10}, {100, -1}), BugError);
}

TEST(View, goes_to_the_canvas_and_back) {
  const View view{{12.5, -7}, 3.25};
  expect_same(view.to_picture(view.to_canvas({100.5, 33})), {100.5, 33});
  expect_same(view.to_canvas(view.origin), {0, 0});
}

TEST(View, panning_takes_what_is_under_the_pointer_along) {
  const View view{{5, 6}, 0.5};
  const Point grabbed = view.to_picture({40, 50});
  expect_same(panned(view, {13, -9}).to_canvas(grabbed), {53, 41});
}

TEST(View, zooming_keeps_what_is_under_the_pointer_and_its_limits) {
  View view{{5, 6}, 1};
  const Point under = view.to_picture({300, 200});
  for (const double factor : {1.25, 8.0, 1000.0, 0.001, 1e-9}) {
    view = zoomed(view, {300, 200}, factor);
    expect_same(view.to_canvas(under), {300, 200});
    EXPECT_GE(view.zoom, kLeastZoom);
    EXPECT_LE(view.zoom, kMostZoom);
  }
}

TEST(View, a_fitted_picture_is_whole_and_in_the_middle) {
  const View view = fitted({1440, 1080}, {640, 700});
  expect_same(view.to_canvas({720, 540}), {320, 350});
  EXPECT_NEAR(view.to_canvas({0, 0}).x, 16, 1e-9);
  EXPECT_GT(view.to_canvas({0, 0}).y, 16);
  EXPECT_EQ(fitted({320, 100}, {672, 700}).zoom, 2) << "a small picture fills its canvas too";
  EXPECT_EQ(fitted({20, 20}, {640, 700}).zoom, kMostFit) << "within reason";
  EXPECT_GT(fitted({20, 20}, {10, 10}).zoom, 0);
}

} // namespace
} // namespace oversketch
