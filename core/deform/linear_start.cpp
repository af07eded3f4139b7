#include "core/deform/linear_start.h"

#include "core/base/check.h"

#include <complex>
#include <vector>

namespace oversketch {
namespace {

constexpr double kHandleWeight = 0.05;

} // namespace

Result<LinearStart> LinearStart::make(const QuadMesh& mesh, std::vector<MeshTie> ties, const Watch& watch) {
  const ComplexMatrix energy = make_energy_operator(mesh);
  std::vector<Eigen::Triplet<std::complex<double>>> entries;
  for (const MeshTie& tie : ties)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l)
        entries.emplace_back(mesh.cells[tie.cell][k], mesh.cells[tie.cell][l],
                             kHandleWeight * tie.weights[k] * tie.weights[l]);
  ComplexMatrix handles(energy.rows(), energy.cols());
  handles.setFromTriplets(entries.begin(), entries.end());
  const ComplexMatrix adjoint = energy.adjoint();
  const ComplexMatrix matrix = ComplexMatrix(adjoint * energy) + handles;
  auto factor = CholeskyFactor::make(matrix, analyse(matrix), watch);
  if (!factor) return factor.error();
  return LinearStart(mesh, std::move(ties), std::move(*factor));
}

Points LinearStart::solve(const Points& handles) const {
  CHECK(handles.size() == ties_.size(), "one handle a tie");
  const auto& place = factor_.pattern().place;
  std::vector<std::complex<double>> x(place.size());
  for (std::size_t i = 0; i < ties_.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      x[place[cells_[ties_[i].cell][k]]] += kHandleWeight * ties_[i].weights[k] * to_complex(handles[i]);
  factor_.solve_permuted(x);
  Points out(x.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = to_point(x[place[i]]);
  return out;
}

} // namespace oversketch
