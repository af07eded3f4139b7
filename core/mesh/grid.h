#pragma once

#include "core/geometry/point.h"

namespace oversketch {

/// The square grid a region is cut by: fine cells, `divisions` of them along the side of a coarse cell.
///
/// Vertical line k lies at x(k), horizontal line k at y(k), k any whole number; the cell (column, row) lies between
/// lines column and column + 1, row and row + 1.  Every divisions-th line has, to the bit, the coordinate of a line of
/// the coarse grid, so that cells of the fine grid nest in those of the coarse one.
struct Grid {
  /// Crossing of the coarse lines 0.
  Point origin;
  /// Side of a coarse cell, px.
  double coarse_cell = 0;
  int divisions = 1;

  /// Side of a cell, px.
  double cell() const { return coarse_cell / divisions; }
  double x(int line) const { return coordinate(origin.x, line); }
  double y(int line) const { return coordinate(origin.y, line); }
  Point corner(int column, int row) const { return {x(column), y(row)}; }
  /// The column and row of a point: a line belongs to the cell on its larger side.
  int column(double at_x) const { return between(origin.x, at_x); }
  int row(double at_y) const { return between(origin.y, at_y); }
  /// The coarse column (or row) that holds a fine one, and the place of the fine one in it, 0…divisions − 1.
  int coarse(int line) const { return (line >= 0 ? line : line - divisions + 1) / divisions; }
  int within(int line) const { return line - coarse(line) * divisions; }

private:
  double coordinate(double start, int line) const {
    return (start + coarse(line) * coarse_cell) + within(line) * (coarse_cell / divisions);
  }
  int between(double start, double at) const {
    int line = static_cast<int>(std::floor((at - start) / cell()));
    while (at < coordinate(start, line))
      --line;
    while (at >= coordinate(start, line + 1))
      ++line;
    return line;
  }
};

/// The grid of whole cells of side `cell_px` centred on `box`, with a margin on every side.
/// @pre the box is at most 2,000,000 cells wide and high.
Grid centred_grid(const Box& box, double cell_px);

} // namespace oversketch
