#include "core/deform/paper_cholesky.h"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oversketch {
namespace {

using Complex = std::complex<double>;

/// a · b without the library's rescue of infinities, which costs a branch in the innermost loops; nothing here is
/// infinite.
Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// For each column k of the reordered matrix the rows above the diagonal, and which entry of the matrix each one is.
struct UpperColumns {
  std::vector<int> start;
  std::vector<int> rows;
  std::vector<int> entries;

  UpperColumns(const ComplexMatrix& matrix, const std::vector<int>& place) : start(place.size() + 1) {
    const auto visit = [&](auto&& each) {
      for (int j = 0; j < matrix.cols(); ++j) {
        for (int p = matrix.outerIndexPtr()[j]; p < matrix.outerIndexPtr()[j + 1]; ++p) {
          // Of each pair of mirrored entries the one that lies above the diagonal after reordering.
          const int row = place[matrix.innerIndexPtr()[p]], column = place[j];
          if (row < column) each(row, column, p);
        }
      }
    };
    visit([&](int, int column, int) { ++start[column + 1]; });
    for (std::size_t k = 1; k < start.size(); ++k)
      start[k] += start[k - 1];
    rows.resize(start.back());
    entries.resize(start.back());
    std::vector<int> next(start.begin(), start.end() - 1);
    visit([&](int row, int column, int p) {
      rows[next[column]] = row;
      entries[next[column]++] = p;
    });
  }
};

/// Elimination tree: parent of column j is the first row below the diagonal of L's column j; −1 at a root.
std::vector<int> find_parents(const UpperColumns& upper, int size) {
  std::vector<int> parent(size, -1), ancestor(size, -1);
  for (int k = 0; k < size; ++k) {
    for (int p = upper.start[k]; p < upper.start[k + 1]; ++p) {
      for (int i = upper.rows[p]; i != -1 && i < k;) {
        const int next = std::exchange(ancestor[i], k);
        if (next == -1) parent[i] = k;
        i = next;
      }
    }
  }
  return parent;
}

/// The same tree, read off the finished pattern.
std::vector<int> read_parents(const CholeskyPattern& pattern) {
  std::vector<int> parent(pattern.order.size(), -1);
  for (std::size_t j = 0; j < parent.size(); ++j) {
    const std::int64_t below = pattern.column_start[j] + 1;
    if (below < pattern.column_start[j + 1]) parent[j] = pattern.rows[below];
  }
  return parent;
}

/// Calls each(j) for every column j in which row k of L has an entry left of the diagonal.  `mark` must hold no k.
template <class Each>
void visit_row(const UpperColumns& upper, const std::vector<int>& parent, int k, std::vector<int>& mark, Each&& each) {
  mark[k] = k;
  for (int p = upper.start[k]; p < upper.start[k + 1]; ++p) {
    for (int j = upper.rows[p]; mark[j] != k; j = parent[j]) {
      mark[j] = k;
      each(j);
    }
  }
}

} // namespace

std::shared_ptr<const CholeskyPattern> analyse(const ComplexMatrix& matrix) {
  const int size = static_cast<int>(matrix.rows());
  CHECK(matrix.rows() == matrix.cols() && matrix.isCompressed(), "only a compressed square matrix can be factored");
  auto out = std::make_shared<CholeskyPattern>();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> ordering;
  Eigen::AMDOrdering<int>()(matrix, ordering);
  out->order.assign(ordering.indices().data(), ordering.indices().data() + size);
  out->place.resize(size);
  for (int k = 0; k < size; ++k)
    out->place[out->order[k]] = k;

  const UpperColumns upper(matrix, out->place);
  const std::vector<int> parent = find_parents(upper, size);
  std::vector<int> mark(size, -1);
  out->column_start.assign(size + 1, 1);
  out->column_start[0] = 0;
  for (int k = 0; k < size; ++k)
    visit_row(upper, parent, k, mark, [&](int j) { ++out->column_start[j + 1]; });
  for (int k = 0; k < size; ++k)
    out->column_start[k + 1] += out->column_start[k];
  out->rows.resize(static_cast<std::size_t>(out->column_start[size]));
  std::vector<std::int64_t> next(out->column_start.begin(), out->column_start.end() - 1);
  std::fill(mark.begin(), mark.end(), -1);
  for (int k = 0; k < size; ++k) {
    visit_row(upper, parent, k, mark, [&](int j) { out->rows[next[j]++] = k; });
    out->rows[next[k]++] = k;
  }
  return out;
}

Result<CholeskyFactor> CholeskyFactor::make(const ComplexMatrix& matrix, std::shared_ptr<const CholeskyPattern> pattern,
                                            const Watch& watch) {
  const int size = pattern->size();
  CHECK(matrix.rows() == size && matrix.cols() == size, "a pattern fits one matrix only");
  const UpperColumns upper(matrix, pattern->place);
  const std::vector<int> parent = read_parents(*pattern);
  CholeskyFactor out;
  out.values_.resize(pattern->rows.size());
  std::vector<std::int64_t> next(pattern->column_start.begin(), pattern->column_start.end() - 1);
  std::vector<int> mark(size, -1), columns;
  std::vector<Complex> y(size);
  for (int k = 0; k < size; ++k) {
    if (k % 256 == 0 && watch.stopped()) return cancelled();
    // Row k of L solves  L(0:k, 0:k) x = M(0:k, k).  A column is eliminated after those that lie before it in the tree,
    // and ancestors have greater numbers.
    columns.clear();
    visit_row(upper, parent, k, mark, [&](int j) { columns.push_back(j); });
    std::sort(columns.begin(), columns.end());
    for (int p = upper.start[k]; p < upper.start[k + 1]; ++p)
      y[upper.rows[p]] = matrix.valuePtr()[upper.entries[p]];
    double pivot = matrix.coeff(pattern->order[k], pattern->order[k]).real();
    for (const int j : columns) {
      const std::int64_t first = pattern->column_start[j];
      const Complex x = std::exchange(y[j], 0.0) / out.values_[first].real();
      for (std::int64_t p = first + 1; p < next[j]; ++p)
        y[pattern->rows[p]] -= times(out.values_[p], x);
      pivot -= std::norm(x);
      out.values_[next[j]++] = std::conj(x);
    }
    CHECK(pivot > 0, "the matrix must be positive definite");
    out.values_[next[k]++] = std::sqrt(pivot);
  }
  out.pattern_ = std::move(pattern);
  return out;
}

void CholeskyFactor::solve_permuted(std::vector<Complex>& x) const {
  const int size = pattern_->size();
  CHECK(static_cast<int>(x.size()) == size, "a right-hand side has one entry an unknown");
  const auto& start = pattern_->column_start;
  const int* rows = pattern_->rows.data();
  for (int j = 0; j < size; ++j) {
    const Complex value = x[j] /= values_[start[j]].real();
    for (std::int64_t p = start[j] + 1; p < start[j + 1]; ++p)
      x[rows[p]] -= times(values_[p], value);
  }
  for (int j = size - 1; j >= 0; --j) {
    Complex sum = x[j];
    for (std::int64_t p = start[j] + 1; p < start[j + 1]; ++p)
      sum -= times(std::conj(values_[p]), x[rows[p]]);
    x[j] = sum / values_[start[j]].real();
  }
}

} // namespace oversketch
