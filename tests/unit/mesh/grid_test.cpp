#include "core/mesh/grid.h"

#include "core/base/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace oversketch {
namespace {

TEST(Grid, NeedsABoxAndACell) {
  EXPECT_THROW((void)centred_grid(Box{}, 1), BugError);
  EXPECT_THROW((void)centred_grid(bounds({{0, 0}, {1, 1}}), 0), BugError);
}

TEST(Grid, ALineBelongsToTheCellOnItsLargerSide) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1000, 1000), side(0.01, 20);
  for (int i = 0; i < 20'000; ++i) {
    const Grid grid{{anywhere(random), anywhere(random)}, side(random), 1 + i % 7};
    const int line = static_cast<int>(anywhere(random));
    EXPECT_EQ(grid.column(grid.x(line)), line);
    EXPECT_EQ(grid.column(std::nextafter(grid.x(line), -HUGE_VAL)), line - 1);
    EXPECT_EQ(grid.row(grid.y(line)), line);
    EXPECT_EQ(grid.row(std::nextafter(grid.y(line), -HUGE_VAL)), line - 1);
  }
}

TEST(Grid, FineLinesFallOnCoarseOnesToTheBit) {
  const Grid coarse{{0.1, -7.3}, 0.7, 1}, fine{{0.1, -7.3}, 0.7, 3};
  for (int line = -50; line <= 50; ++line) {
    EXPECT_EQ(fine.x(3 * line), coarse.x(line));
    EXPECT_EQ(fine.y(3 * line), coarse.y(line));
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(fine.coarse(3 * line + k), line);
      EXPECT_EQ(fine.within(3 * line + k), k);
      EXPECT_EQ(coarse.column(fine.x(3 * line + k)), line);
    }
  }
}

TEST(Grid, IsCentredWithAMargin) {
  for (const double width : {0.5, 39.9999999999, 40.0, 40.1, 50.0}) {
    const Grid grid = centred_grid(bounds({{3, 1}, {3 + width, 2}}), 10);
    const int last = grid.column(3 + width);
    EXPECT_EQ(grid.column(3), 0);
    EXPECT_GT(3 - grid.x(0), 0);
    EXPECT_NEAR(3 - grid.x(0), grid.x(last + 1) - (3 + width), 1e-9);
    EXPECT_LE(3 - grid.x(0), 5 + 1e-9);
  }
}

} // namespace
} // namespace oversketch
