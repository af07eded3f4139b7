#include "core/deform/paper_handles.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oversketch {
namespace {

using Complex = std::complex<double>;

/// Above, the dense form's elimination and its 32 c² bytes outweigh what it saves an iteration.
constexpr double kMostReducedHandles = 2000;
constexpr double kMostSquaredHandlesPerVertex = 60;

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

ComplexVector describe_shape(const Points& vertices, std::span<const int> handles) {
  ComplexVector shape(static_cast<Eigen::Index>(handles.size()));
  for (std::size_t i = 0; i < handles.size(); ++i)
    shape[i] = to_complex(vertices[handles[i]] - vertices[handles[0]]);
  shape.array() -= shape.mean();
  return shape / shape.norm();
}

} // namespace

HandleForm choose_form(int vertices, int handles) {
  const bool compact = static_cast<double>(handles) * handles <= kMostSquaredHandlesPerVertex * vertices;
  return compact && handles <= kMostReducedHandles ? HandleForm::kReduced : HandleForm::kSparse;
}

HandleSystem::HandleSystem(std::shared_ptr<const Shared> shared, double handle_weight)
    : shared_(std::move(shared)), handle_weight_(handle_weight) {}

Result<HandleSystem> HandleSystem::make(const QuadMesh& mesh, std::span<const int> handles, double handle_weight,
                                        const Watch& watch, std::optional<HandleForm> form) {
  if (const auto fine = check_handle_weight(handle_weight); !fine) return fine.error();
  check_handles(handles, mesh.vertices.size());
  auto shared = std::make_shared<Shared>();
  shared->handles.assign(handles.begin(), handles.end());
  std::vector<int>& corners = shared->corners;
  {
    const StageTimer timer(watch.times, "matrix");
    shared->energy = make_energy_operator(mesh);
    const ComplexMatrix adjoint = shared->energy.adjoint();
    shared->normal = adjoint * shared->energy;
    shared->shape = describe_shape(mesh.vertices, handles);
    corners = shared->handles;
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    shared->handles_at.assign(corners.size(), 0);
    for (const int vertex : handles) {
      const auto at = std::lower_bound(corners.begin(), corners.end(), vertex) - corners.begin();
      shared->corner_of.push_back(static_cast<int>(at));
      shared->handles_at[at] += 1;
    }
  }
  if (watch.stopped()) return cancelled();
  const int vertices = static_cast<int>(mesh.vertices.size());
  if (form.value_or(choose_form(vertices, static_cast<int>(corners.size()))) == HandleForm::kSparse) {
    const StageTimer timer(watch.times, "symbolic");
    shared->pattern = analyse(shared->normal);
  } else {
    Result<Elimination> made = Elimination::make(shared->normal, corners, widest_lanes(), watch);
    if (!made) return made.error();
    shared->elimination = *std::move(made);
    shared->normal = {};
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
  HandleSystem out(std::move(shared), handle_weight);
  const double weight = handle_weight * handle_weight;
  if (out.shared_->elimination) {
    std::vector<double> added = out.shared_->handles_at;
    for (double& value : added)
      value *= weight;
    auto made = DenseFactor::make(out.shared_->elimination->complement(), added, widest_lanes(), watch);
    if (!made) return made.error();
    out.reduced_ = std::make_shared<const DenseFactor>(*std::move(made));
  } else {
    ComplexMatrix matrix = out.shared_->normal;
    for (const int i : out.shared_->handles)
      matrix.coeffRef(i, i) += weight;
    auto made = CholeskyFactor::make(matrix, out.shared_->pattern, watch);
    if (!made) return made.error();
    out.sparse_ = std::make_shared<const CholeskyFactor>(*std::move(made));
  }
  return out;
}

std::int64_t HandleSystem::factor_entries() const {
  if (sparse_) return sparse_->pattern().entries();
  const std::int64_t dense = reduced_->size();
  return shared_->elimination->entries() + dense * (dense + 1) / 2;
}

std::vector<Complex> HandleSystem::respond_everywhere(const ComplexVector& h) const {
  const std::vector<int>& place = sparse_->pattern().place;
  const double weight = handle_weight_ * handle_weight_;
  std::vector<Complex> x(shared_->energy.rows());
  for (int i = 0; i < handle_count(); ++i)
    x[place[shared_->handles[i]]] += weight * h[i];
  sparse_->solve_permuted(x);
  return x;
}

ComplexVector HandleSystem::respond_at_corners(const ComplexVector& h) const {
  const double weight = handle_weight_ * handle_weight_;
  std::vector<double> re(reduced_->padded()), im(reduced_->padded());
  for (int i = 0; i < handle_count(); ++i) {
    re[shared_->corner_of[i]] += weight * h[i].real();
    im[shared_->corner_of[i]] += weight * h[i].imag();
  }
  reduced_->solve(re, im);
  ComplexVector out(reduced_->size());
  for (int k = 0; k < reduced_->size(); ++k)
    out[k] = {re[k], im[k]};
  return out;
}

ComplexVector HandleSystem::respond(const ComplexVector& h) const {
  ComplexVector out(handle_count());
  if (reduced_) {
    const ComplexVector at_corners = respond_at_corners(h);
    for (int i = 0; i < handle_count(); ++i)
      out[i] = at_corners[shared_->corner_of[i]];
  } else {
    const std::vector<Complex> x = respond_everywhere(h);
    const std::vector<int>& where = sparse_->pattern().place;
    for (int i = 0; i < handle_count(); ++i)
      out[i] = x[where[shared_->handles[i]]];
  }
  return out;
}

ComplexVector HandleSystem::place(const ComplexVector& h) const {
  CHECK(h.size() == handle_count(), "one target a handle");
  // A shift passes through unchanged (w(h + t) = w(h) + t), so that rounding can follow the size of the shape alone.
  const Complex centre = h.mean();
  const ComplexVector centred = h.array() - centre;
  if (reduced_) {
    return (shared_->elimination->extend(respond_at_corners(centred)).array() + centre).matrix();
  }
  const std::vector<Complex> x = respond_everywhere(centred);
  const std::vector<int>& where = sparse_->pattern().place;
  ComplexVector out(vertex_count());
  for (int i = 0; i < vertex_count(); ++i)
    out[i] = x[where[i]] + centre;
  return out;
}

HandleSystem::Slope HandleSystem::slope(const ComplexVector& h) const {
  CHECK(h.size() == handle_count(), "one target a handle");
  ComplexVector rest = h.array() - h.mean();
  rest -= shared_->shape.dot(rest) * shared_->shape;
  const ComplexVector positions = respond(rest);
  const ComplexVector missed = rest - positions;
  const double weight = handle_weight_ * handle_weight_;
  return {weight * positions.dot(missed).real(), 2 * weight * respond(missed)};
}

} // namespace oversketch
