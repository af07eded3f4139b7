#pragma once

#include "core/clone/grid_rows.h"

#include <functional>
#include <vector>

namespace oversketch {

/// What is done to each row of a grid, after the stages before it: to row r − lag while the first is at row r.
///
/// A stage reads and writes rows as if each stage were done to all rows before the next begins; lags must leave room
/// for that: at least 1 more than the stage before (2 where two rows on either side are read).
struct RowStage {
  int lag = 0;
  std::function<void(GridRows&, int row)> run;
};

struct RowPass {
  std::vector<RowStage> stages;
  GridRows::Needed needed;
  /// If any: makes for each thread what writes b, row by row from the top, before the stages come there.  Lags leave
  /// room for what they read of it.
  std::function<std::function<void(int row)>()> make_writer;
};

/// Runs the stages over all rows, together: each row is in the cache when its next stage comes.
///
/// With several threads each takes a band of rows as far as it depends on nothing of its neighbours; what is left at
/// the seams is done after.  Every value is computed from the same values as with one thread: the bits are the same.
void run_pass(const GridLevel& level, GridValues values, const GridKernels& kernels, std::span<const float> zeros,
              const RowPass& pass, int threads);

} // namespace oversketch
