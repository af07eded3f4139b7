#include "core/deform/paper_dense.h"

#include "core/base/check.h"
#include "core/base/processor.h"

#include <algorithm>
#include <cmath>

// A function that may use four lanes; it must be called only where widest_lanes() says so.
#if defined(__x86_64__)
#define OVERSKETCH_FOUR_LANES __attribute__((target("avx2")))
#else
#define OVERSKETCH_FOUR_LANES
#endif

namespace oversketch {
namespace {

using Two = double __attribute__((vector_size(16), aligned(8), may_alias));
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));

/// Columns of a product are summed so many at a time, so that they stay in the nearest cache.
constexpr int kColumnsAtOnce = 128;
/// Columns that are brought up to date together.
constexpr int kBlock = 4;

/// Columns `block`… + 3 −= columns `first`…`last` − 1 times the conjugates of their rows `block`… + 3.
template <class V>
[[gnu::always_inline]] inline void subtract_product(SplitMatrix& a, int block, int first, int last) {
  const std::ptrdiff_t stride = a.stride();
  for (int i = block; i < a.padded(); i += static_cast<int>(sizeof(V) / sizeof(double))) {
    V re[kBlock] = {}, im[kBlock] = {};
    const double* from = a.re(first);
    for (int p = first; p < last; ++p, from += 2 * stride) {
      const V ar = *reinterpret_cast<const V*>(from + i), ai = *reinterpret_cast<const V*>(from + stride + i);
      for (int q = 0; q < kBlock; ++q) {
        const double br = from[block + q], bi = from[stride + block + q];
        re[q] += ar * br + ai * bi;
        im[q] += ai * br - ar * bi;
      }
    }
    for (int q = 0; q < kBlock; ++q) {
      *reinterpret_cast<V*>(a.re(block + q) + i) -= re[q];
      *reinterpret_cast<V*>(a.im(block + q) + i) -= im[q];
    }
  }
}

void subtract_two(SplitMatrix& a, int block, int first, int last) {
  subtract_product<Two>(a, block, first, last);
}

OVERSKETCH_FOUR_LANES void subtract_four(SplitMatrix& a, int block, int first, int last) {
  subtract_product<Four>(a, block, first, last);
}

/// x[from…to − 1] −= the columns `block`… + 3 times x[block]… + 3.  `from` and `to` are multiples of four.
template <class V>
[[gnu::always_inline]] inline void subtract_columns(const SplitMatrix& a, int block, int from, int to, double* re,
                                                    double* im) {
  const std::ptrdiff_t stride = a.stride();
  const double* column = a.re(block);
  double xr[kBlock], xi[kBlock];
  std::copy(re + block, re + block + kBlock, xr);
  std::copy(im + block, im + block + kBlock, xi);
  for (int i = from; i < to; i += static_cast<int>(sizeof(V) / sizeof(double))) {
    V sum_re = {}, sum_im = {};
    for (int q = 0; q < kBlock; ++q) {
      const V ar = *reinterpret_cast<const V*>(column + 2 * q * stride + i);
      const V ai = *reinterpret_cast<const V*>(column + (2 * q + 1) * stride + i);
      sum_re += ar * xr[q] - ai * xi[q];
      sum_im += ar * xi[q] + ai * xr[q];
    }
    *reinterpret_cast<V*>(re + i) -= sum_re;
    *reinterpret_cast<V*>(im + i) -= sum_im;
  }
}

/// x ← one unknown's value times the inverse of its diagonal, taken off the unknowns `from`…`to` − 1.
[[gnu::always_inline]] inline void take_off(const SplitMatrix& a, double inverse, int j, int from, int to, double* re,
                                            double* im) {
  const double xr = re[j] *= inverse, xi = im[j] *= inverse;
  for (int i = from; i < to; ++i) {
    const double ar = a.re(j)[i], ai = a.im(j)[i];
    re[i] -= ar * xr - ai * xi;
    im[i] -= ar * xi + ai * xr;
  }
}

template <class V>
[[gnu::always_inline]] inline void substitute(const SplitMatrix& a, const double* inverse, double* re, double* im) {
  const int rows = a.padded();
  for (int block = 0; block < rows; block += kBlock) {
    for (int j = block; j < block + kBlock; ++j)
      take_off(a, inverse[j], j, j + 1, block + kBlock, re, im);
    subtract_columns<V>(a, block, block + kBlock, rows, re, im);
  }
  for (int block = rows - kBlock; block >= 0; block -= kBlock) {
    for (int j = block + kBlock - 1; j >= block; --j)
      take_off(a, inverse[j], j, block, j, re, im);
    subtract_columns<V>(a, block, 0, block, re, im);
  }
}

void substitute_two(const SplitMatrix& a, const double* inverse, double* re, double* im) {
  substitute<Two>(a, inverse, re, im);
}

OVERSKETCH_FOUR_LANES void substitute_four(const SplitMatrix& a, const double* inverse, double* re, double* im) {
  substitute<Four>(a, inverse, re, im);
}

/// Inside four columns that have had everything left of them taken off.
void finish_block(SplitMatrix& a, int block, int columns) {
  const int rows = a.padded();
  for (int j = block; j < std::min(block + kBlock, a.size()); ++j) {
    double *re = a.re(j), *im = a.im(j);
    for (int p = block; p < std::min(j, columns); ++p) {
      const double *ar = a.re(p), *ai = a.im(p), br = ar[j], bi = ai[j];
      for (int i = j; i < rows; ++i) {
        re[i] -= ar[i] * br + ai[i] * bi;
        im[i] -= ai[i] * br - ar[i] * bi;
      }
    }
    if (j >= columns) continue;
    CHECK(re[j] > 0, "the matrix must be positive definite");
    const double root = std::sqrt(re[j]), inverse = 1 / root;
    re[j] = root;
    im[j] = 0;
    for (int i = j + 1; i < rows; ++i) {
      re[i] *= inverse;
      im[i] *= inverse;
    }
  }
}

} // namespace

Lanes widest_lanes() {
  return has_avx2() ? Lanes::kFour : Lanes::kTwo;
}

void SplitMatrix::reset(int size) {
  size_ = size;
  // An odd number of cache lines from column to column, so that a row's elements fall into all sets of the cache.
  stride_ = 4 * (((size + 3) / 4) | 1);
  if (size > room_) {
    room_ = size;
    values_ = std::vector<double>(static_cast<std::size_t>(2 * stride_ * padded()));
  }
  for (int j = 0; j < padded(); ++j) {
    const int first = j / 4 * 4;
    std::fill(re(j) + first, re(j) + padded(), 0.0);
    std::fill(im(j) + first, im(j) + padded(), 0.0);
  }
}

Result<void> factor_columns(SplitMatrix& matrix, int columns, Lanes lanes, const Watch& watch) {
  CHECK(columns >= 0 && columns <= matrix.size(), "no more columns than there are");
  const auto subtract = lanes == Lanes::kFour ? subtract_four : subtract_two;
  for (int block = 0; block < matrix.padded(); block += kBlock) {
    if (watch.stopped()) return cancelled();
    const int done = std::min(block, columns);
    for (int first = 0; first < done; first += kColumnsAtOnce)
      subtract(matrix, block, first, std::min(first + kColumnsAtOnce, done));
    finish_block(matrix, block, columns);
  }
  return {};
}

Result<DenseFactor> DenseFactor::make(const SplitMatrix& matrix, std::span<const double> added, Lanes lanes,
                                      const Watch& watch) {
  CHECK(static_cast<int>(added.size()) == matrix.size(), "one number a row");
  DenseFactor out;
  out.lanes_ = lanes;
  out.factor_ = matrix;
  SplitMatrix& factor = out.factor_;
  for (int j = 0; j < factor.size(); ++j)
    factor.re(j)[j] += added[j];
  if (const auto done = factor_columns(factor, factor.size(), lanes, watch); !done) return done.error();
  out.inverse_diagonal_.assign(factor.padded(), 1);
  for (int j = 0; j < factor.size(); ++j) {
    out.inverse_diagonal_[j] = 1 / factor.re(j)[j];
    for (int i = 0; i < j; ++i) {
      factor.re(j)[i] = factor.re(i)[j];
      factor.im(j)[i] = -factor.im(i)[j];
    }
  }
  return out;
}

void DenseFactor::solve(std::span<double> re, std::span<double> im) const {
  CHECK(static_cast<int>(re.size()) == padded() && im.size() == re.size(), "a padded right-hand side");
  const auto run = lanes_ == Lanes::kFour ? substitute_four : substitute_two;
  run(factor_, inverse_diagonal_.data(), re.data(), im.data());
}

} // namespace oversketch
