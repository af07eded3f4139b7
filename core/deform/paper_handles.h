#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/paper_cholesky.h"
#include "core/deform/paper_energy.h"
#include "core/mesh/quad_mesh.h"

#include <memory>
#include <span>
#include <vector>

namespace oversketch {

/// The least weight of the handles that is taken, and the greatest.  The paper uses 0.1 to 1.  Below, the matrix's
/// condition grows as 1/ω²; above, the mesh meets its handles to 1e-4 and more changes nothing.
inline constexpr double kLeastHandleWeight = 0.01;
inline constexpr double kGreatestHandleWeight = 100;

/// A mesh whose boundary vertices are drawn by handles: the linear part of the paper's method (paper_energy.h).
///
/// w(h) minimises  E(w) = E_d(w) + ω² Σ_{i∈C} |w_i − h_i|²:   (A_dᴴA_d + ω² A_hᵀA_h) w = ω² A_hᵀ h,
/// with C the handles' vertices and A_h the matrix that picks them.  One factorization serves every h.
/// @threads const; copies share everything.
class HandleSystem {
public:
  /// @param handles  vertices that carry a handle, at least 2 different ones (CHECK); one that the boundary passes
  /// twice
  ///   carries two.  Every other vertex must be inside, that is, surrounded by four cells: then δ = 0 there and the
  ///   matrix is positive definite.
  /// @param handle_weight  ω, no unit.
  /// @errors deform.handle-weight outside [kLeastHandleWeight, kGreatestHandleWeight] or not a number; cancelled.
  /// @cost stages "matrix", "symbolic" and "factor" of watch.times.
  [[nodiscard]] static Result<HandleSystem> make(const QuadMesh& mesh, std::span<const int> handles,
                                                 double handle_weight, const Watch& watch);
  /// The same mesh with another ω: the numeric factorization alone.
  [[nodiscard]] Result<HandleSystem> with_handle_weight(double handle_weight, const Watch& watch) const;

  int vertex_count() const { return static_cast<int>(shared_->energy.rows()); }
  int handle_count() const { return static_cast<int>(shared_->handles.size()); }
  const std::vector<int>& handles() const { return shared_->handles; }
  double handle_weight() const { return handle_weight_; }
  const ComplexMatrix& energy_operator() const { return shared_->energy; }
  /// Entries of the factor, for reports.
  std::int64_t factor_entries() const { return factor_->pattern().entries(); }

  /// w(h): all n vertices.  @param h  one target for each handle, target pixels.
  [[nodiscard]] ComplexVector place(const ComplexVector& h) const;

  struct Evaluation {
    ComplexVector positions;
    /// E_d(w(h)), px².
    double energy = 0;
    /// Its gradient by h, one a handle: x and y as real and imaginary part, px.
    ComplexVector gradient;
  };
  /// w(h), the energy and  g = 2ω² A_h (A_dᴴA_d + ω² A_hᵀA_h)⁻¹ A_dᴴA_d w.  The product needs no matrix: A_dᴴA_d w
  /// equals ω² A_hᵀ (h − A_h w).
  /// @cost two back-substitutions.
  [[nodiscard]] Evaluation evaluate(const ComplexVector& h) const;

private:
  /// What does not depend on ω.
  struct Shared {
    ComplexMatrix energy;
    ComplexMatrix normal; // A_dᴴA_d
    std::vector<int> handles;
    std::shared_ptr<const CholeskyPattern> pattern;
  };

  HandleSystem(std::shared_ptr<const Shared> shared, double handle_weight, CholeskyFactor factor);
  static Result<HandleSystem> factor(std::shared_ptr<const Shared> shared, double handle_weight, const Watch& watch);
  /// ω² (A_dᴴA_d + ω² A_hᵀA_h)⁻¹ A_hᵀ h, in the pattern's order.
  std::vector<std::complex<double>> respond(const ComplexVector& h) const;

  std::shared_ptr<const Shared> shared_;
  double handle_weight_;
  std::shared_ptr<const CholeskyFactor> factor_;
};

} // namespace oversketch
