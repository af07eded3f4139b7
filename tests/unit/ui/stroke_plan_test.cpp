#include "ui/canvas/stroke_plan.h"

#include "core/geometry/curve.h"
#include "tests/unit/ui/hand.h"

namespace oversketch {
namespace {

using namespace testing;

const Layer& layer_of(const Document& document) {
  return document.layers.front();
}

TEST(StrokePlan, says_why_a_stroke_means_nothing) {
  const Document document = one_layer(), bare = one_layer(false);
  EXPECT_FALSE(plan_stroke(layer_of(document), {}, {}).command);
  EXPECT_NE(plan_stroke(layer_of(document), {{3, 4}}, {}).why_not, "");
  EXPECT_NE(plan_stroke(layer_of(bare), {{3, 4}, {9, 9}}, {}).why_not, "") << "a sketch of no region";
  const StrokePlan far = plan_stroke(layer_of(document), {{200, 20}, {250, 20}}, {});
  EXPECT_FALSE(far.command);
  EXPECT_NE(far.why_not, "");
  const StrokePlan line = plan_stroke(layer_of(bare), {{10, 10}, {50, 50}}, {.side = Side::kSource});
  EXPECT_FALSE(line.command) << "nothing lies inside a line";
  EXPECT_NE(line.why_not, "");
}

TEST(StrokePlan, the_first_outline_closes_from_anywhere) {
  const Document document = one_layer(false);
  const StrokePlan plan = plan_stroke(layer_of(document), arc({80, 80}, 40, 0, 200), {.side = Side::kSource});
  ASSERT_TRUE(plan.command);
  EXPECT_TRUE(plan.closes);
  EXPECT_TRUE(std::holds_alternative<RegionSet>(*plan.command));
}

TEST(StrokePlan, near_ends_redraw_the_part_between) {
  const Document document = one_layer();
  const StrokePlan plan = plan_stroke(layer_of(document), arc({80, 80}, 46, -60, 60), {});
  ASSERT_TRUE(plan.command);
  const SketchEdit& edit = std::get<SketchEdit>(*plan.command);
  EXPECT_EQ(edit.layer, document.selected);
  EXPECT_EQ(edit.side, StrokeSide::kAuto);
  ASSERT_FALSE(plan.ghost.empty());
  for (const Point p : plan.ghost)
    EXPECT_GT(p.x, 90) << "the part on the right";
  const StrokePlan other = plan_stroke(layer_of(document), arc({80, 80}, 46, -60, 60), {.other_side = true});
  EXPECT_LT(bounds(other.ghost.empty() ? Points{{0, 0}} : other.ghost).low.x, 60);
}

TEST(StrokePlan, a_stroke_that_closes_itself_away_from_the_curve_is_a_new_one) {
  const Document document = one_layer();
  const StrokePlan plan = plan_stroke(layer_of(document), arc({200, 100}, 30, 0, 340), {});
  ASSERT_TRUE(plan.command);
  EXPECT_TRUE(std::holds_alternative<SketchSet>(*plan.command));
  const StrokePlan open = plan_stroke(layer_of(document), arc({200, 100}, 30, 0, 200), {});
  EXPECT_FALSE(open.command);
  EXPECT_TRUE(plan_stroke(layer_of(document), arc({200, 100}, 30, 0, 200), {.close = true}).command);
}

TEST(StrokePlan, loose_ends_are_cut_where_they_cross_or_come_nearest) {
  Points crossing = arc({0, 0}, 50, 0, 350);
  crossing.insert(crossing.begin(), {49, -30});
  crossing.push_back({60, 4});
  const Points loop = close_line(crossing, 30);
  EXPECT_FALSE(find_self_crossing(loop, true));
  EXPECT_LT(loop.size(), crossing.size());
  const Points past = close_line(arc({0, 0}, 50, 0, 375), 30);
  EXPECT_FALSE(find_self_crossing(past, true));
  EXPECT_NEAR(perimeter(past), 2 * std::numbers::pi * 50, 2);
  // An eight is not a loop with loose ends.
  Points eight = arc({0, 0}, 50, 0, 350);
  for (const Point p : arc({100, 0}, 50, 180, -170))
    eight.push_back(p);
  EXPECT_EQ(close_line(eight, 10).size(), eight.size());
}

TEST(StrokePlan, the_ghost_is_foreseen_while_the_pen_is_on_its_way) {
  const Document document = one_layer();
  EXPECT_TRUE(forecast_ghost(layer_of(document), arc({80, 80}, 80, -60, 0), {}).empty()) << "does not begin near";
  Points half = arc({80, 80}, 40, -60, -55, 3);
  half.push_back({160, 60});
  EXPECT_FALSE(forecast_ghost(layer_of(document), half, {}).empty());
}

TEST(ClampToPicture, leaves_what_lies_inside_and_drops_what_lies_outside) {
  const Points inside{{1, 1}, {50, 60}, {99, 2}};
  EXPECT_EQ(clamp_to_picture(inside, {100, 80}, true), inside);
  EXPECT_TRUE(clamp_to_picture({{-5, -5}, {-9, 40}}, {100, 80}, true).empty());
  EXPECT_TRUE(clamp_to_picture({{-5, -5}}, {100, 80}, false).empty());
  EXPECT_TRUE(clamp_to_picture({}, {100, 80}, false).empty());
}

TEST(ClampToPicture, goes_along_the_edge_the_shorter_way) {
  const Points line = clamp_to_picture({{90, 10}, {110, 20}, {130, 60}, {90, 70}}, {100, 80}, false);
  for (const Point p : line) {
    EXPECT_LE(p.x, 100);
    EXPECT_GE(p.x, 90);
  }
  EXPECT_FALSE(find_self_crossing(line, false));
  // Round a corner: the corner is on the way.
  const Points corner = clamp_to_picture({{90, 40}, {120, 40}, {120, -20}, {50, -20}, {50, 40}}, {100, 80}, false);
  EXPECT_NE(std::find(corner.begin(), corner.end(), Point{100, 0}), corner.end());
  EXPECT_EQ(std::find(corner.begin(), corner.end(), Point{0, 0}), corner.end());
}

TEST(ClampToPicture, closes_round_a_corner_when_both_ends_are_outside) {
  const Points open{{-10, 40}, {50, 40}, {50, -10}};
  const Points closed = clamp_to_picture(open, {100, 80}, true);
  EXPECT_NE(std::find(closed.begin(), closed.end(), Point{0, 0}), closed.end());
  EXPECT_NEAR(std::abs(signed_area(closed)), 50 * 40, 1e-9);
}

} // namespace
} // namespace oversketch
