#include "ui/canvas/curve_tool.h"

#include "tests/unit/ui/hand.h"

#include <limits>

namespace oversketch {
namespace {

using namespace testing;

TEST(CurveTool, takes_no_harm_from_nonsense) {
  for (const Side side : {Side::kSource, Side::kTarget}) {
    CurveTool tool(side);
    Hand hand(tool, {}, side);
    hand.release({5, 5});
    hand.key(Key::kEnter);
    hand.key(Key::kBackspace);
    hand.key(Key::kEscape);
    hand.press({5, 5});
    hand.move({1e300, std::numeric_limits<double>::quiet_NaN()});
    hand.release({std::numeric_limits<double>::infinity(), 0});
    hand.lose_focus();
    expect_no_change(hand.take());
    EXPECT_FALSE(tool.busy());

    hand.snapshot.document = one_layer();
    hand.press({5, 5}, MouseButton::kMiddle);
    hand.release({5, 5}, MouseButton::kRight);
    hand.drag({{-500, -500}, {-600, -700}});
    hand.drag({{20, 20}, {std::numeric_limits<double>::quiet_NaN(), 3}, {20, 20}});
    hand.key(Key::kEscape);
    expect_no_change(hand.take());
    EXPECT_FALSE(tool.busy());
  }
}

TEST(CurveTool, outlines_freehand) {
  CurveTool tool(Side::kSource);
  Hand hand(tool, one_layer(false), Side::kSource);
  hand.drag(arc({80, 80}, 40, 0, 330));
  const auto set = executed<RegionSet>(hand.take());
  EXPECT_EQ(set.layer, hand.snapshot.document.selected);
  EXPECT_GT(set.outline.size(), 12U);
  EXPECT_LT(set.outline.size(), 61U) << "what no eye sees is left out";
  EXPECT_EQ(refusal(hand.snapshot.document, set), "accepted");
}

TEST(CurveTool, an_outline_never_leaves_its_picture) {
  CurveTool tool(Side::kSource);
  Hand hand(tool, one_layer(false), Side::kSource);
  hand.drag(arc({190, 80}, 40, 0, 350));
  EXPECT_EQ(refusal(hand.snapshot.document, executed<RegionSet>(hand.take())), "accepted");
  hand.drag(arc({400, 80}, 40, 0, 350));
  const auto actions = hand.take();
  expect_no_change(actions);
  EXPECT_EQ(all_of<action::Say>(actions).size(), 1U);
}

TEST(CurveTool, redraws_a_part_of_the_outline) {
  CurveTool tool(Side::kSource);
  Hand hand(tool, one_layer(), Side::kSource);
  hand.drag(arc({80, 80}, 46, -60, 60));
  const auto edit = executed<RegionEdit>(hand.take());
  EXPECT_EQ(edit.tolerance_px, 10);
  EXPECT_FALSE(edit.sharp);
}

TEST(CurveTool, a_sketch_is_previewed_while_it_is_drawn_and_is_one_step) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.drag(arc({80, 80}, 46, -60, 60));
  const auto actions = hand.take();
  const auto edit = committed<SketchEdit>(actions);
  EXPECT_EQ(refusal(hand.snapshot.document, edit), "accepted");
  const auto previews = all_of<action::Preview>(actions);
  EXPECT_GT(previews.size(), 1U);
  for (const auto& preview : previews)
    EXPECT_EQ(refusal(hand.snapshot.document, preview.command), "accepted");
}

TEST(CurveTool, a_whole_new_sketch) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.drag(arc({200, 100}, 35, 0, 345));
  const auto actions = hand.take();
  const auto set = committed<SketchSet>(actions);
  EXPECT_NEAR(bounds(set.curve).centre().x, 200, 3);
}

TEST(CurveTool, x_and_alt_count_at_release) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kTarget);
  const Points way = arc({80, 80}, 46, -85, 85);
  hand.press(way.front());
  for (const Point p : way)
    hand.move(p);
  hand.key(key_of('X'));
  hand.key(key_of('X'));
  hand.modifiers.alt = true;
  hand.release(way.back());
  const auto edit = committed<SketchEdit>(hand.take());
  EXPECT_TRUE(edit.sharp);
  EXPECT_EQ(edit.side, StrokeSide::kAuto) << "flipped twice";

  hand.modifiers = {};
  hand.press(way.front());
  for (const Point p : way)
    hand.move(p);
  hand.key(key_of('X'));
  EXPECT_LT(bounds(tool.draw(hand.context()).lines.front().points).low.x, 60) << "the ghost is on the other side";
  hand.release(way.back());
  const auto actions = hand.take();
  if (!all_of<action::Commit>(actions).empty()) {
    EXPECT_EQ(committed<SketchEdit>(actions).side, StrokeSide::kOther);
  }
}

TEST(CurveTool, tolerance_is_in_screen_pixels) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.target_view.zoom = 4;
  hand.drag(arc({80, 80}, 50, -60, 60));
  auto actions = hand.take();
  expect_no_change(actions);
  EXPECT_EQ(all_of<action::Say>(actions).size(), 1U) << "10 px away is 40 px on the screen";
  hand.preferences.tolerance_px = 60;
  hand.drag(arc({80, 80}, 50, -60, 60));
  EXPECT_EQ(committed<SketchEdit>(hand.take()).tolerance_px, 15);
}

TEST(CurveTool, what_is_given_up_changes_nothing) {
  using Give = void (*)(Hand&);
  const Give ways[] = {[](Hand& hand) { hand.key(Key::kEscape); }, [](Hand& hand) { hand.lose_focus(); },
                       [](Hand& hand) {
                         hand.press({90, 90}, MouseButton::kRight);
                       }};
  for (const Give give : ways) {
    CurveTool tool(Side::kTarget);
    Hand hand(tool, one_layer(), Side::kTarget);
    const Points way = arc({80, 80}, 46, -60, 60);
    hand.press(way.front());
    for (const Point p : way)
      hand.move(p);
    EXPECT_TRUE(tool.busy());
    give(hand);
    EXPECT_FALSE(tool.busy());
    hand.release(way.back());
    expect_no_change(hand.take());
  }
}

TEST(CurveTool, a_stroke_that_would_cross_the_curve_says_so) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kTarget);
  // From the right side out, through the left side and back: whatever it replaces, it crosses what is kept.
  hand.drag({{120, 80}, {150, 30}, {20, 30}, {20, 80}, {140, 90}, {140, 60}, {100, 60}, {80, 119}});
  const auto actions = hand.take();
  if (all_of<action::Commit>(actions).empty()) {
    expect_no_change(actions);
    EXPECT_EQ(all_of<action::Say>(actions).size(), 1U);
  }
}

TEST(CurveTool, straight_lines_by_clicks) {
  CurveTool tool(Side::kSource);
  Hand hand(tool, one_layer(false), Side::kSource);
  for (const Point p : {Point{20, 20}, Point{120, 20}, Point{120, 100}, Point{60, 150}})
    hand.click(p);
  EXPECT_TRUE(tool.busy());
  EXPECT_TRUE(hand.take().empty());
  hand.key(Key::kBackspace);
  hand.key(Key::kEnter);
  EXPECT_EQ(executed<RegionSet>(hand.take()).outline, (Points{{20, 20}, {120, 20}, {120, 100}}));

  for (const Point p : {Point{20, 20}, Point{120, 20}, Point{120, 100}, Point{22, 21}})
    hand.click(p);
  EXPECT_EQ(executed<RegionSet>(hand.take()).outline.size(), 3U) << "a click on the first corner closes";

  for (const Point p : {Point{20, 20}, Point{120, 20}})
    hand.click(p);
  hand.press({60, 90});
  hand.release({60, 90});
  hand.press({60, 90});
  hand.release({60, 90});
  EXPECT_EQ(executed<RegionSet>(hand.take()).outline.size(), 3U) << "so does a double click";
  EXPECT_FALSE(tool.busy());
}

TEST(CurveTool, straight_lines_redraw_a_part_too) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kTarget);
  for (const Point p : {Point{110, 50}, Point{140, 80}, Point{110, 110}})
    hand.click(p);
  hand.key(Key::kEnter);
  EXPECT_EQ(executed<SketchEdit>(hand.take()).stroke, (Points{{110, 50}, {140, 80}, {110, 110}}));
}

TEST(CurveTool, a_click_gone_astray_does_not_spoil_the_next_stroke) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.click({10, 10});
  hand.drag(arc({80, 80}, 46, -60, 60));
  EXPECT_GT(committed<SketchEdit>(hand.take()).stroke.front().x, 50);
}

TEST(CurveTool, shows_where_a_stroke_closes_and_what_it_replaces) {
  CurveTool outline(Side::kSource);
  Hand hand(outline, one_layer(false), Side::kSource);
  const Points way = arc({80, 80}, 40, 0, 300);
  hand.press(way.front());
  for (const Point p : way)
    hand.move(p);
  ASSERT_EQ(outline.draw(hand.context()).marks.size(), 1U);
  EXPECT_EQ(outline.draw(hand.context()).marks.front().kind, ToolMark::Kind::kClose);
  EXPECT_EQ(outline.draw(hand.context()).marks.front().at, way.front());

  CurveTool sketch(Side::kTarget);
  Hand second(sketch, one_layer(), Side::kTarget);
  second.press(arc({80, 80}, 42, -60, 60).front());
  for (const Point p : arc({80, 80}, 42, -60, 20))
    second.move(p);
  EXPECT_EQ(sketch.draw(second.context()).lines.front().kind, ToolLine::Kind::kGhost);
}

TEST(CurveTool, says_where_it_draws) {
  CurveTool tool(Side::kTarget);
  Hand hand(tool, one_layer(), Side::kSource);
  hand.drag(arc({80, 80}, 46, -60, 60));
  const auto actions = hand.take();
  expect_no_change(actions);
  EXPECT_EQ(all_of<action::Say>(actions).size(), 1U);
}

} // namespace
} // namespace oversketch
