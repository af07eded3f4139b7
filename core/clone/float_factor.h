#pragma once

#include "core/clone/float4.h"

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace oversketch {

/// L of a sparse Cholesky factorization A = L Lᵀ, kept in float and made for substituting four right-hand sides often.
///
/// Columns that follow one another and have nearly the same rows share one list of them (supernodes, relaxed: the few
/// places that only some of the columns have are stored as zeros), and are passed over four at a time.  Those of equal
/// height in the elimination tree come one after the other: none waits for the one before.
class FloatFactor {
public:
  FloatFactor() = default;
  /// @param lower  L, rows sorted, the diagonal first in each column.
  explicit FloatFactor(const Eigen::SparseMatrix<double>& lower);

  int size() const { return static_cast<int>(inverse_.size()); }
  std::int64_t bytes() const;

  /// x = L⁻ᵀ L⁻¹ x, size() values.
  /// @cost two passes over the factor, about 0.5 ns an entry.
  void substitute(Float4* x) const;
  /// The same bits, by what every processor has.
  void substitute_plainly(Float4* x) const;

private:
  /// Columns first ≤ j < last; each has an entry for every later column of the block, then one for each of the rows.
  struct Block {
    int first = 0;
    int last = 0;
    std::int64_t entries = 0;
    std::int64_t rows = 0;
    int row_count = 0;
  };
  class Substitution;
  void substitute_by_avx2(Float4* x) const;
  void add_block(const Eigen::SparseMatrix<double>& lower, int first, int last);

  /// In the order in which they are passed over.
  std::vector<Block> blocks_;
  std::vector<int> rows_;
  std::vector<float> entries_;
  /// 1 / L_jj.
  std::vector<float> inverse_;
};

} // namespace oversketch
