#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oversketch {

/// How many numbers the dense kernels take at a time.  Every element sees the same operations in the same order either
/// way, so that the results are the same to the last bit.
enum class Lanes { kTwo, kFour };
/// The most that this processor has.
[[nodiscard]] Lanes widest_lanes();

/// The lower triangle of a Hermitian matrix, by columns, real and imaginary parts apart: vectors of either are then
/// contiguous.  Rows and columns are filled up with zeros to a multiple of four.
class SplitMatrix {
public:
  SplitMatrix() = default;
  /// All zeros.  Memory: about 16 size² bytes.
  explicit SplitMatrix(int size) { reset(size); }
  /// Zeros of another size, in the same memory where that is enough.
  void reset(int size);

  int size() const { return size_; }
  int padded() const { return (size_ + 3) / 4 * 4; }
  /// The greatest size that reset() takes without new memory.
  int room() const { return room_; }
  double* re(int column) { return values_.data() + 2 * stride_ * column; }
  double* im(int column) { return re(column) + stride_; }
  const double* re(int column) const { return values_.data() + 2 * stride_ * column; }
  const double* im(int column) const { return re(column) + stride_; }
  /// From a column's real part to its imaginary part, and from there to the next column.
  std::ptrdiff_t stride() const { return stride_; }

private:
  int size_ = 0;
  int room_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<double> values_;
};

/// The first `columns` steps of the Cholesky factorization of a matrix [A Bᴴ; B C] that is positive definite in A:
/// on return L with L Lᴴ = A, then B L⁻ᴴ below it, and C − B A⁻¹ Bᴴ.  The upper triangle is not read and
/// ends undefined.
/// @errors cancelled; the matrix is then undefined.  A pivot that is not positive is a bug (CHECK).
/// @cost size³/6 complex products for all columns, 0.3–0.6 ns each.
[[nodiscard]] Result<void> factor_columns(SplitMatrix& matrix, int columns, Lanes lanes, const Watch& watch);

/// L with L Lᴴ = M + diag(added), dense.
/// @threads const; one factor may serve several threads.
class DenseFactor {
public:
  /// @param matrix  a copy is made of it.  @param added  one number a row.
  /// @errors cancelled.
  [[nodiscard]] static Result<DenseFactor> make(const SplitMatrix& matrix, std::span<const double> added, Lanes lanes,
                                                const Watch& watch);
  int size() const { return factor_.size(); }
  int padded() const { return factor_.padded(); }
  /// Solves in place.  @param re, im  padded() numbers each (CHECK), zero from size() on.
  /// @cost size² complex products.
  void solve(std::span<double> re, std::span<double> im) const;

private:
  DenseFactor() = default;

  /// Below the diagonal L, above it Lᴴ: both substitutions then run down columns.
  SplitMatrix factor_;
  std::vector<double> inverse_diagonal_;
  Lanes lanes_ = Lanes::kTwo;
};

} // namespace oversketch
