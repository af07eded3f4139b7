#pragma once

#include "core/geometry/mask.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace oversketch {

/// A stretch of a run whose nodes are all connected upwards, or none; the same downwards.
struct GridPiece {
  /// The nodes of one colour: `count` slots from `at`.
  struct Cells {
    int at = 0;
    int count = 0;
    /// Slots of the first one's left and upper and lower neighbour; the right one's is west + 1.  −1: none above, none
    /// below, for all of them.
    int west = 0;
    int north = -1;
    int south = -1;
    /// The first one has no left neighbour; the last one no right neighbour.
    bool opens = false;
    bool closes = false;
    bool operator==(const Cells&) const = default;
  };

  int x0 = 0;
  int x1 = 0;
  int run = 0;
  /// Numbers of the nodes above and below x0, or −1.
  int above = -1;
  int below = -1;
  std::array<Cells, 2> cells;
  bool operator==(const GridPiece&) const = default;
};

/// What every pass over a grid asks of its rows, found once; row r's are [first[r], first[r + 1]).
struct GridRowIndex {
  std::vector<GridPiece> pieces;
  std::vector<int> first_piece;
  /// Of GridLevel::irregular, by colour.
  std::array<std::vector<int>, 2> first_irregular;

  bool empty() const { return first_piece.empty(); }
  std::int64_t bytes() const;
};

/// One grid of MaskMultigrid: nodes in runs, row by row.  Neighbours in a run are connected; a node and the one below
/// it are, unless the pair is cut.  Memory follows the number of nodes and runs.
///
/// A node has a number, from left to right through all runs, and a slot, where its values are stored: in each run first
/// the 1st, 3rd, 5th… node, then the 2nd, 4th, 6th….  So each colour (x + y) & 1 of a run lies in one piece, and the
/// four neighbours of a stretch of one colour are stretches of the other.
struct GridLevel {
  struct Run {
    int x0 = 0;
    /// Number of its first node, and its first slot.
    int first = 0;
  };
  /// A node whose diagonal entry is not `diagonal` but `diagonal / scale`.
  struct Irregular {
    int slot = 0;
    float scale = 1;
  };

  /// y of the first row, where rows follow each other without gaps: then row_ys is empty.
  int y0 = 0;
  std::vector<int> row_ys;
  /// First run of each row, and one more.
  std::vector<int> row_runs;
  /// By y and x; one more at the end, whose `first` is the number of nodes.
  std::vector<Run> runs;
  /// Numbers of the nodes that are not connected with the node below, though there is one; increasing.
  std::vector<int> cuts;
  /// By colour, slots increasing.
  std::array<std::vector<Irregular>, 2> irregular;
  /// Entry of a node with all four neighbours, or with the boundary where a neighbour would be.
  float diagonal = 4;
  /// Node (X, Y) of the next coarser level is node (2 X + coarse_x, 2 Y + coarse_y) of this one.
  int coarse_x = 0;
  int coarse_y = 0;
  /// Empty where it would take too much memory.
  GridRowIndex index;

  int count() const { return runs.back().first; }
  int rows() const { return static_cast<int>(row_runs.size()) - 1; }
  int y_of(int row) const { return row_ys.empty() ? y0 + row : row_ys[static_cast<std::size_t>(row)]; }
  int first_of(int run) const { return runs[static_cast<std::size_t>(run)].first; }
  int x0_of(int run) const { return runs[static_cast<std::size_t>(run)].x0; }
  int x1_of(int run) const { return x0_of(run) + first_of(run + 1) - first_of(run); }
  int begin_of(int row) const { return row_runs[static_cast<std::size_t>(row)]; }
  int end_of(int row) const { return row_runs[static_cast<std::size_t>(row) + 1]; }
  /// Number of the row's first node, and one past its last.
  int first_in(int row) const { return first_of(begin_of(row)); }
  int last_in(int row) const { return first_of(end_of(row)); }
  int coarse_colour() const { return (coarse_x + coarse_y) & 1; }
  /// −1 where there is none.
  int find_row(int y) const;
  /// Run of a row that holds x, or −1.
  int find_run(int row, int x) const;
  /// Number of the node at (x, y), or −1.
  int find(int x, int y) const;
  bool is_cut(int number) const;
  /// Slot of the node at x of a run.
  int slot(int run, int x) const {
    const int first = first_of(run), i = x - x0_of(run);
    return (i & 1) == 0 ? first + i / 2 : first + (first_of(run + 1) - first + 1) / 2 + i / 2;
  }
  /// What is allocated.
  std::int64_t bytes() const;
};

/// The pieces of a row, from left to right; replaces what `out` holds.
void expand_row(const GridLevel& level, int row, std::vector<GridPiece>& out);

/// Makes the level's index, if it takes at most that many bytes.
/// @returns how many it takes.
std::int64_t index_rows(GridLevel& level, std::int64_t most_bytes);

/// Pixels of a mask, each pair of neighbours connected; diagonal 4 + screening.
GridLevel make_finest_level(const Mask& mask, double screening);

/// What is only needed while the next coarser level is made.
struct GridBorder {
  int number = 0;
  /// Left, right, up, down: pixels to the boundary, where the neighbour there is not connected; else 0.
  std::array<float, 4> distance{};
  /// Added to the diagonal entry for the holes that fell between the nodes.
  float mass = 0;
};

/// A level, and its nodes next to a boundary, by number.
struct GridMaking {
  GridLevel level;
  std::vector<GridBorder> border;
  /// Side of a cell, px.
  double spacing = 1;
  /// Whether something was lost between its nodes, or walls between them are thin (never of the pixels themselves):
  /// what is solved on it may be far off for the finer level.
  bool is_tricky = false;
};

GridMaking make_finest(const Mask& mask, double screening);

/// The level with every second node of every second row, of the four choices the one with fewest nodes; sets coarse_x
/// and coarse_y of the finer one.  No nodes: there is nothing to coarsen.
///
///  · Two nodes are connected where the node between them is, with both.  A node without connections is left out.
///  · Where there is no connection the boundary lies at a distance of θ cells, 0 < θ ≤ 1, and weighs 1/θ (in the entry
///    of the node; the unconnected pair has none).
///  · What falls between four connected nodes (a hole, the tip of a slit) would be forgotten, and the coarse solution
///    far too large: its weights are added to the entries of the four, as the Galerkin product would.  That weighs
///    small holes a little too much, which costs contraction, never convergence.
GridMaking coarsen(GridMaking& fine, double screening);

} // namespace oversketch
