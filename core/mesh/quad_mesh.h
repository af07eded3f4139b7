#pragma once

#include "core/geometry/point.h"

#include <array>
#include <vector>

namespace oversketch {

/// Quads over a set of vertices.  Corners run 0 = (0,0), 1 = (1,0), 2 = (1,1), 3 = (0,1) of the cell's local (u, v):
/// clockwise on the screen.  Every cell is a square of side `cell` in the source; a deformed mesh has the same cells
/// and other vertices.
struct QuadMesh {
  Points vertices;
  std::vector<std::array<int, 4>> cells;
  /// Side of a cell, source pixels.
  double cell = 0;
  /// Part of each cell's area that the region covers, 0…1; 0 only where its outline runs along a grid line.
  std::vector<double> coverage;
};

/// A point inside a cell: bilinear weights (1−u)(1−v), u(1−v), uv, (1−u)v of its four corners.
struct CellPoint {
  int cell = 0;
  double u = 0;
  double v = 0;
};

/// Where the point lies in a mesh whose vertices are `positions`.
inline Point locate(const QuadMesh& mesh, const Points& positions, CellPoint at) {
  const auto& c = mesh.cells[static_cast<std::size_t>(at.cell)];
  const auto p = [&](int k) { return positions[static_cast<std::size_t>(c[static_cast<std::size_t>(k)])]; };
  return (1 - at.v) * ((1 - at.u) * p(0) + at.u * p(1)) + at.v * ((1 - at.u) * p(3) + at.u * p(2));
}

} // namespace oversketch
