#pragma once

#include "core/base/bulk_allocator.h"
#include "core/clone/coarsest_grid.h"
#include "core/clone/grid_level.h"
#include "core/clone/grid_pass.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace oversketch {

/// The grids of a mask, the finest first.
struct GridStack {
  std::vector<GridLevel> levels;
  /// The last one's, where it is small.
  std::optional<CoarsestGrid> coarsest;
  /// Of each level: see GridMaking.
  std::vector<char> is_tricky;
  /// As GridRows takes them, long enough for every level.
  std::vector<float> zeros;

  std::size_t last() const { return levels.size() - 1; }
};

/// The values on the grids of a mask, and the parts that multigrid cycles are put together from.
///
/// A cycle is down() and run(), visit() of the next grid, up() and run().
class GridCycle {
public:
  /// @param grids  must outlive this.
  explicit GridCycle(const GridStack& grids);

  /// How a cycle begins: from u, or from zero by a sweep or by half a one, of the colour without coarse nodes.  kSide:
  /// where no node is irregular that half is b / diagonal, and written when the correction comes.
  enum class From { kValues, kZero, kHalf, kSide };
  /// How a cycle ends: by a sweep, by half a one, of the coarse nodes' colour, or together with the next one's
  /// beginning.
  enum class To { kSweep, kHalfSweep, kNext };

  /// Relaxes, and hands the residual down.
  RowPass down(std::size_t l, From from);
  /// Takes the correction from below times `factor`, and relaxes.
  RowPass up(std::size_t l, From from, To to, float factor = 1);
  void run(std::size_t l, const RowPass& pass);
  /// A cycle on a coarse grid, from zero; two where the coarse grids below would leave too much of the error.
  void visit(std::size_t l, bool twice = false);
  /// The last grid: by its factor, or by some sweeps.
  void solve_last(bool from_zero);

  /// Whether the coarse grids are, or were found to be, far off for the pixels.
  bool is_tricky() const { return is_slow || (grids_.last() > 0 && grids_.is_tricky[1] != 0); }
  /// |u| on the second grid.
  double largest_correction() const;
  /// On the first grid, where a whole sweep came last.
  double largest_residual() const;

  const GridLevel& level(std::size_t l) const { return grids_.levels[l]; }
  GridValues& values(std::size_t l) { return values_[l]; }
  const GridValues& values(std::size_t l) const { return values_[l]; }
  std::int64_t bytes() const;

  int threads = 1;
  /// Whether all coarse grids are visited twice.
  bool is_slow = false;

private:
  const GridStack& grids_;
  GridKernels kernels_ = GridKernels::choose();
  std::vector<float, BulkAllocator<float>> memory_;
  std::vector<GridValues> values_;
};

} // namespace oversketch
