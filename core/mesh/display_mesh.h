#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/region_mesh.h"

#include <vector>

namespace oversketch {

/// A fine mesh of a region and the place of each of its vertices in the control mesh that it follows.
struct DisplayMesh {
  /// Every copy of a display cell that the region touches, in source pixels.
  QuadMesh mesh;
  /// For each vertex its place in the control mesh.  u, v are multiples of 1/divisions within 0…1; with a kTrimmed
  /// control mesh they reach −1…2 where the control copy was removed.
  std::vector<CellPoint> in_control;
  /// Display cells along one side of a control cell.
  int divisions = 1;
};

/// Meshes the control mesh's region again with finer cells, each copy within one control copy.
///
/// The display cell is the control cell divided by the smallest whole number that makes it at most `cell_px`, on the
/// same grid; a `cell_px` larger than the control cell gives the control cell.  So neighbouring arms stay apart at
/// least as far as in the control mesh, and a vertex that display cells share has one place only.
///
/// @param cell_px  wanted side of a display cell, source px.
/// @errors mesh.cell, mesh.too-many-vertices, cancelled.
/// @cost as make_region_mesh.
Result<DisplayMesh> make_display_mesh(const RegionMesh& control, double cell_px, const Watch& watch = {});

/// Where the display vertices go when the control vertices go to `positions`: one bilinear evaluation a vertex.
/// Reproduces similarities and affine maps (up to rounding).
/// @param control    the mesh that `display` was made for.
/// @param positions  one for each control vertex.
/// @cost about 10 ns a display vertex.
Points prolong(const QuadMesh& control, const Points& positions, const DisplayMesh& display);

} // namespace oversketch
