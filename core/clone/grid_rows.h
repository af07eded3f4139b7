#pragma once

#include "core/clone/grid_kernels.h"
#include "core/clone/grid_level.h"

#include <array>
#include <span>
#include <vector>

namespace oversketch {

/// The values of one grid, kGridChannels floats a slot: the unknown and the right-hand side.
struct GridValues {
  float* u = nullptr;
  float* b = nullptr;
  /// b is 0 where all four neighbours are connected, and does not stand there: what is not read costs no time.
  bool is_b_beside_boundary = false;
};

/// Works on single rows of a grid: what a cycle does is put together from these.  One thread uses one object.
///
/// `colour` is that of the nodes worked on, (x + y) & 1.  Rows are read one up and one down.
class GridRows {
public:
  /// @param zeros  at least longest_cells(level) floats, all 0.
  GridRows(const GridLevel& level, GridValues values, const GridKernels& kernels, std::span<const float> zeros)
      : level_(level), values_(values), kernels_(kernels), zeros_(zeros.data()), inverse_(1 / level.diagonal) {}

  static std::size_t longest_cells(const GridLevel& level);

  /// What a pass looks at: of b all, or the coarse nodes' colour.
  struct Needed {
    bool u = true;
    bool all_b = true;
  };
  /// Asks for the values of a row that is needed soon: halves of rows are too short for the processor to foresee them.
  /// One of `parts` parts of the row, so that what is done in between hides the time that they take.
  void fetch(int row, std::size_t part, std::size_t parts, const Needed& needed) const;

  /// Gauss-Seidel: u of one colour from the other.
  void relax(int row, int colour);
  /// The same, going `factor` times as far (SOR).
  void overrelax(int row, int colour, float factor);
  /// As relax where all of u is taken for 0.
  void relax_from_zero(int row, int colour);
  /// Writes the coarser grid's u times `factor` where its nodes are, and 0 on the other nodes of their colour in rows
  /// that have some.  That colour's own values are lost: it is relaxed next.
  void inject(int row, const GridLevel& coarse, const float* coarse_u, float factor);
  /// Adds the interpolated correction to the other colour; needs what inject wrote in this row and its neighbours.
  void correct(int row);
  /// The same where the other colour's u is b / diagonal, which need not stand there, and no node is irregular.
  void correct_from_side(int row);
  /// A row of the coarser grid's b: the residual, fully weighted (Trottenberg, Oosterlee, Schüller 2001, 2.3.3), times
  /// 4 for its unit.  Where the colour that is not the coarse nodes' was relaxed last.
  void restrict_to(const GridLevel& coarse, int coarse_row, float* coarse_b);
  /// The same where u is to be taken for 0 on the coarse nodes' colour.  An object restricts in one way.
  void restrict_half_to(const GridLevel& coarse, int coarse_row, float* coarse_b);
  /// And where besides u of the other colour is b / diagonal, and no node is irregular: u itself is not read.
  void restrict_side_to(const GridLevel& coarse, int coarse_row, float* coarse_b);
  /// Largest |residual| of a row, where the colour that is not the coarse nodes' was relaxed last.
  float largest_residual(int row);

private:
  struct Residual {
    int row = -1;
    std::vector<float> values;
  };

  std::span<const GridPiece> pieces(int row);
  /// The residual of the coarse nodes' colour, kGridChannels floats a slot of the row.
  const float* residual(int row);
  void fill_residual(int row, float* r);
  void fill_residual_of_half(int row, float* r);
  /// The residuals at x0, x0 + 2, … x1 of the row beside another, 0 where there is none; in `room` if they must be put
  /// together.
  const float* corners(int row, int side, int x0, int x1, std::vector<float>& room);
  bool has_coarse_nodes(int row) const { return ((level_.y_of(row) - level_.coarse_y) & 1) == 0; }
  /// Neighbours of `values`: of u, or of b.
  template <class Work>
  void for_cells(const float* values, int row, int colour, Work work);
  template <class Work>
  void for_irregular(int row, int colour, Work work) const;

  const GridLevel& level_;
  GridValues values_;
  GridKernels kernels_;
  const float* zeros_;
  float inverse_;
  /// Without an index: rows that a pass has looked at last, by number modulo 16.
  std::array<std::vector<GridPiece>, 16> pieces_;
  std::array<int, 16> pieces_row_ = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
  std::array<Residual, 4> residuals_;
  /// What `residuals_` are of.
  enum class Of { kValues, kHalf, kSide };
  Of of_ = Of::kValues;
  std::vector<float> line_;
  std::array<std::vector<float>, 2> corners_;
};

} // namespace oversketch
