#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/paper_cholesky.h"
#include "core/mesh/quad_mesh.h"

#include <array>
#include <optional>
#include <vector>

namespace oversketch {

/// A point tied to the mesh: bilinear weights of the four corners of a cell.
struct MeshTie {
  int cell = 0;
  std::array<double, 4> weights{};
};

/// The quadratic start of the flip-free solver: minimises  ‖A_d w‖² + ω² Σ_i |Σ_k weight_ik w_k − h_i|²  with the
/// energy of Eitz, Sorkine, Alexa 2007 (make_energy_operator()), ω² = 0.05: softly, since it is a start.  Similarities
/// come out exactly.
///
/// The matrix depends on mesh and ties alone: factored once, one pair of triangular solves a start.
/// @threads const; safe to share.
class LinearStart {
public:
  /// @errors cancelled.  @cost about 5 ms at 900 vertices.
  static Result<LinearStart> make(const QuadMesh& mesh, std::vector<MeshTie> ties, const Watch& watch);

  /// @param handles  where each tie should go.
  /// @returns one position a vertex.  @cost about 0.3 ms at 900 vertices.
  Points solve(const Points& handles) const;

private:
  LinearStart(const QuadMesh& mesh, std::vector<MeshTie> ties, CholeskyFactor factor)
      : cells_(mesh.cells), ties_(std::move(ties)), factor_(std::move(factor)) {}

  std::vector<std::array<int, 4>> cells_;
  std::vector<MeshTie> ties_;
  CholeskyFactor factor_;
};

} // namespace oversketch
