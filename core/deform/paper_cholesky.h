#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/paper_energy.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace oversketch {

/// Where the factor L of a Hermitian matrix has its entries: the part of a Cholesky factorization P M Pᵀ = L Lᴴ that
/// depends on the pattern alone.  Columns sorted by row, the diagonal first.
struct CholeskyPattern {
  /// order[new] = old, place[old] = new: the approximate minimum degree ordering.
  std::vector<int> order;
  std::vector<int> place;
  std::vector<std::int64_t> column_start;
  std::vector<int> rows;

  int size() const { return static_cast<int>(order.size()); }
  std::int64_t entries() const { return static_cast<std::int64_t>(rows.size()); }
};

/// @param matrix  square, symmetric pattern, both triangles stored, a full diagonal (CHECK).
/// @cost O(entries of L) besides the ordering.  @threads a pure function.
[[nodiscard]] std::shared_ptr<const CholeskyPattern> analyse(const ComplexMatrix& matrix);

/// Cholesky factor of a Hermitian positive definite complex matrix.
///
/// Complex n × n instead of real 2n × 2n: half the entries and half the arithmetic for what the paper's matrices are.
/// @threads const; one factor may serve several threads.
class CholeskyFactor {
public:
  /// Up-looking factorization.  Of each mirrored pair of entries one is read, of the diagonal only the real part (the
  /// imaginary one is rounding).
  /// @param pattern  of this matrix.  Not positive definite is a bug (CHECK): no matrix of this project can be.
  /// @errors cancelled.
  [[nodiscard]] static Result<CholeskyFactor> make(const ComplexMatrix& matrix,
                                                   std::shared_ptr<const CholeskyPattern> pattern, const Watch& watch);

  const CholeskyPattern& pattern() const { return *pattern_; }
  const std::shared_ptr<const CholeskyPattern>& shared_pattern() const { return pattern_; }

  /// Solves in place; `x` holds the right-hand side in the order of the pattern: x[place[i]] belongs to unknown i.
  /// @cost 2 · entries complex products.
  void solve_permuted(std::vector<std::complex<double>>& x) const;

private:
  CholeskyFactor() = default;

  std::shared_ptr<const CholeskyPattern> pattern_;
  std::vector<std::complex<double>> values_;
};

} // namespace oversketch
