#include "tests/unit/ui/headless.h"
#include "ui/widgets/buttons.h"
#include "ui/widgets/dialog.h"
#include "ui/widgets/plot.h"
#include "ui/widgets/section.h"

#include <array>
#include <cmath>
#include <limits>

namespace oversketch {
namespace {

using testing::Headless;

constexpr std::array kOptions = {Option{"a", "First", "The first."}, Option{"b", "Second", "The second."},
                                 Option{"c", "Third", "The third."}};

class Widgets : public Headless {};

TEST_F(Widgets, ButtonsClickOnceAndTellWhatTheyAreFor) {
  int clicks = 0, icons = 0, pale = 0;
  show([&](const DrawContext& context) {
    clicks += draw_button(context, "b", "Do it", {"Does it.", {}}) ? 1 : 0;
    icons += draw_icon_button(context, "i", "x", {"Does it too.", {}}) ? 1 : 0;
    pale += draw_button(context, "p", "Cannot", {"Not now.", {}}, {.enabled = false}) ? 1 : 0;
  });
  click("b");
  click("i");
  click("p");
  EXPECT_EQ(clicks, 1);
  EXPECT_EQ(icons, 1);
  EXPECT_EQ(pale, 0);
  expect_tips();
}

TEST_F(Widgets, TipsComeAfterARestAndAskForTheirFrame) {
  show([&](const DrawContext& context) { draw_button(context, "b", "Do it", {"Does it.", {}}); });
  const auto windows = [] { return ImGui::GetDrawData()->CmdListsCount; };
  const int before = windows();
  move_to(at("b"));
  frame();
  EXPECT_EQ(windows(), before);
  EXPECT_LE(reply_.next_frame_s, now_s_ + kTipDelay_s);
  wait(kTipDelay_s + 0.05);
  frame();
  EXPECT_EQ(windows(), before + 1) << "the tip is a window of its own";
  move_to(ImVec2(399, 899));
  frame();
  EXPECT_EQ(windows(), before);
}

TEST_F(Widgets, SegmentsGiveTheOtherChoiceAlone) {
  int chosen = -1;
  show([&](const DrawContext& context) {
    if (const int now = draw_segments(context, "s", kOptions, 1); now >= 0) chosen = now;
  });
  click("s.b");
  EXPECT_EQ(chosen, -1) << "what is chosen already is no change";
  click("s.c");
  EXPECT_EQ(chosen, 2);
  expect_tips();
}

TEST_F(Widgets, ChoicesOpenAndAreRegisteredWhileOpen) {
  int chosen = -1;
  show([&](const DrawContext& context) {
    if (const int now = draw_choice(context, "c", "Mode", {"Which one.", {}}, kOptions, 0); now >= 0) chosen = now;
  });
  EXPECT_FALSE(has("c.b"));
  click("c");
  frame();
  click("c.b");
  EXPECT_EQ(chosen, 1);
  frame();
  EXPECT_FALSE(has("c.b")) << "a choice closes the list";
}

TEST_F(Widgets, ToggleIsClickedAnywhereInItsRow) {
  int clicks = 0;
  show([&](const DrawContext& context) { clicks += draw_toggle(context, "t", "On", {"Whether.", {}}, true) ? 1 : 0; });
  click("t", 0.05F);
  click("t", 0.95F);
  EXPECT_EQ(clicks, 2);
}

TEST_F(Widgets, SectionsFoldAndRegisterWhatIsSeen) {
  show([&](const DrawContext& context) {
    const Section section(context, "panel.x", "Title", "12", "What it holds.");
    if (section.open()) draw_button(context, "inside", "Inside", {"Within.", {}});
  });
  ASSERT_TRUE(has("panel.x"));
  ASSERT_TRUE(has("inside"));
  const float open = widgets_.boxes().at("panel.x").h;
  click("panel.x.title");
  frame();
  EXPECT_FALSE(has("inside"));
  EXPECT_LT(widgets_.boxes().at("panel.x").h, open);
  click("panel.x.title");
  frame();
  EXPECT_TRUE(has("inside"));
}

TEST_F(Widgets, WhatIsScrolledAwayIsNotRegistered) {
  show([&](const DrawContext& context) {
    ImGui::BeginChild("##small", ImVec2(200, 50));
    draw_button(context, "first", "First", {"Seen.", {}}, {.height = 40});
    ImGui::Dummy(ImVec2(1, 300));
    draw_button(context, "last", "Last", {"Not seen.", {}});
    ImGui::EndChild();
  });
  EXPECT_TRUE(has("first"));
  EXPECT_FALSE(has("last"));
}

TEST_F(Widgets, DialogsStayWithinSmallWindows) {
  ImGui::GetIO().DisplaySize = ImVec2(320, 240);
  show(
      [&](const DrawContext& context) {
        const Dialog dialog(context, "dialog.x", "A question", ImVec2(920, 620));
        AnswerRow row(context);
        row.draw("yes", "Certainly, with all that belongs to it", {"Yes.", {}});
        row.draw("no", "By no means and never", {"No.", {}});
      },
      true);
  const WidgetMap::Box box = widgets_.boxes().at("dialog.x");
  EXPECT_GE(box.x, 0);
  EXPECT_GE(box.y, 0);
  EXPECT_LE(box.x + box.w, 320);
  EXPECT_LE(box.y + box.h, 240);
}

TEST(PlotHeights, GoFromTheLeastToTheGreatest) {
  const std::vector<double> values = {1, 3, 2};
  EXPECT_EQ(plot_heights(values, {}), (std::vector<float>{0, 1, 0.5F}));
  EXPECT_EQ(plot_heights(values, {.from_zero = true}), (std::vector<float>{1.0F / 3, 1, 2.0F / 3}));
}

TEST(PlotHeights, LogarithmsMakeFactorsEqualSteps) {
  const auto heights = plot_heights(std::vector<double>{1, 10, 100}, {.logarithmic = true});
  EXPECT_NEAR(heights[1], 0.5F, 1e-6F);
}

TEST(PlotHeights, BadValuesLieAtTheBottom) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(plot_heights(std::vector<double>{nan, 1, inf, 2}, {}), (std::vector<float>{0, 0, 0, 1}));
  EXPECT_EQ(plot_heights(std::vector<double>{0, 1, 2}, {.logarithmic = true})[0], 0);
  EXPECT_EQ(plot_heights(std::vector<double>{5, 5}, {}), (std::vector<float>{0, 0}));
  EXPECT_TRUE(plot_heights({}, {}).empty());
}

TEST_F(Widgets, TextIsElidedAtCharactersAndFits) {
  show([](const DrawContext&) {
    const std::string text = "ΠΡÜFUNG eines langen Namens";
    for (float width = 0; width < 300; width += 7) {
      const std::string cut = elided(text, width);
      EXPECT_LE(ImGui::CalcTextSize(cut.c_str()).x, std::max(width, 0.0F));
      if (cut != text && !cut.empty()) {
        const std::string head = cut.substr(0, cut.size() - std::string("…").size());
        EXPECT_TRUE(text.starts_with(head));
        EXPECT_NE(static_cast<unsigned char>(text[head.size()]) & 0xC0, 0x80) << "cut within a character";
      }
    }
    EXPECT_EQ(elided(text, 1e6F), text);
    const std::string long_name(1'000'000, 'i'), cut = elided(long_name, 100);
    EXPECT_LT(cut.size(), 105U);
    EXPECT_LE(ImGui::CalcTextSize(cut.c_str()).x, 100);
    EXPECT_GT(ImGui::CalcTextSize(("i" + cut).c_str()).x, 100) << "as much as there is room for";
  });
}

TEST(Colors, MixingEndsAtBoth) {
  const PackedColor a = IM_COL32(10, 20, 30, 40), b = IM_COL32(110, 220, 130, 240);
  EXPECT_EQ(mixed(a, b, 0), a);
  EXPECT_EQ(mixed(a, b, 1), b);
  EXPECT_EQ(mixed(a, b, 0.5F), static_cast<PackedColor>(IM_COL32(60, 120, 80, 140)));
}

} // namespace
} // namespace oversketch
