#include "ui/canvas/move_tool.h"

#include "tests/unit/ui/hand.h"

#include <limits>

namespace oversketch {
namespace {

using namespace testing;

TEST(MoveTool, takes_no_harm_from_nonsense) {
  MoveTool tool;
  Hand hand(tool, {}, Side::kTarget);
  hand.drag({{5, 5}, {50, 50}});
  hand.key(Key::kLeft);
  hand.key(Key::kEscape);
  hand.release({1, 1});
  hand.snapshot.document = one_layer(false);
  hand.drag({{5, 5}, {50, 50}});
  hand.lose_focus();
  expect_no_change(hand.take());
  EXPECT_FALSE(tool.busy());
  hand.snapshot.document = one_layer();
  hand.press({80, 80});
  hand.move({1e30, 1e30});
  hand.move({std::numeric_limits<double>::quiet_NaN(), 0});
  hand.key(Key::kEscape);
  expect_no_change(hand.take());
}

TEST(MoveTool, moves_by_whole_pixels_from_where_the_gesture_began) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.drag({{80, 80}, {85.2, 81}, {90.7, 76.4}, {120.4, 92.6}});
  const auto actions = hand.take();
  const auto move = committed<LayerMove>(actions);
  EXPECT_EQ(move.by, (WholeOffset{40, 13}));
  EXPECT_EQ(all_of<action::Preview>(actions).size(), 3U);
}

TEST(MoveTool, shift_keeps_to_an_axis) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.modifiers.shift = true;
  hand.drag({{80, 80}, {100, 88}});
  EXPECT_EQ(committed<LayerMove>(hand.take()).by, (WholeOffset{20, 0}));
}

TEST(MoveTool, there_and_back_is_no_step) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.drag({{80, 80}, {100, 88}, {80, 80}});
  expect_no_change(hand.take());
  hand.click({80, 80});
  EXPECT_TRUE(hand.take().empty());
}

TEST(MoveTool, outside_the_frame_turns_about_its_middle) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.drag(arc({80, 80}, 90, 0, 250, 50));
  const auto turn = committed<LayerTransform>(hand.take());
  EXPECT_NEAR(turn.rotate_deg, 250 - 360, 1e-6);
  EXPECT_EQ(turn.scale, 1);
  EXPECT_LT(distance(*turn.about, {80, 80}), 1e-9);
  hand.modifiers.shift = true;
  hand.drag(arc({80, 80}, 90, 0, 41, 20));
  EXPECT_EQ(committed<LayerTransform>(hand.take()).rotate_deg, 45);
}

TEST(MoveTool, corners_scale) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.drag({{120, 120}, {130, 130}, {140, 140}});
  const auto scale = committed<LayerTransform>(hand.take());
  EXPECT_NEAR(scale.scale, 1.5, 1e-9);
  EXPECT_EQ(scale.rotate_deg, 0);
  hand.modifiers.shift = true;
  hand.drag({{120, 120}, {130, 130}, {140.9, 140.9}});
  EXPECT_NEAR(committed<LayerTransform>(hand.take()).scale, 1.5, 1e-9) << "steps of 5 %";
}

TEST(MoveTool, a_part_smaller_than_its_corners_can_be_moved) {
  MoveTool tool;
  Document document = one_layer();
  document.layers[0].placement = make_placement(Similarity{0.05, {80, 80}});
  Hand hand(tool, document, Side::kTarget);
  const LayerFrame frame = *frame_of(document.layers[0]);
  const Point middle = 0.5 * (frame[0] + frame[2]);
  ASSERT_LT(distance(frame[0], frame[2]), 9);
  hand.drag({middle, middle + Point{10, 0}, middle + Point{30, 20}});
  EXPECT_EQ(committed<LayerMove>(hand.take()).by, (WholeOffset{30, 20}));
  // From beside it, it is scaled as ever.
  const Point beside = frame[2] + 0.5 * (frame[2] - frame[0]);
  hand.drag({beside, beside + Point{10, 10}, beside + Point{20, 20}});
  EXPECT_GT(committed<LayerTransform>(hand.take()).scale, 1);
}

TEST(MoveTool, the_frame_turns_and_scales_with_the_layer) {
  const Document before = one_layer();
  const auto frame = frame_of(before.layers.front());
  const Document after = applied(before, LayerTransform{{}, 90, 2, Point{80, 80}});
  const auto turned_frame = frame_of(after.layers.front());
  ASSERT_TRUE(frame && turned_frame);
  for (std::size_t i = 0; i < 4; ++i) {
    const Point arm = (*frame)[i] - Point{80, 80};
    EXPECT_LT(distance((*turned_frame)[i], Point{80, 80} + 2 * turned(arm)), 1e-9);
  }
  EXPECT_FALSE(frame_of(one_layer(false).layers.front()));
}

TEST(MoveTool, arrows_nudge_and_holding_one_is_one_step) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.key(Key::kRight);
  EXPECT_EQ(committed<LayerMove>(hand.take()).by, (WholeOffset{1, 0}));
  hand.send({.kind = InputEvent::Kind::kKeyDown, .key = Key::kUp});
  hand.send({.kind = InputEvent::Kind::kKeyRepeat, .key = Key::kUp});
  hand.modifiers.shift = true;
  hand.send({.kind = InputEvent::Kind::kKeyRepeat, .key = Key::kUp});
  hand.send({.kind = InputEvent::Kind::kKeyUp, .key = Key::kUp});
  EXPECT_EQ(committed<LayerMove>(hand.take()).by, (WholeOffset{0, -12}));
  EXPECT_FALSE(tool.busy());
}

TEST(MoveTool, a_press_on_another_layer_takes_that_one) {
  Document document = applied(one_layer(), LayerAdd{loaded_ref("b.png", plain_image(90, 90)), std::nullopt});
  document = applied(document, RegionSet{{}, blob({30, 30}, 20, 0, 32)});
  document = applied(document, LayerMove{{}, {200, 100}});
  document = applied(document, LayerSelect{LayerId{1}});
  MoveTool tool;
  Hand hand(tool, document, Side::kTarget);
  hand.move({230, 130});
  EXPECT_EQ(tool.draw(hand.context()).cursor, CursorShape::kHand);
  hand.press({230, 130});
  EXPECT_EQ(executed<LayerSelect>(hand.take()).layer, LayerId{2});
  hand.move({240, 130});
  hand.release({240, 130});
  EXPECT_EQ(committed<LayerMove>(hand.take()).layer, LayerId{2});
}

TEST(MoveTool, the_pointer_tells_what_a_drag_will_do) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  const auto pointer = [&](Point at) {
    hand.move(at);
    return tool.draw(hand.context()).cursor;
  };
  EXPECT_EQ(pointer({80, 80}), CursorShape::kMove);
  EXPECT_EQ(pointer({120, 120}), CursorShape::kResizeNwse);
  EXPECT_EQ(pointer({120, 40}), CursorShape::kResizeNesw);
  hand.move({200, 80});
  const auto marks = tool.draw(hand.context()).marks;
  EXPECT_EQ(marks.back().kind, ToolMark::Kind::kTurn);
}

TEST(MoveTool, what_is_given_up_changes_nothing) {
  MoveTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.press({80, 80});
  hand.move({100, 100});
  hand.key(Key::kEscape);
  hand.release({100, 100});
  expect_no_change(hand.take());
  hand.press({80, 80});
  hand.move({100, 100});
  hand.lose_focus();
  expect_no_change(hand.take());
  EXPECT_FALSE(tool.busy());
}

} // namespace
} // namespace oversketch
