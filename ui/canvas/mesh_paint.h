#pragma once

#include "core/deform/metrics.h"
#include "core/mesh/quad_mesh.h"
#include "ui/canvas/paint.h"

#include <array>
#include <memory>
#include <vector>

namespace oversketch {

/// What is derived of a mesh and its deformation for drawing; made anew when either is another one.
struct MeshCache {
  /// Held, so that their addresses name them.
  std::shared_ptr<const QuadMesh> mesh;
  std::shared_ptr<const Points> positions;
  /// Each edge once.
  std::vector<std::array<int, 2>> edges;
  std::vector<CellDistortion> cells;
  /// Median of the cells' det: what counts as no change of area.
  double usual_det = 1;
  /// Vertices on the screen; of the present call only.
  std::vector<ImVec2> screen;

  void update(const std::shared_ptr<const QuadMesh>& new_mesh, const std::shared_ptr<const Points>& new_positions);
};

/// The mesh's vertices on the screen: kept in cache.screen for the functions below.
/// @param place  from the positions' space to the canvas's picture.
void project(const CanvasPaint& paint, const Points& positions, const Similarity& place, MeshCache& cache);

/// Every edge as a thin line.  Fades where cells come near to a pixel in size, and is left out below.
void draw_mesh_edges(const CanvasPaint& paint, const MeshCache& cache, PackedColor color, float width);

enum class CellColor { kSigma, kArea, kFlipped };

/// Fills cells: by σ1/σ2 (calm at 1, alarming from 2 on), by area (calm as usual, alarming at a quarter and four times
/// of that), or those that are flipped, red.
void draw_mesh_cells(const CanvasPaint& paint, const MeshCache& cache, CellColor by);

/// Unconnected lines, many of them, in one go: two points each, screen pixels.
void draw_line_pairs(const CanvasPaint& paint, std::span<const ImVec2> ends, PackedColor color, float width_px);

} // namespace oversketch
