#pragma once

#include "core/clone/quadtree.h"

#include <Eigen/SparseCore>
#include <span>

namespace oversketch {

/// The pixel graph's energy Σ (u_p − u_q)² over neighbours p, q, at least one in the mask, u = 0 outside, restricted to
/// the functions of a quadtree: uᵀ A u for the unknowns u.  The lower triangle, rows sorted.
/// @param ring_leaves  the leaf (a single pixel) at the inner end of each pair with one pixel outside.
/// @cost O(leaves).
Eigen::SparseMatrix<double> membrane_matrix(const Quadtree& tree, std::span<const int> ring_leaves);

} // namespace oversketch
