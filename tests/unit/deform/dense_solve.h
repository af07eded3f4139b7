#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

/// Small dense systems in long double: a reference that shares nothing with the solvers under test.
namespace oversketch::dense {

/// Rows.
template <class Scalar>
using Dense = std::vector<std::vector<Scalar>>;
using Real = long double;
using LongComplex = std::complex<Real>;

template <class Scalar>
Dense<Scalar> make_zeros(std::size_t rows, std::size_t columns) {
  return Dense<Scalar>(rows, std::vector<Scalar>(columns));
}

inline Real conjugate(Real x) {
  return x;
}
inline LongComplex conjugate(LongComplex x) {
  return std::conj(x);
}

/// Aᴴ B
template <class Scalar>
Dense<Scalar> multiply_adjoint(const Dense<Scalar>& a, const Dense<Scalar>& b) {
  Dense<Scalar> product = make_zeros<Scalar>(a[0].size(), b[0].size());
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i)
      for (std::size_t j = 0; a[k][i] != Scalar(0) && j < b[k].size(); ++j)
        product[i][j] += conjugate(a[k][i]) * b[k][j];
  return product;
}

/// A⁻¹ B, by Gauss–Jordan elimination with row pivots.
template <class Scalar>
Dense<Scalar> solve(Dense<Scalar> a, Dense<Scalar> b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < a.size(); ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Scalar factor = a[i][k] / a[k][k];
      if (i == k || factor == Scalar(0)) continue;
      for (std::size_t j = k; j < a.size(); ++j)
        a[i][j] -= factor * a[k][j];
      for (std::size_t j = 0; j < b[i].size(); ++j)
        b[i][j] -= factor * b[k][j];
    }
  }
  for (std::size_t k = 0; k < a.size(); ++k)
    for (Scalar& value : b[k])
      value /= a[k][k];
  return b;
}

/// The X of least |A X − B|, from the normal equations.
inline Dense<Real> solve_least_squares(const Dense<Real>& a, const Dense<Real>& b) {
  return solve(multiply_adjoint(a, a), multiply_adjoint(a, b));
}

} // namespace oversketch::dense
