#pragma once

#include "core/geometry/curve.h"
#include "core/mesh/grid.h"

#include <cstdint>
#include <vector>

namespace oversketch {

/// Where an outline crosses a grid line, that is an edge between two neighbouring cells.
struct GridCrossing {
  /// Of a vertical line (from column to column) or a horizontal one.
  bool vertical = false;
  /// Towards larger coordinates or smaller ones.
  bool forward = false;
  /// The line, and the row (column) of the edge along a vertical (horizontal) line.
  int line = 0;
  int along = 0;
  /// Segment of the outline.
  int segment = 0;
  /// Arc length of the outline, px; increases from crossing to crossing.
  double s = 0;
  /// Coordinate along the line, px.
  double position = 0;
  /// Place in the order by edge and, on an edge, by coordinate; and the number of the edge in that order.
  int rank = 0;
  int edge = 0;

  /// The point of the crossing.
  Point at(const Grid& grid) const { return vertical ? Point{grid.x(line), position} : Point{position, grid.y(line)}; }
  /// The parts of an edge between neighbouring crossings are numbered through all edges: the one at smaller coordinates
  /// than this crossing, and the one at larger ones.
  int part_before() const { return rank + edge; }
  int part_after() const { return rank + edge + 1; }
};

/// How often the outline crosses the grid; saturates far above any limit.
std::int64_t count_crossings(const ClosedCurve& outline, const Grid& grid);

/// All crossings in the outline's order, exactly: which lines a segment crosses in which order, and how crossings
/// follow each other along an edge, is decided by orientation signs.  The lines count as lying at x − ε and y − ε² with
/// ε → 0, so that no point of the outline lies on a line and no segment passes through a grid corner.
///
/// @param outline  positive signed area.
/// @returns none when the crossings of an edge do not lead into and out of the region by turns: the outline is not
/// simple.
std::optional<std::vector<GridCrossing>> find_crossings(const ClosedCurve& outline, const Grid& grid);

} // namespace oversketch
