#include "core/clone/float_factor.h"

#include "core/base/index.h"
#include "core/base/processor.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

namespace oversketch {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Columns that are passed over together.
constexpr int kTogether = 4;

/// Columns first ≤ j < last, and the rows below that the last one has.
struct Range {
  int first = 0;
  int last = 0;
  int row_count = 0;
  /// The longest way to here from a column that nothing comes before.
  int height = 0;
};

/// Cuts the columns into blocks: a column joins those before it where it is the first row of the last of them and the
/// zeros that must be stored for it stay few.
std::vector<Range> cut_blocks(const Matrix& lower) {
  const int* const start = lower.outerIndexPtr();
  const int* const row = lower.innerIndexPtr();
  const auto n = static_cast<int>(lower.cols());
  std::vector<Range> ranges;
  std::int64_t needed = 0;
  for (int first = 0, j = 0; j < n; ++j) {
    if (j == first) needed = 0;
    needed += start[j + 1] - start[j];
    const bool joins = j + 1 < n && start[j + 1] - start[j] > 1 && row[start[j] + 1] == j + 1;
    const std::int64_t width = j + 2 - first, below = joins ? start[j + 2] - start[j + 1] - 1 : 0;
    const std::int64_t stored = width * (width + 1) / 2 + width * below;
    if (joins && 4 * stored <= 5 * (needed + below + 1) + 32) continue;
    ranges.push_back({first, j + 1, start[j + 1] - start[j] - 1, 0});
    first = j + 1;
  }
  return ranges;
}

/// By height, and those of a height by their shape: what is repeated the processor foresees.
void order_blocks(std::vector<Range>& ranges, const Matrix& lower) {
  std::vector<int> range_of(static_cast<std::size_t>(lower.cols()));
  for (std::size_t r = 0; r < ranges.size(); ++r)
    std::fill(range_of.begin() + ranges[r].first, range_of.begin() + ranges[r].last, static_cast<int>(r));
  for (const Range& range : ranges) {
    if (range.row_count == 0) continue;
    Range& next = ranges[index(range_of[index(lower.innerIndexPtr()[lower.outerIndexPtr()[range.last - 1] + 1])])];
    next.height = std::max(next.height, range.height + 1);
  }
  const auto key = [](const Range& r) { return std::tuple(r.height, r.last - r.first, r.row_count, r.first); };
  std::sort(ranges.begin(), ranges.end(), [&](const Range& a, const Range& b) { return key(a) < key(b); });
}

template <int kCount>
using Columns = std::array<const float*, kCount>;

template <int kCount>
OVERSKETCH_INLINE Float4 weighed(const Columns<kCount>& columns, std::ptrdiff_t i, const Float4* values) {
  Float4 sum = columns[0][i] * values[0];
  for (int c = 1; c < kCount; ++c)
    sum += columns[index(c)][i] * values[c];
  return sum;
}

/// x at a later column of the block or a row below it loses what the columns contribute.
template <int kCount>
OVERSKETCH_INLINE void scatter(const Columns<kCount>& columns, const Float4* values, Float4* inside, int inside_count,
                               const int* rows, int row_count, Float4* x) {
  for (int i = 0; i < inside_count; ++i)
    inside[i] -= weighed<kCount>(columns, i, values);
  for (int i = 0; i < row_count; ++i)
    x[rows[i]] -= weighed<kCount>(columns, inside_count + i, values);
}

template <int kCount>
OVERSKETCH_INLINE void add_row(std::array<Float4, kCount>& sums, const Columns<kCount>& columns, std::ptrdiff_t i,
                               const Float4& value) {
  for (std::size_t c = 0; c < kCount; ++c)
    sums[c] += columns[c][i] * value;
}

template <int kCount>
OVERSKETCH_INLINE void gather(const Columns<kCount>& columns, Float4* sums, const Float4* inside, int inside_count,
                              const int* rows, int row_count, const Float4* x) {
  std::array<Float4, kCount> even{}, odd{};
  for (int i = 0; i < inside_count; ++i)
    add_row<kCount>(even, columns, i, inside[i]);
  int k = 0;
  for (; k + 1 < row_count; k += 2) {
    add_row<kCount>(even, columns, inside_count + k, x[rows[k]]);
    add_row<kCount>(odd, columns, inside_count + k + 1, x[rows[k + 1]]);
  }
  if (k < row_count) add_row<kCount>(even, columns, inside_count + k, x[rows[k]]);
  for (std::size_t c = 0; c < kCount; ++c)
    sums[c] -= even[c] + odd[c];
}

} // namespace

FloatFactor::FloatFactor(const Matrix& lower) {
  inverse_.reserve(static_cast<std::size_t>(lower.cols()));
  for (int j = 0; j < lower.cols(); ++j)
    inverse_.push_back(static_cast<float>(1 / lower.valuePtr()[lower.outerIndexPtr()[j]]));
  std::vector<Range> ranges = cut_blocks(lower);
  order_blocks(ranges, lower);
  for (const Range& range : ranges)
    add_block(lower, range.first, range.last);
  rows_.shrink_to_fit();
  entries_.shrink_to_fit();
}

void FloatFactor::add_block(const Matrix& lower, int first, int last) {
  const int* const start = lower.outerIndexPtr();
  const int* const row = lower.innerIndexPtr();
  Block block{first, last, static_cast<std::int64_t>(entries_.size()), static_cast<std::int64_t>(rows_.size()), 0};
  // The last column has all the rows that the others have.
  rows_.insert(rows_.end(), row + start[last - 1] + 1, row + start[last]);
  block.row_count = start[last] - start[last - 1] - 1;
  for (int j = first; j < last; ++j) {
    int at = start[j] + 1;
    const auto take = [&](int wanted) {
      const bool has = at < start[j + 1] && row[at] == wanted;
      entries_.push_back(has ? static_cast<float>(lower.valuePtr()[at++]) : 0.0F);
    };
    for (int k = j + 1; k < last; ++k)
      take(k);
    for (int k = 0; k < block.row_count; ++k)
      take(rows_[static_cast<std::size_t>(block.rows + k)]);
  }
  blocks_.push_back(block);
}

std::int64_t FloatFactor::bytes() const {
  const auto size = [](const auto& values) { return static_cast<std::int64_t>(values.capacity() * sizeof(values[0])); };
  return size(blocks_) + size(rows_) + size(entries_) + size(inverse_);
}

/// The columns of a block, some together.
class FloatFactor::Substitution {
public:
  OVERSKETCH_INLINE static void run(const FloatFactor& factor, Float4* x) {
    for (const Block& block : factor.blocks_)
      Substitution(factor, block, x).forward();
    for (auto block = factor.blocks_.rbegin(); block != factor.blocks_.rend(); ++block)
      Substitution(factor, *block, x).backward();
  }

private:
  OVERSKETCH_INLINE Substitution(const FloatFactor& factor, const Block& block, Float4* x)
      : entries_(factor.entries_.data() + block.entries),
        rows_(factor.rows_.data() + block.rows),
        row_count_(block.row_count),
        width_(block.last - block.first),
        inverse_(factor.inverse_.data() + block.first),
        within_(x + block.first),
        x_(x) {}

  OVERSKETCH_INLINE void forward() {
    int i = 0;
    for (; i + kTogether <= width_; i += kTogether)
      forward<kTogether>(i);
    switch (width_ - i) {
    case 3:
      return forward<3>(i);
    case 2:
      return forward<2>(i);
    case 1:
      return forward<1>(i);
    }
  }

  /// The same parts, from the last to the first.
  OVERSKETCH_INLINE void backward() {
    int i = width_ / kTogether * kTogether;
    switch (width_ - i) {
    case 3:
      backward<3>(i);
      break;
    case 2:
      backward<2>(i);
      break;
    case 1:
      backward<1>(i);
    }
    while ((i -= kTogether) >= 0)
      backward<kTogether>(i);
  }

  /// Column i of the block has an entry for each of the width − 1 − i after it, and for each row.
  OVERSKETCH_INLINE const float* entries_of(int i) const {
    const auto before = static_cast<std::ptrdiff_t>(i);
    return entries_ + before * (width_ - 1 + row_count_) - before * (before - 1) / 2;
  }

  /// Of columns i ≤ … < i + kCount: their entries after the last of them.
  template <int kCount>
  OVERSKETCH_INLINE Columns<kCount> columns(int i) const {
    Columns<kCount> out;
    for (int c = 0; c < kCount; ++c)
      out[index(c)] = entries_of(i + c) + (kCount - c - 1);
    return out;
  }

  template <int kCount>
  OVERSKETCH_INLINE void forward(int i) {
    const Columns<kCount> after = columns<kCount>(i);
    std::array<Float4, kCount> values;
    for (int c = 0; c < kCount; ++c) {
      Float4 value = within_[i + c];
      for (int k = 0; k < c; ++k)
        value -= after[index(k)][c - kCount] * values[index(k)];
      within_[i + c] = values[index(c)] = inverse_[i + c] * value;
    }
    scatter<kCount>(after, values.data(), within_ + i + kCount, width_ - i - kCount, rows_, row_count_, x_);
  }

  template <int kCount>
  OVERSKETCH_INLINE void backward(int i) {
    const Columns<kCount> after = columns<kCount>(i);
    std::array<Float4, kCount> sums;
    std::copy(within_ + i, within_ + i + kCount, sums.begin());
    gather<kCount>(after, sums.data(), within_ + i + kCount, width_ - i - kCount, rows_, row_count_, x_);
    for (int c = kCount; c-- > 0;) {
      for (int k = c + 1; k < kCount; ++k)
        sums[index(c)] -= after[index(c)][k - kCount] * sums[index(k)];
      within_[i + c] = sums[index(c)] = inverse_[i + c] * sums[index(c)];
    }
  }

  const float* entries_;
  const int* rows_;
  int row_count_;
  int width_;
  const float* inverse_;
  /// x of the block's columns, and all of it.
  Float4* within_;
  Float4* x_;
};

void FloatFactor::substitute_plainly(Float4* x) const {
  Substitution::run(*this, x);
}

#if defined(__x86_64__) && defined(__GNUC__)

[[gnu::target("avx2")]] void FloatFactor::substitute_by_avx2(Float4* x) const {
  Substitution::run(*this, x);
}

void FloatFactor::substitute(Float4* x) const {
  has_avx2() ? substitute_by_avx2(x) : substitute_plainly(x);
}

#else

void FloatFactor::substitute(Float4* x) const {
  substitute_plainly(x);
}

#endif

} // namespace oversketch
