#include "core/clone/membrane_matrix.h"

#include <array>
#include <bit>
#include <vector>

namespace oversketch {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Form = std::array<std::array<double, 4>, 4>;

/// The energy of a leaf's pixels towards their right and lower neighbours, by its corners a b / c d.  Along row j the
/// differences are all ((1 − t)(b − a) + t (d − c))/s, t = j/s, and likewise down the columns.
Form leaf_form(int size) {
  const double s = size;
  double first = 0, mixed = 0, second = 0;
  for (int j = 0; j < size; ++j) {
    const double t = j / s;
    first += (1 - t) * (1 - t) / s;
    mixed += (1 - t) * t / s;
    second += t * t / s;
  }
  Form form{};
  const auto add = [&](std::array<double, 4> p, std::array<double, 4> q, double weight) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        form[i][k] += weight * (p[i] * q[k] + q[i] * p[k]) / 2;
  };
  const std::array<double, 4> top{-1, 1, 0, 0}, bottom{0, 0, -1, 1}, left{-1, 0, 1, 0}, right{0, -1, 0, 1};
  for (const auto& [p, q] : {std::pair{top, bottom}, std::pair{left, right}}) {
    add(p, p, first);
    add(p, q, 2 * mixed);
    add(q, q, second);
  }
  return form;
}

/// Entries of the lower triangle in any order, the same place any number of times.
class Entries {
public:
  explicit Entries(const Quadtree& tree) : tree_(tree), masters_(static_cast<std::size_t>(tree.points)) {
    for (std::size_t point = 0; point < masters_.size(); ++point)
      masters_[point] = {tree.unknown[point], tree.unknown[point]};
    for (const Quadtree::Hanging& h : tree.hanging)
      masters_[static_cast<std::size_t>(h.point)] = {tree.unknown[static_cast<std::size_t>(h.ends[0])],
                                                     tree.unknown[static_cast<std::size_t>(h.ends[1])]};
  }

  /// value · u_p u_q, and as much of u_q u_p where p ≠ q.
  void add(int p, int q, double value) {
    const auto& [p0, p1] = masters_[static_cast<std::size_t>(p)];
    const auto& [q0, q1] = masters_[static_cast<std::size_t>(q)];
    if (p0 == p1 && q0 == q1) {
      push(p0, q0, value, p == q);
    } else {
      for (const int i : masters_[static_cast<std::size_t>(p)])
        for (const int k : masters_[static_cast<std::size_t>(q)])
          push(i, k, value / 4, p == q);
    }
  }

  void add_edge(int p, int q) {
    add(p, p, 1);
    add(q, q, 1);
    add(p, q, -1);
  }

  Matrix compress() const;

private:
  struct Entry {
    int row;
    int column;
    double value;
  };
  void push(int i, int k, double value, bool same_point) {
    // Of two points with a master in common both products land on the diagonal.
    if (i == k) return entries_.push_back({i, i, same_point ? value : 2 * value});
    if (i > k) return entries_.push_back({i, k, value});
    // Both orders come by where it is one point.
    if (!same_point) entries_.push_back({k, i, value});
  }

  const Quadtree& tree_;
  std::vector<std::array<int, 2>> masters_;
  std::vector<Entry> entries_;
};

Matrix Entries::compress() const {
  // By rows first, then stably by columns: so that each column has its rows in order.
  const auto n = static_cast<std::size_t>(tree_.unknowns);
  std::vector<std::size_t> start(n + 1, 0);
  for (const Entry& e : entries_)
    ++start[static_cast<std::size_t>(e.row) + 1];
  for (std::size_t i = 0; i < n; ++i)
    start[i + 1] += start[i];
  std::vector<Entry> by_row(entries_.size());
  for (const Entry& e : entries_)
    by_row[start[static_cast<std::size_t>(e.row)]++] = e;
  std::vector<int> column(n + 1, 0), last(n, -1);
  for (const Entry& e : by_row) {
    const auto j = static_cast<std::size_t>(e.column);
    if (last[j] != e.row) ++column[j + 1], last[j] = e.row;
  }
  for (std::size_t j = 0; j < n; ++j)
    column[j + 1] += column[j];
  Matrix a(tree_.unknowns, tree_.unknowns);
  a.resizeNonZeros(column[n]);
  std::copy(column.begin(), column.end(), a.outerIndexPtr());
  std::fill(last.begin(), last.end(), -1);
  std::vector<int>& end = column;
  for (const Entry& e : by_row) {
    const auto j = static_cast<std::size_t>(e.column);
    if (last[j] == e.row) {
      a.valuePtr()[end[j] - 1] += e.value;
    } else {
      a.innerIndexPtr()[end[j]] = e.row;
      a.valuePtr()[end[j]++] = e.value;
      last[j] = e.row;
    }
  }
  return a;
}

} // namespace

Matrix membrane_matrix(const Quadtree& tree, std::span<const int> ring_leaves) {
  Entries entries(tree);
  for (const int leaf : ring_leaves)
    entries.add(leaf, leaf, 1);
  std::array<Form, 32> forms{};
  for (int i = 0; i < static_cast<int>(tree.leaves.size()); ++i) {
    const int size = tree.leaf(i).size;
    const auto [right, below, across] = tree.corners[static_cast<std::size_t>(i)];
    if (size == 1) {
      if (right >= 0) entries.add_edge(i, right);
      if (below >= 0) entries.add_edge(i, below);
      continue;
    }
    Form& form = forms[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(size)))];
    if (form[0][0] == 0) form = leaf_form(size);
    const std::array<int, 4> points{i, right, below, across};
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q <= p; ++q)
        entries.add(points[p], points[q], form[p][q]);
  }
  return entries.compress();
}

} // namespace oversketch
