#pragma once

#include "core/mesh/quad_mesh.h"

#include <Eigen/SparseCore>

#include <complex>
#include <span>

namespace oversketch {

using ComplexMatrix = Eigen::SparseMatrix<std::complex<double>>;
using ComplexVector = Eigen::VectorXcd;

/// The matrix A_d of the deformation energy of Eitz, Sorkine, Alexa, Sketch Based Image Deformation, VMV 2007,
/// section 3.
///
/// Positions are complex numbers: z in the source, w deformed.  With N(i) the vertices joined to i by a cell's edge,
/// P_i = {i} ∪ N(i) and z̄ its mean,  row i gives  c_i δ_i − L(w)_i,  where
///   δ_i = z_i − mean_{N(i)} z,   L(w)_i = w_i − mean_{N(i)} w,   c_i = Σ_{k∈P_i} conj(z_k − z̄) w_k / Σ_{k∈P_i} |z_k −
///   z̄|²:
/// c_i is the factor of the similarity that fits P_i best in least squares.  The coordinates are centred on the patch's
/// mean, which the print leaves open; without it a translation would cost energy.  So E_d(w) = ‖A_d w‖² is 0 exactly
/// for similarities, has the unit of w squared, and depends neither on the source's origin, nor on its scale.
///
/// @param mesh  every vertex belongs to a cell, and the vertices of a cell are distinct (CHECK).
/// @returns n × n, about five entries a row.
/// @cost O(n).  @threads a pure function.
[[nodiscard]] ComplexMatrix make_energy_operator(const QuadMesh& mesh);

/// ‖A_d w‖².
[[nodiscard]] double measure_energy(const ComplexMatrix& energy_operator, const ComplexVector& positions);

} // namespace oversketch
