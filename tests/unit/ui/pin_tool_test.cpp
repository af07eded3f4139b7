#include "ui/canvas/pin_tool.h"

#include "tests/unit/ui/hand.h"

namespace oversketch {
namespace {

using namespace testing;

Document with_pin() {
  return applied(one_layer(), PinAdd{{}, {120, 80}, {120, 80}});
}

TEST(PinTool, takes_no_harm_from_nonsense) {
  PinTool tool;
  Hand hand(tool, {}, Side::kSource);
  hand.click({5, 5});
  hand.key(Key::kDelete);
  hand.release({5, 5});
  hand.key(Key::kEscape);
  hand.selected_pin = PinId{9};
  hand.snapshot.document = one_layer(false);
  hand.click({5, 5});
  hand.key(Key::kDelete);
  hand.snapshot.document = one_layer();
  hand.key(Key::kDelete);
  hand.click({1e200, 0});
  hand.lose_focus();
  expect_no_change(hand.take());
  EXPECT_FALSE(tool.busy());
}

TEST(PinTool, joins_a_point_of_the_outline_with_one_of_the_sketch) {
  PinTool tool;
  Hand hand(tool, one_layer(), Side::kSource);
  hand.click({124, 81});
  EXPECT_TRUE(tool.busy());
  expect_no_change(hand.take());
  hand.on(Side::kTarget);
  hand.click({80, 118});
  const auto actions = hand.take();
  const auto add = executed<PinAdd>(actions);
  EXPECT_NEAR(distance(add.outline, {120, 80}), 1, 0.3);
  EXPECT_NEAR(distance(add.sketch, {80, 120}), 0, 0.3);
  ASSERT_EQ(all_of<action::SelectPin>(actions).size(), 1U);
  EXPECT_EQ(all_of<action::SelectPin>(actions).front().pin, PinId{1});
  EXPECT_FALSE(tool.busy());
}

TEST(PinTool, the_sketch_may_come_first_and_a_second_thought_counts) {
  PinTool tool;
  Hand hand(tool, one_layer(), Side::kTarget);
  hand.click({80, 118});
  hand.click({40, 80});
  hand.on(Side::kSource);
  hand.click({80, 40});
  const auto add = executed<PinAdd>(hand.take());
  EXPECT_NEAR(distance(add.sketch, {40, 80}), 0, 0.3);
  EXPECT_NEAR(distance(add.outline, {80, 40}), 0, 0.3);
}

TEST(PinTool, says_what_a_click_beside_the_curve_lacks) {
  PinTool tool;
  Hand hand(tool, one_layer(), Side::kSource);
  hand.click({80, 80});
  const auto actions = hand.take();
  EXPECT_EQ(all_of<action::Say>(actions).size(), 1U);
  EXPECT_FALSE(tool.busy());
}

TEST(PinTool, escape_lets_go_of_the_half_made_pin) {
  PinTool tool;
  Hand hand(tool, one_layer(), Side::kSource);
  hand.click({120, 80});
  hand.key(Key::kEscape);
  EXPECT_FALSE(tool.busy());
  hand.on(Side::kTarget);
  hand.click({80, 120});
  expect_no_change(hand.take());
}

TEST(PinTool, delete_or_another_pin_lets_go_of_the_half_made_pin) {
  PinTool tool;
  Hand hand(tool, with_pin(), Side::kSource);
  hand.click({80, 120});
  ASSERT_TRUE(tool.busy());
  hand.key(Key::kDelete);
  EXPECT_FALSE(tool.busy());
  hand.click({80, 120});
  hand.take();
  // A second one there would be refused.
  hand.on(Side::kTarget);
  hand.click({120, 80});
  const auto actions = hand.take();
  expect_no_change(actions);
  EXPECT_EQ(all_of<action::SelectPin>(actions).back().pin, PinId{1});
  EXPECT_FALSE(tool.busy());
}

TEST(PinTool, drags_either_end) {
  for (const Side side : {Side::kSource, Side::kTarget}) {
    PinTool tool;
    Hand hand(tool, with_pin(), side);
    hand.drag(arc({80, 80}, 40, 0, 30, 10));
    const auto actions = hand.take();
    EXPECT_EQ(all_of<action::SelectPin>(actions).front().pin, PinId{1});
    const auto move = committed<PinMove>(actions);
    EXPECT_EQ(move.pin, PinId{1});
    EXPECT_EQ(move.outline.has_value(), side == Side::kSource);
    EXPECT_EQ(move.sketch.has_value(), side == Side::kTarget);
  }
}

TEST(PinTool, a_click_selects_and_delete_removes) {
  PinTool tool;
  Hand hand(tool, with_pin(), Side::kTarget);
  hand.click({121, 81});
  auto actions = hand.take();
  expect_no_change(actions);
  EXPECT_EQ(all_of<action::SelectPin>(actions).front().pin, PinId{1});
  hand.selected_pin = PinId{1};
  hand.key(Key::kDelete);
  EXPECT_EQ(executed<PinRemove>(hand.take()).pin, PinId{1});
}

TEST(PinTool, a_drag_that_is_refused_leaves_the_last_good_place) {
  PinTool tool;
  Document document = applied(with_pin(), PinAdd{{}, {80, 120}, {80, 120}});
  document = applied(document, PinAdd{{}, {40, 80}, {40, 80}});
  Hand hand(tool, document, Side::kTarget);
  // Past the second pin: they would be out of order.
  hand.drag(arc({80, 80}, 40, 0, 130, 26));
  const auto actions = hand.take();
  EXPECT_FALSE(all_of<action::Say>(actions).empty());
  EXPECT_EQ(refusal(document, committed<PinMove>(actions)), "accepted");
}

TEST(PinTool, on_one_canvas_the_nearer_curve_is_meant) {
  PinTool tool;
  Document document = applied(one_layer(), LayerMove{{}, {100, 0}});
  Hand hand(tool, document, Side::kTarget);
  hand.one_canvas = true;
  hand.click({118, 80});
  hand.click({222, 80});
  const auto add = executed<PinAdd>(hand.take());
  EXPECT_NEAR(distance(add.outline, {120, 80}), 0, 0.3);
  EXPECT_NEAR(distance(add.sketch, {220, 80}), 0, 0.3);
}

} // namespace
} // namespace oversketch
