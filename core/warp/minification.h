#pragma once

#include "core/geometry/point.h"
#include "core/mesh/quad_mesh.h"
#include "core/warp/cell_inverse.h"

#include <array>
#include <vector>

namespace oversketch {

/// How a deformed mesh shrinks its source, so that what is shrunk can be averaged.
///
/// At each vertex the Jacobian J of the map from the target back to the source is that of the cells that meet there
/// (the inverse of the mean of their forward Jacobians; where some are turned over, of those that lie the way most do).
/// Its larger singular value σ is how many source pixels a target pixel reaches across, and decides the stage:
///
///     stage 0      σ ≤ 1.5       the source, sampled once
///     stage k ≥ 1  σ ≤ 2ᵏ        the mean of four bilinear samples of pyramid level k − 1, at J (±¼, ±¼) from the
///     point
///
/// and over σ = 1.5 … 1.75, 2ᵏ … 1.25 · 2ᵏ a stage goes over into the next, linearly: the four samples are never much
/// farther apart than the pixels of their level, so nothing between them is missed.  Stages and J are bilinear within a
/// cell, hence continuous all over the mesh.
///
/// Where a region is shrunk in one direction alone, the four samples are spread along it; across it the level's pixels,
/// 0.5 … 0.8 σ wide, average more than they need: nothing aliases, and what is shrunk so is softer that way.
class Minification {
public:
  struct Vertex {
    double stage = 0;
    /// A quarter of the source's way for a pixel to the right, and downwards.
    Point along_x, along_y;
  };

  /// @param top  the last level of the source's pyramid.
  Minification(const QuadMesh& mesh, const Points& deformed, int top);

  /// Whether any vertex is beyond stage 0.
  bool shrinks() const { return shrinks_; }
  /// Whether any corner of the cell is beyond stage 0.
  bool touches(int cell) const { return touched_[static_cast<std::size_t>(cell)] != 0; }
  /// Of a cell's corners, in their order.
  std::array<Vertex, 4> corners(int cell) const;

private:
  const QuadMesh& mesh_;
  std::vector<Vertex> vertices_;
  std::vector<char> touched_;
  bool shrinks_ = false;
};

/// The stage for σ, a real number: 1.25 is three parts stage 1 and one part stage 2.
double minification_stage(double sigma);

} // namespace oversketch
