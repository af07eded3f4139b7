#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/geometry/curve.h"
#include "core/mesh/grid.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace oversketch {

/// A region cut along a grid: the connected pieces of the region in each cell (copies of the cell), and the parts of
/// cell edges that join them (a port on either side).
///
/// Sides of a cell run 0 = top, 1 = right, 2 = bottom, 3 = left; side k runs from corner k to corner k + 1 (as in
/// QuadMesh): the positive direction, in which the outline goes round the region too.
/// @threads plain values; safe to read from several threads.
struct CellCopies {
  /// A piece of the region in a cell.
  struct Copy {
    int column = 0;
    int row = 0;
    /// Its ports are first_port … first_port of the next copy (there is one more entry at the end), in positive
    /// direction.
    int first_port = 0;
    /// Area of the piece, as a part of the cell's.
    double coverage = 0;
  };

  /// One copy's side of a part of a cell edge through which the region goes on.
  struct Port {
    int copy = 0;
    /// The port on the other side.
    int twin = -1;
    std::int8_t side = 0;
    /// Corners of the cell between this port and the next one of the copy.
    std::int8_t corners_to_next = 0;
    /// Such a corner lies in the region: port, corner and next port touch.  (Then corners_to_next is 1.)
    bool inside_corner = false;
  };

  /// A stretch of the outline in one cell, from a crossing of the grid to the next.
  struct Chain {
    double start_s = 0;
    int copy = -1;
    /// The segment it begins on.
    int segment = 0;
    /// It begins on a line of the coarse grid.
    bool on_coarse_line = false;
  };

  /// Where a chain enters or leaves a cell, by position along the cell's sides in positive direction.
  struct Stop {
    int row = 0;
    int column = 0;
    int side = 0;
    /// Order within the side.
    int order = 0;
    int chain = 0;
    bool enters = false;
    /// Numbers of the parts of the side before and after the stop.
    int part_before = 0;
    int part_after = 0;
    /// The segment that crosses here, and which way.
    int segment = 0;
    bool forward = false;
  };

  /// Neighbouring cells of a row: one that the outline enters, or cells that lie wholly inside.
  struct Span {
    int first_column = 0;
    int last_column = 0;
    /// Copy of the first column's cell; the next columns' follow.  For an entered cell the first of its copies.
    int first_copy = 0;
    /// Range of stops; empty for cells wholly inside.
    int first_stop = 0;
    int last_stop = 0;
    /// For an entered cell the ports on sides that the outline does not cross, or −1.
    int open_side[4] = {-1, -1, -1, -1};

    bool entered() const { return first_stop != last_stop; }
  };

  Grid grid;
  /// Positive signed area.
  ClosedCurve outline;
  std::vector<Copy> copies;
  std::vector<Port> ports;
  /// In the outline's order; the last one goes on through s = 0 to the first one's start.
  std::vector<Chain> chains;
  std::vector<Stop> stops;
  /// By row and column; row r's are first_span_of_row[r − first_row] … [r − first_row + 1].
  std::vector<Span> spans;
  std::vector<int> first_span_of_row;
  int first_row = 0;

  int copy_count() const { return static_cast<int>(copies.size()) - 1; }
  /// Ports of the copy before and after a port, going round.
  int next_port(int port) const {
    const int copy = ports[port].copy;
    return port + 1 == copies[copy + 1].first_port ? copies[copy].first_port : port + 1;
  }
  int previous_port(int port) const {
    const int copy = ports[port].copy;
    return port == copies[copy].first_port ? copies[copy + 1].first_port - 1 : port - 1;
  }
  /// The chain at arc length s, 0 ≤ s < length.
  int chain_at(double s) const;
  /// The span that holds a cell, or null when the region does not touch the cell.
  const Span* span_of(int column, int row) const;
  /// The copy that holds a point of the region, exactly (but for points on the outline, which may go either way).
  std::optional<int> copy_at(Point p) const;

  /// The copy's corner 0, px.
  Point corner_of(int copy) const { return grid.corner(copies[copy].column, copies[copy].row); }
};

/// Cuts the inside of `outline` along `grid`.
/// @param outline  positive signed area; must cross the grid.
/// @errors mesh.too-many-vertices, mesh.not-simple, cancelled.
Result<CellCopies> cut_into_copies(const ClosedCurve& outline, const Grid& grid, const Watch& watch);

/// The most vertices a mesh may have, and the most crossings of outline and grid.
inline constexpr std::int64_t kMostMeshVertices = 1'000'000;
inline constexpr std::int64_t kMostGridCrossings = 4'000'000;
Error too_many_vertices();

} // namespace oversketch
