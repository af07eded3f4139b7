#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/paper_dense.h"
#include "core/deform/paper_energy.h"

#include <cstdint>
#include <span>
#include <vector>

namespace oversketch {

/// A sparse Hermitian matrix M with all unknowns but some eliminated: the Schur complement
///   S = M_CC − M_CI M_II⁻¹ M_IC   of the kept unknowns C, dense, and the way back, w_I = −M_II⁻¹ M_IC w_C.
///
/// Multifrontal Cholesky factorization (Duff, Reid, The multifrontal solution of indefinite sparse symmetric linear
/// systems, ACM TOMS 9, 1983): neighbouring columns of the factor with the same rows are one dense front.
/// @threads const.
class Elimination {
public:
  /// @param matrix  both triangles; of each mirrored pair of entries one is read.  M_II must be positive definite
  /// (CHECK).
  /// @param kept    distinct, at least one (CHECK); C in this order.
  /// @errors cancelled.
  /// @cost stages "symbolic" and "factor" of watch.times; about as much as factoring M whole, kept unknowns last.
  [[nodiscard]] static Result<Elimination> make(const ComplexMatrix& matrix, std::span<const int> kept, Lanes lanes,
                                                const Watch& watch);

  const SplitMatrix& complement() const { return complement_; }
  /// Entries of the eliminated columns of the factor.
  std::int64_t entries() const { return static_cast<std::int64_t>(values_.size() / 2); }

  /// All unknowns, from the kept ones.  @cost entries() complex products.
  [[nodiscard]] ComplexVector extend(const ComplexVector& kept) const;

private:
  /// Columns [first, first + columns) of the factor and their rows below, in the new order, ascending.
  struct Front {
    int first = 0;
    int columns = 0;
    std::vector<int> rows;
    /// Fronts whose remainder is added to this one.
    std::vector<int> children;
    /// Where its columns start in values_: of each column the real parts of its columns + rows entries, then the
    /// imaginary ones.
    std::size_t start = 0;

    int size() const { return columns + static_cast<int>(rows.size()); }
  };

  void find_order(const ComplexMatrix& matrix, std::span<const int> kept);
  void find_fronts(const ComplexMatrix& matrix);
  Result<void> eliminate(const ComplexMatrix& matrix, Lanes lanes, const Watch& watch);

  /// order_[new] = old, place_[old] = new; the kept unknowns last.
  std::vector<int> order_;
  std::vector<int> place_;
  int eliminated_ = 0;
  std::vector<Front> fronts_;
  /// Fronts whose remainder is added to the complement.
  std::vector<int> roots_;
  std::vector<double> values_;
  SplitMatrix complement_;
};

} // namespace oversketch
