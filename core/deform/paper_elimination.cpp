#include "core/deform/paper_elimination.h"

#include "core/base/check.h"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <complex>

namespace oversketch {
namespace {

/// A column joins the front before it when it brings no more new rows than this part of the front's rows, which are
/// then zero in its other columns: few larger fronts are faster than many small ones.
constexpr double kZerosAllowed = 0.2;

/// Calls each(row, value) for the entries of a column, rows in the new order.
template <class Each>
void visit_column(const ComplexMatrix& matrix, int column, const std::vector<int>& place, Each&& each) {
  for (int p = matrix.outerIndexPtr()[column]; p < matrix.outerIndexPtr()[column + 1]; ++p)
    each(place[matrix.innerIndexPtr()[p]], matrix.valuePtr()[p]);
}

/// Adds columns `from_column`… of the lower triangle of `part` to `to`; where[k] is the place of its row from_column +
/// k.
void add_part(const SplitMatrix& part, int from_column, const std::vector<int>& where, SplitMatrix& to) {
  const int count = static_cast<int>(where.size());
  for (int j = 0; j < count; ++j) {
    const double *re = part.re(from_column + j) + from_column, *im = part.im(from_column + j) + from_column;
    double *to_re = to.re(where[j]), *to_im = to.im(where[j]);
    for (int i = j; i < count; ++i) {
      to_re[where[i]] += re[i];
      to_im[where[i]] += im[i];
    }
  }
}

/// The smallest that is large enough, or an empty one: memory that is new to the process costs as much as the sums in
/// it.
SplitMatrix take_spare(std::vector<SplitMatrix>& spare, int size) {
  std::size_t best = spare.size();
  for (std::size_t i = 0; i < spare.size(); ++i) {
    if (spare[i].room() >= size && (best == spare.size() || spare[i].room() < spare[best].room())) best = i;
  }
  if (best == spare.size()) return {};
  std::swap(spare[best], spare.back());
  SplitMatrix out = std::move(spare.back());
  spare.pop_back();
  return out;
}

} // namespace

Result<Elimination> Elimination::make(const ComplexMatrix& matrix, std::span<const int> kept, Lanes lanes,
                                      const Watch& watch) {
  CHECK(matrix.rows() == matrix.cols() && matrix.isCompressed(), "only a compressed square matrix can be factored");
  Elimination out;
  {
    const StageTimer timer(watch.times, "symbolic");
    out.find_order(matrix, kept);
    out.find_fronts(matrix);
  }
  const StageTimer timer(watch.times, "factor");
  if (const auto done = out.eliminate(matrix, lanes, watch); !done) return done.error();
  return out;
}

/// Approximate minimum degree among the eliminated unknowns alone.
void Elimination::find_order(const ComplexMatrix& matrix, std::span<const int> kept) {
  const int size = static_cast<int>(matrix.rows());
  constexpr int kKept = -1;
  std::vector<int> local(size, 0), inside;
  for (const int i : kept) {
    CHECK(i >= 0 && i < size && local[i] != kKept, "kept unknowns are distinct ones of the matrix");
    local[i] = kKept;
  }
  CHECK(!kept.empty(), "something must be kept");
  for (int i = 0; i < size; ++i) {
    if (local[i] == kKept) continue;
    local[i] = static_cast<int>(inside.size());
    inside.push_back(i);
  }
  eliminated_ = static_cast<int>(inside.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (const int column : inside) {
    visit_column(matrix, column, local, [&](int row, const auto&) {
      if (row != kKept) entries.emplace_back(row, local[column], 1.0);
    });
  }
  Eigen::SparseMatrix<double> graph(eliminated_, eliminated_);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> ordering;
  if (eliminated_ > 0) Eigen::AMDOrdering<int>()(graph, ordering);
  for (int k = 0; k < eliminated_; ++k)
    order_.push_back(inside[ordering.indices()[k]]);
  order_.insert(order_.end(), kept.begin(), kept.end());
  place_.resize(size);
  for (int k = 0; k < size; ++k)
    place_[order_[k]] = k;
}

/// A column joins the front of the one before it when that one passes its rows on to it and few zeros come in.
void Elimination::find_fronts(const ComplexMatrix& matrix) {
  const int size = static_cast<int>(order_.size());
  std::vector<std::vector<int>> waiting(eliminated_);
  std::vector<int> mark(size, -1), more;
  const auto close = [&](int front) {
    const std::vector<int>& rows = fronts_[front].rows;
    if (rows.empty()) return;
    (rows.front() < eliminated_ ? waiting[rows.front()] : roots_).push_back(front);
  };
  for (int j = 0; j < eliminated_; ++j) {
    const bool follows = !fronts_.empty() && !fronts_.back().rows.empty() && fronts_.back().rows.front() == j;
    more.clear();
    const auto take = [&](int row) {
      if (row > j && mark[row] != j) mark[row] = j, more.push_back(row);
    };
    if (follows) {
      for (const int row : fronts_.back().rows)
        mark[row] = j;
    }
    visit_column(matrix, order_[j], place_, [&](int row, const auto&) { take(row); });
    for (const int child : waiting[j])
      for (const int row : fronts_[child].rows)
        take(row);
    std::sort(more.begin(), more.end());
    Front* front = follows ? &fronts_.back() : nullptr;
    const bool joins = follows && static_cast<double>(more.size()) <= kZerosAllowed * front->size();
    if (joins) {
      front->rows.erase(front->rows.begin());
    } else {
      std::vector<int> passed;
      if (follows) passed.assign(front->rows.begin() + 1, front->rows.end());
      if (!fronts_.empty()) close(static_cast<int>(fronts_.size()) - 1);
      front = &fronts_.emplace_back();
      front->first = j;
      front->rows = std::move(passed);
    }
    ++front->columns;
    const auto middle = front->rows.insert(front->rows.end(), more.begin(), more.end());
    std::inplace_merge(front->rows.begin(), middle, front->rows.end());
    front->children.insert(front->children.end(), waiting[j].begin(), waiting[j].end());
  }
  if (!fronts_.empty()) close(static_cast<int>(fronts_.size()) - 1);
  std::size_t entries = 0;
  for (Front& front : fronts_) {
    front.start = entries;
    entries += 2 * static_cast<std::size_t>(front.columns) * front.size();
  }
  values_.reserve(entries);
}

Result<void> Elimination::eliminate(const ComplexMatrix& matrix, Lanes lanes, const Watch& watch) {
  const int size = static_cast<int>(order_.size());
  std::vector<SplitMatrix> work(fronts_.size()), spare;
  std::vector<int> where(size), part;
  const auto add_columns = [&](int first, int columns, SplitMatrix& to) {
    for (int q = 0; q < columns; ++q) {
      visit_column(matrix, order_[first + q], place_, [&](int row, const std::complex<double>& value) {
        if (row < first + q) return;
        to.re(q)[where[row]] += value.real();
        if (row > first + q) to.im(q)[where[row]] += value.imag();
      });
    }
  };
  const auto add_child = [&](int child, SplitMatrix& to) {
    part.clear();
    for (const int row : fronts_[child].rows)
      part.push_back(where[row]);
    add_part(work[child], fronts_[child].columns, part, to);
    spare.push_back(std::move(work[child]));
  };
  for (std::size_t k = 0; k < fronts_.size(); ++k) {
    const Front& front = fronts_[k];
    for (int q = 0; q < front.columns; ++q)
      where[front.first + q] = q;
    for (std::size_t i = 0; i < front.rows.size(); ++i)
      where[front.rows[i]] = front.columns + static_cast<int>(i);
    work[k] = take_spare(spare, front.size());
    work[k].reset(front.size());
    add_columns(front.first, front.columns, work[k]);
    for (const int child : front.children)
      add_child(child, work[k]);
    if (const auto done = factor_columns(work[k], front.columns, lanes, watch); !done) return done.error();
    for (int q = 0; q < front.columns; ++q) {
      values_.insert(values_.end(), work[k].re(q), work[k].re(q) + front.size());
      values_.insert(values_.end(), work[k].im(q), work[k].im(q) + front.size());
    }
  }
  for (int i = eliminated_; i < size; ++i)
    where[i] = i - eliminated_;
  complement_ = SplitMatrix(size - eliminated_);
  add_columns(eliminated_, size - eliminated_, complement_);
  for (const int root : roots_)
    add_child(root, complement_);
  return {};
}

ComplexVector Elimination::extend(const ComplexVector& kept) const {
  CHECK(kept.size() == complement_.size(), "one value a kept unknown");
  std::vector<double> re(order_.size()), im(order_.size()), rows_re, rows_im;
  for (int i = 0; i < complement_.size(); ++i) {
    re[eliminated_ + i] = kept[i].real();
    im[eliminated_ + i] = kept[i].imag();
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const int size = front->size();
    rows_re.resize(size);
    rows_im.resize(size);
    for (int i = front->columns; i < size; ++i) {
      rows_re[i] = re[front->rows[i - front->columns]];
      rows_im[i] = im[front->rows[i - front->columns]];
    }
    for (int q = front->columns - 1; q >= 0; --q) {
      const double* lr = values_.data() + front->start + 2 * static_cast<std::size_t>(q) * size;
      const double* li = lr + size;
      double sum_re = 0, sum_im = 0;
      for (int i = q + 1; i < size; ++i) {
        sum_re += lr[i] * rows_re[i] + li[i] * rows_im[i];
        sum_im += lr[i] * rows_im[i] - li[i] * rows_re[i];
      }
      re[front->first + q] = rows_re[q] = -sum_re / lr[q];
      im[front->first + q] = rows_im[q] = -sum_im / lr[q];
    }
  }
  ComplexVector out(static_cast<Eigen::Index>(order_.size()));
  for (std::size_t k = 0; k < order_.size(); ++k)
    out[order_[k]] = {re[k], im[k]};
  return out;
}

} // namespace oversketch
