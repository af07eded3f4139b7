#pragma once

#include "core/deform/block_cholesky.h"
#include "core/mesh/quad_mesh.h"

#include <array>
#include <memory>
#include <vector>

namespace oversketch {

/// Cells covered less than this weigh as much as this: a sliver must not become free to collapse.
inline constexpr double kLeastCoverage = 0.15;

/// Distortion of a quad mesh whose cells are unit squares in the source (design note "deformation", section 3.4).
///
///   E(x) = Σ_cells w/4 Σ_corners F,   F = [2(p + q) + λ(D² + 1)] / χ(D),   χ = (D + √(ε² + D²)) / 2,   w =
///   max(coverage, 0.15)
/// with the corner's edges e1, e2 as complex numbers, a = (e1 − i e2)/2, b = (e1 + i e2)/2, p = |a|², q = |b|², D = p −
/// q the determinant.  ε = 0: MIPS (Hormann and Greiner 2000) + λ(D + 1/D), infinite where D ≤ 0; ε > 0 is finite
/// everywhere (Garanzha et al. 2021).  At a rotation F = 2 + 2λ, its least value.
/// @threads const; safe to share.
class DistortionEnergy {
public:
  struct Weights {
    double stiffness = 0.5;
    double epsilon = 0;
  };

  /// @param mesh  vertices of a cell are distinct; coverage for every cell.
  explicit DistortionEnergy(const QuadMesh& mesh);

  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  int vertices() const { return pattern_->size(); }
  const std::array<int, 4>& cell(int i) const { return cells_[i]; }
  /// Sum of the cells' weights: E of a rotation is this times 2 + 2λ.
  double total_weight() const { return total_weight_; }

  /// Infinite where ε = 0 and a corner's D ≤ 0.
  double value(const Points& x, const Weights& weights) const;
  /// Least D of any corner.
  double least_determinant(const Points& x) const;
  /// Cells with a corner of D ≤ 0 (or not a number).
  int count_flipped(const Points& x) const;
  /// Longest step t ≤ 1 along `direction` that leaves every corner more than 5 % of its D.  All D must be positive.
  double longest_step(const Points& x, const Points& direction) const;

  /// Adds the gradient, and the Hessian with each corner's projected to positive semidefinite (in closed form).
  void add_derivatives(const Points& x, const Weights& weights, Points& gradient, BlockCholesky& hessian) const;

  /// Adds factor · g_k g_l · q to the Hessian's blocks of the cell's corners k, l.
  /// @param q  symmetric, {xx, xy, yy}.
  void add_to_cell(int cell, const std::array<double, 4>& g, const std::array<double, 3>& q,
                   BlockCholesky& hessian) const;

private:
  std::vector<std::array<int, 4>> cells_;
  std::vector<double> weights_;
  double total_weight_ = 0;
  std::shared_ptr<const BlockPattern> pattern_;
  /// Blocks of each cell: (0,0) (1,1) (2,2) (3,3) (1,0) (2,0) (3,0) (2,1) (3,1) (3,2).
  std::vector<std::array<BlockPlace, 10>> places_;
};

} // namespace oversketch
