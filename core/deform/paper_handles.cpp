#include "core/deform/paper_handles.h"

#include "core/base/check.h"

#include <cmath>
#include <utility>

namespace oversketch {
namespace {

using Complex = std::complex<double>;

Result<void> check_handle_weight(double handle_weight) {
  if (handle_weight >= kLeastHandleWeight && handle_weight <= kGreatestHandleWeight) return {};
  return Error{"deform.handle-weight", "the handle weight must be a number from 0.01 to 100", ""};
}

void check_handles(std::span<const int> handles, std::size_t vertices) {
  bool several = false;
  for (const int i : handles) {
    CHECK(i >= 0 && static_cast<std::size_t>(i) < vertices, "a handle's vertex must be one of the mesh's");
    several = several || i != handles.front();
  }
  CHECK(several, "a mesh needs handles at two vertices or more");
}

} // namespace

HandleSystem::HandleSystem(std::shared_ptr<const Shared> shared, double handle_weight, CholeskyFactor factor)
    : shared_(std::move(shared)),
      handle_weight_(handle_weight),
      factor_(std::make_shared<const CholeskyFactor>(std::move(factor))) {}

Result<HandleSystem> HandleSystem::make(const QuadMesh& mesh, std::span<const int> handles, double handle_weight,
                                        const Watch& watch) {
  if (const auto fine = check_handle_weight(handle_weight); !fine) return fine.error();
  check_handles(handles, mesh.vertices.size());
  auto shared = std::make_shared<Shared>();
  shared->handles.assign(handles.begin(), handles.end());
  {
    const StageTimer timer(watch.times, "matrix");
    shared->energy = make_energy_operator(mesh);
    const ComplexMatrix adjoint = shared->energy.adjoint();
    shared->normal = adjoint * shared->energy;
  }
  if (watch.stopped()) return cancelled();
  {
    const StageTimer timer(watch.times, "symbolic");
    shared->pattern = analyse(shared->normal);
  }
  return factor(std::move(shared), handle_weight, watch);
}

Result<HandleSystem> HandleSystem::with_handle_weight(double handle_weight, const Watch& watch) const {
  if (const auto fine = check_handle_weight(handle_weight); !fine) return fine.error();
  return factor(shared_, handle_weight, watch);
}

Result<HandleSystem> HandleSystem::factor(std::shared_ptr<const Shared> shared, double handle_weight,
                                          const Watch& watch) {
  const StageTimer timer(watch.times, "factor");
  ComplexMatrix matrix = shared->normal;
  for (const int i : shared->handles)
    matrix.coeffRef(i, i) += handle_weight * handle_weight;
  Result<CholeskyFactor> made = CholeskyFactor::make(matrix, shared->pattern, watch);
  if (!made) return made.error();
  return HandleSystem(std::move(shared), handle_weight, *std::move(made));
}

std::vector<Complex> HandleSystem::respond(const ComplexVector& h) const {
  CHECK(h.size() == handle_count(), "one target a handle");
  const std::vector<int>& place = factor_->pattern().place;
  const double weight = handle_weight_ * handle_weight_;
  std::vector<Complex> x(shared_->energy.rows());
  for (int i = 0; i < handle_count(); ++i)
    x[place[shared_->handles[i]]] += weight * h[i];
  factor_->solve_permuted(x);
  return x;
}

ComplexVector HandleSystem::place(const ComplexVector& h) const {
  // A shift passes through unchanged (w(h + t) = w(h) + t), so that rounding can follow the size of the shape alone.
  const Complex centre = h.mean();
  const std::vector<Complex> x = respond(h.array() - centre);
  const std::vector<int>& where = factor_->pattern().place;
  ComplexVector out(vertex_count());
  for (int i = 0; i < vertex_count(); ++i)
    out[i] = x[where[i]] + centre;
  return out;
}

HandleSystem::Evaluation HandleSystem::evaluate(const ComplexVector& h) const {
  Evaluation out;
  out.positions = place(h);
  out.energy = measure_energy(shared_->energy, out.positions);
  ComplexVector missed(handle_count());
  for (int i = 0; i < handle_count(); ++i)
    missed[i] = h[i] - out.positions[shared_->handles[i]];
  const std::vector<Complex> x = respond(missed);
  const std::vector<int>& where = factor_->pattern().place;
  const double twice = 2 * handle_weight_ * handle_weight_;
  out.gradient.resize(handle_count());
  for (int i = 0; i < handle_count(); ++i)
    out.gradient[i] = twice * x[where[shared_->handles[i]]];
  return out;
}

} // namespace oversketch
