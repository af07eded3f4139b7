#include "core/clone/grid_level.h"

#include "tests/unit/clone/grid_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oversketch {
namespace {

TEST(GridLevel, AnIndexTellsOfEachRowWhatLookingTells) {
  for (const auto& [name, mask] : all_masks()) {
    SCOPED_TRACE(name);
    GridMaking made = make_finest(mask, 0);
    for (; made.level.count() > 0; made = coarsen(made, 0)) {
      GridLevel level = made.level;
      const std::int64_t before = level.bytes(), took = index_rows(level, 1'000'000'000);
      EXPECT_EQ(level.bytes() - before, took);
      std::vector<GridPiece> pieces;
      const GridRowIndex& index = level.index;
      for (int row = 0; row < level.rows(); ++row) {
        const auto r = static_cast<std::size_t>(row);
        expand_row(level, row, pieces);
        EXPECT_TRUE(std::equal(pieces.begin(), pieces.end(), index.pieces.begin() + index.first_piece[r],
                               index.pieces.begin() + index.first_piece[r + 1]));
        for (std::size_t colour = 0; colour < 2; ++colour) {
          const std::vector<GridLevel::Irregular>& list = level.irregular[colour];
          const auto begin = static_cast<std::size_t>(index.first_irregular[colour][r]),
                     end = static_cast<std::size_t>(index.first_irregular[colour][r + 1]);
          for (std::size_t i = 0; i < list.size(); ++i)
            EXPECT_EQ(i >= begin && i < end, list[i].slot >= level.first_in(row) && list[i].slot < level.last_in(row));
        }
      }
      level.index = {};
      EXPECT_EQ(index_rows(level, took / 2), 0) << "more than it may take";
      EXPECT_TRUE(level.index.empty());
    }
  }
}

TEST(GridLevel, NeverHasMoreThanAQuarterOfTheNodesBelow) {
  for (const auto& [name, mask] : all_masks()) {
    GridMaking fine = make_finest(mask, 0);
    while (fine.level.count() > 0) {
      GridMaking coarse = coarsen(fine, 0);
      EXPECT_LE(4 * coarse.level.count(), fine.level.count()) << name;
      fine = std::move(coarse);
    }
  }
}

} // namespace
} // namespace oversketch
