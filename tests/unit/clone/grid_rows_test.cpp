#include "core/clone/grid_rows.h"

#include "tests/unit/clone/grid_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace oversketch {
namespace {

constexpr std::size_t kC = kGridChannels;

/// A grid, noise on it, and zeros.
struct NoisyGrid {
  explicit NoisyGrid(const GridLevel& of) : level(of) {
    std::mt19937 random(7);
    std::normal_distribution<float> value;
    for (std::vector<float>* values : {&u, &b}) {
      values->resize(kC * static_cast<std::size_t>(level.count()) + 1);
      for (float& v : *values)
        v = value(random);
    }
  }

  /// Calls work(rows, row) for all rows.
  void for_rows(const std::function<void(GridRows&, int)>& work) {
    const std::vector<float> zeros(GridRows::longest_cells(level));
    GridRows rows(level, {u.data(), b.data(), false}, GridKernels::choose(), zeros);
    for (int row = 0; row < level.rows(); ++row)
      work(rows, row);
  }

  /// Calls work(slot) for the nodes of a colour.
  void for_nodes(int colour, const std::function<void(std::size_t)>& work) const {
    for (int row = 0; row < level.rows(); ++row)
      for (int run = level.begin_of(row); run < level.end_of(row); ++run)
        for (int x = level.x0_of(run); x < level.x1_of(run); ++x)
          if (((x + level.y_of(row)) & 1) == colour) work(kC * static_cast<std::size_t>(level.slot(run, x)));
  }

  void clear(int colour) {
    for_nodes(colour, [&](std::size_t at) { std::fill_n(u.begin() + static_cast<std::ptrdiff_t>(at), kC, 0.0F); });
  }

  const GridLevel& level;
  std::vector<float> u, b;
};

/// Calls check(fine, coarse) for neighbouring grids of all masks.
void for_grids(const std::function<void(const GridLevel& fine, const GridLevel& coarse)>& check) {
  for (const auto& [name, mask] : all_masks()) {
    SCOPED_TRACE(name);
    GridMaking fine = make_finest(mask, 0);
    for (;;) {
      GridMaking coarse = coarsen(fine, 0);
      if (coarse.level.count() == 0) break;
      check(fine.level, coarse.level);
      fine = std::move(coarse);
    }
  }
}

std::vector<float> restricted(NoisyGrid& grid, const GridLevel& coarse,
                              void (GridRows::*restrict_row)(const GridLevel&, int, float*)) {
  std::vector<float> b(kC * static_cast<std::size_t>(coarse.count()) + 1, 99.0F);
  grid.for_rows([&](GridRows& rows, int row) {
    const int y = grid.level.y_of(row) - grid.level.coarse_y;
    const int coarse_row = (y & 1) == 0 ? coarse.find_row(y >> 1) : -1;
    if (coarse_row >= 0) (rows.*restrict_row)(coarse, coarse_row, b.data());
  });
  return b;
}

TEST(GridRows, OverrelaxingGoesFurtherTheSameWay) {
  for_grids([](const GridLevel& level, const GridLevel&) {
    for (const int colour : {0, 1}) {
      NoisyGrid grid(level);
      const std::vector<float> before = grid.u;
      grid.for_rows([&](GridRows& rows, int row) { rows.relax(row, colour); });
      const std::vector<float> relaxed = grid.u;
      grid.u = before;
      grid.for_rows([&](GridRows& rows, int row) { rows.overrelax(row, colour, 1.4F); });
      grid.for_nodes(1 - colour, [&](std::size_t at) {
        for (std::size_t k = at; k < at + kC; ++k)
          EXPECT_EQ(grid.u[k], before[k]);
      });
      grid.for_nodes(colour, [&](std::size_t at) {
        for (std::size_t k = at; k < at + kC; ++k)
          EXPECT_NEAR(grid.u[k], before[k] + 1.4F * (relaxed[k] - before[k]), 1e-5);
      });
    }
  });
}

TEST(GridRows, HalfOfTheValuesIsTakenForZero) {
  for_grids([](const GridLevel& level, const GridLevel& coarse) {
    NoisyGrid grid(level);
    const std::vector<float> half = restricted(grid, coarse, &GridRows::restrict_half_to);
    grid.clear(level.coarse_colour());
    const std::vector<float> whole = restricted(grid, coarse, &GridRows::restrict_to);
    for (std::size_t i = 0; i + 1 < half.size(); ++i)
      EXPECT_NEAR(half[i], whole[i], 1e-5);
  });
}

TEST(GridRows, HalfASweepFromZeroNeedNotStandThere) {
  for_grids([](const GridLevel& level, const GridLevel& coarse) {
    const auto other = static_cast<std::size_t>(1 - level.coarse_colour());
    if (!level.irregular[other].empty()) return;
    NoisyGrid grid(level);
    const std::vector<float> side = restricted(grid, coarse, &GridRows::restrict_side_to);
    grid.for_rows([&](GridRows& rows, int row) { rows.relax_from_zero(row, static_cast<int>(other)); });
    const std::vector<float> half = restricted(grid, coarse, &GridRows::restrict_half_to);
    for (std::size_t i = 0; i + 1 < side.size(); ++i)
      EXPECT_NEAR(side[i], half[i], 1e-5);
  });
}

} // namespace
} // namespace oversketch
