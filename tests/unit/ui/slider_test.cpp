#include "ui/widgets/slider.h"

#include "tests/unit/ui/headless.h"

#include <cmath>

namespace oversketch {
namespace {

using testing::Headless;
using Kind = SliderChange::Kind;

const SliderSpec kPixels{.low = 0, .high = 100, .least = 0, .most = 1000, .initial = 10, .unit = "px"};
const SliderSpec kFactor{.low = 0.5, .high = 500, .least = 0.01, .most = 10000, .initial = 20, .logarithmic = true};
const SliderSpec kPercent{.initial = 1, .factor = 100, .unit = "%"};

TEST(SliderValues, ShareAndValueAreEachOthersInverse) {
  for (const SliderSpec& spec : {kPixels, kFactor, kPercent}) {
    EXPECT_DOUBLE_EQ(value_at(0, spec), spec.low);
    EXPECT_DOUBLE_EQ(value_at(1, spec), spec.high);
    EXPECT_DOUBLE_EQ(share_of(spec.low, spec), 0);
    EXPECT_DOUBLE_EQ(share_of(spec.high, spec), 1);
    double last = -1;
    for (double share = 0; share <= 1; share += 0.01) {
      const double value = value_at(share, spec);
      EXPECT_GE(value, last) << "values grow along the bar";
      last = value;
      // Within what the rounding to shown digits moves.
      EXPECT_NEAR(share_of(value, spec), share, 0.06);
    }
  }
}

TEST(SliderValues, LogarithmicBarsGrowByFactors) {
  EXPECT_NEAR(value_at(0.5, kFactor), std::sqrt(0.5 * 500), 0.5);
  EXPECT_NEAR(share_of(std::sqrt(0.5 * 500), kFactor), 0.5, 1e-12);
}

TEST(SliderValues, BeyondTheBarIsItsEnd) {
  EXPECT_EQ(share_of(1000, kPixels), 1);
  EXPECT_EQ(share_of(-5, kPixels), 0);
  EXPECT_EQ(share_of(0.001, kFactor), 0);
}

TEST(SliderValues, TextHasUnitsAndKeepsWhatWasTyped) {
  EXPECT_EQ(format_value(10, kPixels), "10 px");
  EXPECT_EQ(format_value(10.25, kPixels), "10.25 px");
  EXPECT_EQ(format_value(1, kPercent), "100 %");
  EXPECT_EQ(format_value(0.5, kFactor), "0.50");
  EXPECT_EQ(format_value(20, kFactor), "20");
}

TEST(SliderValues, NumbersAreReadWithUnitCommaOrWithout) {
  EXPECT_EQ(parse_value("12.5", kPixels), 12.5);
  EXPECT_EQ(parse_value(" 12,5 px", kPixels), 12.5);
  EXPECT_EQ(parse_value("50 %", kPercent), 0.5);
  EXPECT_EQ(parse_value("+3", kPixels), 3);
  for (const char* bad : {"", "abc", "1 2x", "nan", "inf", "1e999", "--1", "5 %"})
    EXPECT_FALSE(parse_value(bad, kPixels).has_value()) << bad;
}

TEST(SliderValues, FormatAndParseAgree) {
  for (const SliderSpec& spec : {kPixels, kFactor, kPercent})
    for (double share = 0; share <= 1; share += 0.037) {
      const double value = value_at(share, spec);
      const auto read = parse_value(format_value(value, spec), spec);
      ASSERT_TRUE(read.has_value());
      EXPECT_NEAR(*read, value, 1e-9 * std::max(1.0, value));
    }
}

class Slider : public Headless {
protected:
  Slider() {
    show([this](const DrawContext& context) {
      const SliderChange change = draw_slider(context, "s", "Width", {"How wide it is, px.", {}}, value, kPixels);
      if (change.kind != Kind::kNone) changes.push_back(change);
      if (follows && (change.kind == Kind::kSet || change.kind == Kind::kCommit || change.kind == Kind::kPreview))
        value = change.value;
    });
  }
  std::vector<Kind> kinds() const {
    std::vector<Kind> all;
    for (const SliderChange& change : changes)
      all.push_back(change.kind);
    return all;
  }
  double value = 40;
  /// Whether the model takes what was set.
  bool follows = true;
  std::vector<SliderChange> changes;
};

TEST_F(Slider, IsRegisteredWithATip) {
  ASSERT_TRUE(has("s"));
  expect_tips();
}

TEST_F(Slider, DragPreviewsAndCommitsOnce) {
  const ImVec2 from = at("s", 0.2F), to = at("s", 0.75F);
  move_to(from);
  set_button(true);
  move_to(ImVec2((from.x + to.x) / 2, from.y));
  move_to(to);
  set_button(false);
  wait();
  ASSERT_GE(changes.size(), 3U);
  EXPECT_EQ(changes.back().kind, Kind::kCommit);
  EXPECT_NEAR(changes.back().value, 75, 1);
  for (std::size_t i = 0; i + 1 < changes.size(); ++i)
    EXPECT_EQ(changes[i].kind, Kind::kPreview);
}

TEST_F(Slider, DragBeyondTheEndsStaysWithinTheBar) {
  move_to(at("s", 0.5F));
  set_button(true);
  move_to(ImVec2(4000, at("s").y));
  set_button(false);
  EXPECT_EQ(changes.back().kind, Kind::kCommit);
  EXPECT_EQ(changes.back().value, 100);
}

TEST_F(Slider, ClickSetsOnceTheDoubleClickTimeIsOver) {
  click("s", 0.3F);
  EXPECT_TRUE(changes.empty()) << "it might become a double click";
  EXPECT_LT(reply_.next_frame_s, now_s_ + 1) << "a frame must come without an event";
  wait(0.5);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, Kind::kSet);
  EXPECT_NEAR(changes[0].value, 30, 1);
}

TEST_F(Slider, DoubleClickResetsAndNothingElse) {
  double_click("s");
  wait();
  EXPECT_EQ(kinds(), std::vector<Kind>{Kind::kSet});
  EXPECT_EQ(changes[0].value, kPixels.initial);
}

TEST_F(Slider, EscapeGivesADragUp) {
  move_to(at("s", 0.2F));
  set_button(true);
  move_to(at("s", 0.8F));
  press(ImGuiKey_Escape);
  move_to(at("s", 0.9F));
  set_button(false);
  wait();
  EXPECT_EQ(changes.back().kind, Kind::kAbandon);
}

TEST_F(Slider, CtrlClickTypes) {
  hold_ctrl(true);
  click("s");
  hold_ctrl(false);
  frame();
  frame();
  EXPECT_TRUE(ImGui::GetIO().WantTextInput);
  type("250");
  press(ImGuiKey_Enter);
  ASSERT_EQ(kinds(), std::vector<Kind>{Kind::kSet});
  EXPECT_EQ(changes[0].value, 250) << "typed numbers may go beyond the bar";
}

TEST_F(Slider, WhatItIsAlreadyIsNotSetAgain) {
  hold_ctrl(true);
  click("s");
  hold_ctrl(false);
  frame();
  frame();
  ASSERT_EQ(value, 40);
  type("40");
  press(ImGuiKey_Enter);
  EXPECT_TRUE(kinds().empty());
}

TEST_F(Slider, TypedNumbersOutOfRangeAreRefusedInWords) {
  for (const char* text : {"5000", "many"}) {
    changes.clear();
    hold_ctrl(true);
    click("s");
    hold_ctrl(false);
    frame();
    type(text);
    press(ImGuiKey_Enter);
    ASSERT_EQ(kinds(), std::vector<Kind>{Kind::kRefused}) << text;
    EXPECT_TRUE(changes[0].text.starts_with("Width")) << changes[0].text;
    wait();
  }
}

TEST_F(Slider, TypingEndsWithAClickElsewhereToo) {
  hold_ctrl(true);
  click("s");
  hold_ctrl(false);
  frame();
  type("33");
  click_at(ImVec2(200, 600));
  frame();
  ASSERT_EQ(kinds(), std::vector<Kind>{Kind::kSet});
  EXPECT_NEAR(changes[0].value, 33, 1e-6);
}

TEST_F(Slider, TypingIsGivenUpByEscape) {
  hold_ctrl(true);
  click("s");
  hold_ctrl(false);
  frame();
  type("33");
  press(ImGuiKey_Escape);
  wait();
  EXPECT_TRUE(changes.empty());
}

TEST(SliderActions, ADragIsOneGestureAndATypedNumberOneCommand) {
  ActionSink sink;
  const auto command = [](double value) {
    LayerSet set;
    set.follow = value;
    return Command(set);
  };
  emit_slider(sink, {Kind::kPreview, 3}, command);
  emit_slider(sink, {Kind::kCommit, 3}, command);
  emit_slider(sink, {Kind::kSet, 4}, command);
  emit_slider(sink, {Kind::kAbandon, 4}, command);
  emit_slider(sink, {Kind::kNone, 4}, command);
  emit_slider(sink, {Kind::kRefused, 4, "no"}, command);
  const auto actions = sink.take();
  ASSERT_EQ(actions.size(), 5U);
  EXPECT_EQ(std::get<action::Preview>(actions[0]).command, command(3));
  EXPECT_TRUE(std::holds_alternative<action::Commit>(actions[1]));
  EXPECT_EQ(std::get<action::Execute>(actions[2]).command, command(4));
  EXPECT_TRUE(std::holds_alternative<action::Abandon>(actions[3]));
  EXPECT_EQ(std::get<action::Say>(actions[4]).text, "no");
}

} // namespace
} // namespace oversketch
