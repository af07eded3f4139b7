#include "ui/panels/window_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oversketch {
namespace {

float overlap(const Area& a, const Area& b) {
  const float w = std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x);
  const float h = std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y);
  return w > 0 && h > 0 ? w * h : 0;
}

float size_of(const Area& area) {
  return area.empty() ? 0 : area.width() * area.height();
}

TEST(WindowLayout, CoversTheWindowWithoutOverlap) {
  for (const ImVec2 size : {ImVec2(320, 240), ImVec2(640, 480), ImVec2(1024, 700), ImVec2(1600, 1000),
                            ImVec2(3840, 2160), ImVec2(100, 40), ImVec2(1, 1)}) {
    for (const float scale : {0.5F, 1.0F, 1.5F, 3.0F}) {
      for (const bool side : {false, true}) {
        for (const bool tabs : {false, true}) {
          const WindowLayout out =
              lay_out_window({.size = size, .scale = scale, .side = side, .tabs = tabs, .offer = tabs ? 36.0F : 0.0F});
          const std::vector<Area> parts = {out.menu,     out.tabs, out.offer, out.strip,
                                           out.canvases, out.side, out.status};
          float sum = 0;
          for (std::size_t i = 0; i < parts.size(); ++i) {
            sum += size_of(parts[i]);
            for (std::size_t j = 0; j < i; ++j)
              EXPECT_EQ(overlap(parts[i], parts[j]), 0);
          }
          EXPECT_NEAR(sum, size.x * size.y, 1) << size.x << " × " << size.y << " at " << scale;
        }
      }
    }
  }
}

TEST(WindowLayout, LeavesTheCanvasesMostOfASmallWindow) {
  const WindowLayout out = lay_out_window({.size = ImVec2(320, 240)});
  EXPECT_TRUE(out.narrow);
  EXPECT_TRUE(out.side.empty());
  EXPECT_EQ(out.strip_columns, 2) << "eight buttons do not fit one below the other";
  EXPECT_GT(out.canvases.width(), 0.75F * 320);
  EXPECT_GT(out.canvases.height(), 130);
}

TEST(WindowLayout, NarrowWindowsShowTheSidePanelOverTheCanvases) {
  const WindowLayout out = lay_out_window({.size = ImVec2(320, 240), .side_over = true});
  EXPECT_FALSE(out.side.empty());
  EXPECT_GT(overlap(out.side, out.canvases), 0);
  EXPECT_EQ(overlap(out.side, out.strip), 0) << "the button that closes it stays in reach";
}

TEST(WindowLayout, SidePanelKeepsToItsLimits) {
  for (const float wish : {0.0F, 100.0F, 320.0F, 5000.0F}) {
    const WindowLayout out = lay_out_window({.size = ImVec2(1600, 1000), .side_width = wish});
    EXPECT_GE(out.side.width(), kLeastSide);
    EXPECT_LE(out.side.width(), kMostSide);
    EXPECT_GT(out.canvases.width(), 400);
  }
}

TEST(WindowLayout, GrowsWithTheScale) {
  const WindowLayout one = lay_out_window({.size = ImVec2(1600, 1000)});
  const WindowLayout two = lay_out_window({.size = ImVec2(3200, 2000), .scale = 2});
  EXPECT_EQ(two.menu.height(), 2 * one.menu.height());
  EXPECT_EQ(two.side.width(), 2 * one.side.width());
  EXPECT_EQ(two.canvases.width(), 2 * one.canvases.width());
}

} // namespace
} // namespace oversketch
