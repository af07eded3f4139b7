#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/float4.h"
#include "core/clone/grid_kernels.h"
#include "core/clone/pixel_graph.h"
#include "core/geometry/mask.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>

namespace oversketch {

/// Grids for solving Poisson's equation on the pixels of a mask by geometric multigrid: A u = b, A the 5-point
/// Laplacian with 4 + λ on the diagonal and −1 for each neighbour in the mask; values outside stand in b.
///
/// Every second pixel of every second row makes the next grid (coarsen in grid_level.h), down to a few hundred nodes,
/// which are factored.  Red-black Gauss-Seidel, over-relaxed between two cycles, full weighting, bilinear interpolation
/// (Trottenberg, Oosterlee, Schüller 2001).  Made for one mask and λ; copies share the grids.
/// @threads const after making.
class MaskMultigrid {
public:
  /// @param screening  λ ≥ 0, per px².
  /// @errors clone.empty-mask; clone.too-large (above 200 million pixels, 8 GB); cancelled.
  /// @cost O(runs + perimeter).  Stores 8 bytes a run, 4 a row, a little along the boundary, and up to 3 bytes a pixel
  ///   of what is looked up in each pass.
  static Result<MaskMultigrid> make(const Mask& mask, double screening = 0, const Watch& watch = {});

  int unknowns() const;
  double screening() const;
  int levels() const;
  /// Of the grids; the values are MultigridSolve's.
  std::int64_t bytes() const;

private:
  friend class MultigridSolve;
  struct Data;
  explicit MaskMultigrid(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// One solution at a time on the grids of a mask: b and u, in float, three channels.  Kept from move to move.
///
/// Values go in and out by runs of the mask (their index in Mask::runs()), pixel by pixel; the fourth number
/// of a Float4 is not looked at, and 0 coming out.
/// Memory: 24 bytes a pixel and a third more for the coarser grids; with the grids 32–36, at most 40 for any mask.
/// Accuracy: float's rounding leaves errors of about 0.001 levels at 4 M pixels (values to 1).
/// @threads one call at a time; inside as many as use_threads says, 1 from the start, with the same bits for any
/// number.
class MultigridSolve {
public:
  explicit MultigridSolve(const MaskMultigrid& grids);
  ~MultigridSolve();
  MultigridSolve(MultigridSolve&&) noexcept;
  MultigridSolve& operator=(MultigridSolve&&) noexcept;

  void use_threads(int threads);

  /// All of b must be set before solve().
  void set_side(std::size_t run, std::span<const Float4> values);
  /// Where b of a run stands: for what set_side_by() makes.
  GridSlots<float> side(std::size_t run);
  /// Writes side() of a row's runs, begin ≤ run < end.
  /// @returns whether all is finite.
  using WriteSide = std::function<bool(std::size_t begin, std::size_t end)>;
  /// In place of set_side() of all runs: the next solve() has each of its threads make one and write b by it, row by
  /// row from the top, while the first cycle looks at it, for it is in the cache then.
  void set_side_by(std::function<WriteSide()> make);
  /// In place of set_side() of all runs, where b is 0 but beside the boundary: the sums of `values` at the pixels of
  /// the ring's edges.  After the start, which then stays (CHECK in solve()): unless that is zero, b is not read
  /// elsewhere, for three quarters of the time.
  /// @param graph  of the mask.
  void set_ring_side(const PixelGraph& graph, std::span<const Float4> values);
  /// Where to start from: all of u, or zero, from where the first cycle looks at the coarser grids twice.
  void set_start(std::size_t run, std::span<const Float4> values);
  void start_from_zero();
  void get(std::size_t run, std::span<Float4> values) const;
  /// The same where it stands, for as long as this is not solved again.
  GridSlots<const float> slots(std::size_t run) const;

  struct Outcome {
    int cycles = 0;
    /// By how much the last cycle's correction was smaller than the one before; 0 when there were less than two.
    double contraction = 0;
    /// What is left of the error, |u − A⁻¹ b| in any pixel and channel: c ρ/(1 − ρ), c the last coarse correction, ρ
    /// the contraction with a margin (at least 0.3), 1.25 times as much where the last sweep is a half one, and on
    /// tricky masks 1.5 times the largest residual besides.  A bound as far as the error goes on shrinking by ρ: errors
    /// are at most 0.7 of it in the tests, which hold it against exact solutions.
    double error = 0;
  };

  /// Cycles, at least `least` and at most `most`, until the error is at most `tolerance`, or float can do no better.
  ///
  /// A cycle is V(1,1), the first from zero V(½,1), the last V(1,½) where that is enough, and takes off nine tenths of
  /// the error; where the mask has holes or slits so narrow that coarse grids see them badly it is W(1,1), for 1.5
  /// times the time, and takes off three quarters; of pixel-sized holes all over the mask two thirds, at worst half.
  /// @errors cancelled (asked between cycles; u is then as the last cycle left it); clone.not-finite, where what writes
  ///   b says so.
  /// @cost 4 to 6 ns a pixel and cycle, much of it the memory's time; with runs of a few pixels (pixel-sized holes) 60
  /// to 200.
  Result<Outcome> solve(double tolerance, int least, int most, const Watch& watch = {});

  std::int64_t bytes() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace oversketch
