#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/paper_cholesky.h"
#include "core/deform/paper_dense.h"
#include "core/deform/paper_elimination.h"
#include "core/deform/paper_energy.h"
#include "core/mesh/quad_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace oversketch {

/// The least weight of the handles that is taken, and the greatest.  The paper uses 0.1 to 1.  Below, the matrix's
/// condition grows as 1/ω²; above, the mesh meets its handles to 1e-4 and more changes nothing.
inline constexpr double kLeastHandleWeight = 0.01;
inline constexpr double kGreatestHandleWeight = 100;

/// How a HandleSystem solves its equations.
enum class HandleForm {
  /// Everything but the handles' vertices C eliminated once: dense c × c.  Independent of ω.
  kReduced,
  /// One sparse factor of all vertices for each ω.
  kSparse,
};

/// The form that is faster for a mesh of this many vertices, c of them with handles: kReduced where c² ≤ 60 n and
/// c ≤ 2000.  Compact regions have c² = 15…55 n, whatever the cell's size; long thin ones have more, and their sparse
/// factor few entries.  Depends on nothing else, so that the same mesh gives the same bits whatever was solved before.
[[nodiscard]] HandleForm choose_form(int vertices, int handles);

/// A mesh whose boundary vertices are drawn by handles: the linear part of the paper's method (paper_energy.h).
///
/// w(h) minimises  E(w) = E_d(w) + ω² Σ_{i∈C} |w_i − h_i|²:   (A_dᴴA_d + ω² A_hᵀA_h) w = ω² A_hᵀ h,
/// with C the handles' vertices and A_h the matrix that picks them.  One factorization serves every h.
///
/// In the reduced form S is the Schur complement of A_dᴴA_d on C:  (S + ω² D) w_C = ω² Pᵀ h, P the handles' vertices
/// among C, D = PᵀP; an iteration then is four dense triangular solves with c unknowns, another ω one dense
/// factorization, and the vertices inside follow from w_C.
/// @threads const; copies share everything.
class HandleSystem {
public:
  /// @param handles  vertices that carry a handle, at least 2 different ones (CHECK); one that the boundary passes
  /// twice
  ///   carries two.  Every other vertex must be inside, that is, surrounded by four cells: then δ = 0 there and the
  ///   matrix is positive definite.
  /// @param handle_weight  ω, no unit.
  /// @param form  none: choose_form().
  /// @errors deform.handle-weight outside [kLeastHandleWeight, kGreatestHandleWeight] or not a number; cancelled.
  /// @cost stages "matrix", "symbolic" and "factor" of watch.times.
  [[nodiscard]] static Result<HandleSystem> make(const QuadMesh& mesh, std::span<const int> handles,
                                                 double handle_weight, const Watch& watch,
                                                 std::optional<HandleForm> form = {});
  /// The same mesh with another ω: the numeric factorization alone, in the reduced form that of c × c.
  [[nodiscard]] Result<HandleSystem> with_handle_weight(double handle_weight, const Watch& watch) const;

  int vertex_count() const { return static_cast<int>(shared_->energy.rows()); }
  int handle_count() const { return static_cast<int>(shared_->handles.size()); }
  const std::vector<int>& handles() const { return shared_->handles; }
  double handle_weight() const { return handle_weight_; }
  HandleForm form() const { return reduced_ ? HandleForm::kReduced : HandleForm::kSparse; }
  const ComplexMatrix& energy_operator() const { return shared_->energy; }
  /// Entries of the factor, for reports.
  std::int64_t factor_entries() const;

  /// w(h): all n vertices.  @param h  one target for each handle, target pixels.
  [[nodiscard]] ComplexVector place(const ComplexVector& h) const;

  struct Slope {
    /// E_d(w(h)), px².
    double energy = 0;
    /// Its gradient by h, one a handle: x and y as real and imaginary part, px.
    ComplexVector gradient;
  };
  /// The energy and  g = 2ω² A_h (A_dᴴA_d + ω² A_hᵀA_h)⁻¹ A_dᴴA_d w.  The product needs no matrix: A_dᴴA_d w equals
  /// ω² A_hᵀ (h − A_h w), and E_d = wᴴ A_dᴴA_d w = ω² Re Σ_C conj(w_i) (h_i − w_i), so that the handles' vertices are
  /// enough.  The similarity nearest to h, which costs nothing, is taken off first: rounding follows what remains.
  /// @cost reduced: 2 c² complex products; sparse: two back-substitutions.
  [[nodiscard]] Slope slope(const ComplexVector& h) const;

private:
  /// What does not depend on ω.
  struct Shared {
    ComplexMatrix energy;
    std::vector<int> handles;
    /// Source positions at the handles, of mean 0 and length 1: with the constants all targets that cost nothing.
    ComplexVector shape;
    /// Reduced: the vertices with handles in ascending order, for each handle the place of its vertex among them, and
    /// how many handles each has.
    std::vector<int> corners;
    std::vector<int> corner_of;
    std::vector<double> handles_at;
    std::optional<Elimination> elimination;
    /// Sparse: A_dᴴA_d and its factor's pattern.
    ComplexMatrix normal;
    std::shared_ptr<const CholeskyPattern> pattern;
  };

  HandleSystem(std::shared_ptr<const Shared> shared, double handle_weight);
  static Result<HandleSystem> factor(std::shared_ptr<const Shared> shared, double handle_weight, const Watch& watch);
  /// ω² (A_dᴴA_d + ω² A_hᵀA_h)⁻¹ A_hᵀ h: in the pattern's order; at the corners; at the handles.
  std::vector<std::complex<double>> respond_everywhere(const ComplexVector& h) const;
  ComplexVector respond_at_corners(const ComplexVector& h) const;
  ComplexVector respond(const ComplexVector& h) const;

  std::shared_ptr<const Shared> shared_;
  double handle_weight_;
  /// One of the two.
  std::shared_ptr<const DenseFactor> reduced_;
  std::shared_ptr<const CholeskyFactor> sparse_;
};

} // namespace oversketch
