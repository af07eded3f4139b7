#include "core/deform/block_cholesky.h"

#include "core/base/check.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>

namespace oversketch {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

std::vector<int> order_vertices(int vertices, const std::vector<std::pair<int, int>>& coupled) {
  Triplets entries;
  for (int i = 0; i < vertices; ++i)
    entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : coupled) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Eigen::SparseMatrix<double> graph(vertices, vertices);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
  Eigen::AMDOrdering<int>()(graph, inverse);
  return {inverse.indices().data(), inverse.indices().data() + vertices};
}

/// Columns of the factor: what the matrix has below the diagonal, and what the columns that end here pass on.
void find_factor(BlockPattern& pattern) {
  const int n = pattern.size();
  std::vector<std::vector<int>> columns(n), children(n);
  std::vector<int> mark(n, -1);
  for (int j = 0; j < n; ++j) {
    auto& rows = columns[j];
    mark[j] = j;
    const auto take = [&](int row) {
      if (row > j && mark[row] != j) mark[row] = j, rows.push_back(row);
    };
    for (int k = pattern.matrix_start[j]; k < pattern.matrix_start[j + 1]; ++k)
      take(pattern.matrix_rows[k]);
    for (const int child : children[j])
      for (const int row : columns[child])
        take(row);
    std::sort(rows.begin(), rows.end());
    if (!rows.empty()) children[rows.front()].push_back(j);
  }
  pattern.factor_start.push_back(0);
  for (const auto& rows : columns) {
    pattern.factor_rows.insert(pattern.factor_rows.end(), rows.begin(), rows.end());
    pattern.factor_start.push_back(static_cast<int>(pattern.factor_rows.size()));
  }
}

/// to −= a · b, blocks by rows; `b` holds D Lᵀ of the column that is taken off.
inline void subtract_product(double* to, const double* a, const double* b) {
  to[0] -= a[0] * b[0] + a[1] * b[2];
  to[1] -= a[0] * b[1] + a[1] * b[3];
  to[2] -= a[2] * b[0] + a[3] * b[2];
  to[3] -= a[2] * b[1] + a[3] * b[3];
}

inline void multiply(double* to, const double* a, const double* b) {
  to[0] = a[0] * b[0] + a[1] * b[2];
  to[1] = a[0] * b[1] + a[1] * b[3];
  to[2] = a[2] * b[0] + a[3] * b[2];
  to[3] = a[2] * b[1] + a[3] * b[3];
}

} // namespace

BlockPattern::BlockPattern(int vertices, const std::vector<std::pair<int, int>>& coupled)
    : order(order_vertices(vertices, coupled)), place(static_cast<std::size_t>(vertices)) {
  for (int i = 0; i < vertices; ++i)
    place[order[i]] = i;
  std::vector<std::pair<int, int>> entries;
  for (int i = 0; i < vertices; ++i)
    entries.emplace_back(i, i);
  for (const auto& [i, j] : coupled)
    entries.push_back(std::minmax(place[i], place[j]));
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  matrix_start.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const auto& [column, row] : entries) {
    ++matrix_start[column + 1];
    matrix_rows.push_back(row);
  }
  for (int j = 0; j < vertices; ++j)
    matrix_start[j + 1] += matrix_start[j];
  find_factor(*this);
}

BlockPlace find_block(const BlockPattern& pattern, int row, int column) {
  const int i = pattern.place[row], j = pattern.place[column];
  const auto [low, high] = std::minmax(i, j);
  const auto first = pattern.matrix_rows.begin() + pattern.matrix_start[low];
  const auto last = pattern.matrix_rows.begin() + pattern.matrix_start[low + 1];
  const auto found = std::lower_bound(first, last, high);
  CHECK(found != last && *found == high, "these vertices are not coupled");
  return {static_cast<int>(found - pattern.matrix_rows.begin()), i < j};
}

BlockCholesky::BlockCholesky(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)),
      matrix_(4 * pattern_->matrix_rows.size()),
      factor_(4 * pattern_->factor_rows.size()),
      inverse_(4 * pattern_->order.size()),
      diagonal_(4 * pattern_->order.size()) {}

void BlockCholesky::clear() {
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
}

void BlockCholesky::add_to_diagonal(double value) {
  for (int j = 0; j < pattern_->size(); ++j) {
    matrix_[4 * static_cast<std::size_t>(pattern_->matrix_start[j])] += value;
    matrix_[4 * static_cast<std::size_t>(pattern_->matrix_start[j]) + 3] += value;
  }
}

bool BlockCholesky::factor() {
  const BlockPattern& p = *pattern_;
  const int n = p.size();
  // Columns wait at the row they are needed for next: chains through `next`, their place in `reached`.
  std::vector<int> head(n, -1), next(n, -1), reached(n), where(n);
  for (int j = 0; j < n; ++j) {
    const int first = p.factor_start[j], last = p.factor_start[j + 1];
    double pivot[4] = {0, 0, 0, 0};
    for (int k = first; k < last; ++k)
      where[p.factor_rows[k]] = k;
    std::fill(factor_.begin() + 4 * first, factor_.begin() + 4 * last, 0.0);
    for (int k = p.matrix_start[j]; k < p.matrix_start[j + 1]; ++k) {
      const double* from = matrix_.data() + 4 * k;
      std::copy(from, from + 4, p.matrix_rows[k] == j ? pivot : factor_.data() + 4 * where[p.matrix_rows[k]]);
    }
    for (int k = head[j]; k >= 0;) {
      const int after = next[k];
      const int at = reached[k], end = p.factor_start[k + 1];
      const double* l = factor_.data() + 4 * at;
      const double transposed[4] = {l[0], l[2], l[1], l[3]};
      double scaled[4];
      multiply(scaled, diagonal_.data() + 4 * k, transposed);
      subtract_product(pivot, l, scaled);
      for (int i = at + 1; i < end; ++i)
        subtract_product(factor_.data() + 4 * where[p.factor_rows[i]], factor_.data() + 4 * i, scaled);
      if (at + 1 < end) {
        reached[k] = at + 1;
        next[k] = head[p.factor_rows[at + 1]];
        head[p.factor_rows[at + 1]] = k;
      }
      k = after;
    }
    const double determinant = pivot[0] * pivot[3] - pivot[1] * pivot[2];
    if (!(pivot[0] > 0) || !(determinant > 0)) return false;
    std::copy(pivot, pivot + 4, diagonal_.begin() + 4 * j);
    double* inverse = inverse_.data() + 4 * j;
    inverse[0] = pivot[3] / determinant;
    inverse[1] = -pivot[1] / determinant;
    inverse[2] = -pivot[2] / determinant;
    inverse[3] = pivot[0] / determinant;
    for (int k = first; k < last; ++k) {
      double block[4];
      multiply(block, factor_.data() + 4 * k, inverse);
      std::copy(block, block + 4, factor_.begin() + 4 * k);
    }
    if (first < last) {
      reached[j] = first;
      next[j] = head[p.factor_rows[first]];
      head[p.factor_rows[first]] = j;
    }
  }
  return true;
}

void BlockCholesky::solve(Points& x) const {
  const BlockPattern& p = *pattern_;
  const int n = p.size();
  Points y(x.size());
  for (int j = 0; j < n; ++j)
    y[j] = x[p.order[j]];
  for (int j = 0; j < n; ++j) {
    const Point v = y[j];
    for (int k = p.factor_start[j]; k < p.factor_start[j + 1]; ++k) {
      const double* l = factor_.data() + 4 * k;
      y[p.factor_rows[k]] -= {l[0] * v.x + l[1] * v.y, l[2] * v.x + l[3] * v.y};
    }
  }
  for (int j = n - 1; j >= 0; --j) {
    const double* d = inverse_.data() + 4 * j;
    Point v{d[0] * y[j].x + d[1] * y[j].y, d[2] * y[j].x + d[3] * y[j].y};
    for (int k = p.factor_start[j]; k < p.factor_start[j + 1]; ++k) {
      const double* l = factor_.data() + 4 * k;
      const Point w = y[p.factor_rows[k]];
      v -= {l[0] * w.x + l[2] * w.y, l[1] * w.x + l[3] * w.y};
    }
    y[j] = v;
  }
  for (int j = 0; j < n; ++j)
    x[p.order[j]] = y[j];
}

} // namespace oversketch
