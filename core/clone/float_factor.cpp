#include "core/clone/float_factor.h"

#include <algorithm>
#include <array>

namespace oversketch {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Columns that are passed over together.
constexpr int kTogether = 4;

/// Cuts the columns into blocks: a column joins those before it where it is the first row of the last of them and the
/// zeros that must be stored for it stay few.  @param add  called with first and last column.
template <class Add>
void cut_blocks(const Matrix& lower, Add add) {
  const int* const start = lower.outerIndexPtr();
  const int* const row = lower.innerIndexPtr();
  const auto n = static_cast<int>(lower.cols());
  std::int64_t needed = 0;
  for (int first = 0, j = 0; j < n; ++j) {
    if (j == first) needed = 0;
    needed += start[j + 1] - start[j];
    const bool joins = j + 1 < n && start[j + 1] - start[j] > 1 && row[start[j] + 1] == j + 1;
    const std::int64_t width = j + 2 - first, below = joins ? start[j + 2] - start[j + 1] - 1 : 0;
    const std::int64_t stored = width * (width + 1) / 2 + width * below;
    if (joins && 4 * stored <= 5 * (needed + below + 1) + 32) continue;
    add(first, j + 1);
    first = j + 1;
  }
}

/// Of a column in a block: its entries from that of row `row` on.
struct Column {
  const float* at = nullptr;
};

template <int kCount>
using Columns = std::array<const float*, kCount>;

template <int kCount>
Float4 weighed(const Columns<kCount>& columns, std::ptrdiff_t i, const Float4* values) {
  Float4 sum = columns[0][i] * values[0];
  for (int c = 1; c < kCount; ++c)
    sum += columns[static_cast<std::size_t>(c)][i] * values[c];
  return sum;
}

/// x at a later column of the block or a row below it loses what the columns contribute.
template <int kCount>
void scatter(const Columns<kCount>& columns, const Float4* values, Float4* inside, int inside_count, const int* rows,
             int row_count, Float4* x) {
  for (int i = 0; i < inside_count; ++i)
    inside[i] -= weighed<kCount>(columns, i, values);
  for (int i = 0; i < row_count; ++i)
    x[rows[i]] -= weighed<kCount>(columns, inside_count + i, values);
}

template <int kCount>
void gather(const Columns<kCount>& columns, Float4* sums, const Float4* inside, int inside_count, const int* rows,
            int row_count, const Float4* x) {
  std::array<Float4, kCount> even{}, odd{};
  int i = 0;
  for (; i < inside_count; ++i)
    for (std::size_t c = 0; c < kCount; ++c)
      even[c] += columns[c][i] * inside[i];
  const auto below = [&](std::array<Float4, kCount>& into, int k) {
    const Float4& value = x[rows[k]];
    for (std::size_t c = 0; c < kCount; ++c)
      into[c] += columns[c][inside_count + k] * value;
  };
  int k = 0;
  for (; k + 1 < row_count; k += 2) {
    below(even, k);
    below(odd, k + 1);
  }
  if (k < row_count) below(even, k);
  for (std::size_t c = 0; c < kCount; ++c)
    sums[c] -= even[c] + odd[c];
}

} // namespace

FloatFactor::FloatFactor(const Matrix& lower) {
  inverse_.reserve(static_cast<std::size_t>(lower.cols()));
  for (int j = 0; j < lower.cols(); ++j)
    inverse_.push_back(static_cast<float>(1 / lower.valuePtr()[lower.outerIndexPtr()[j]]));
  cut_blocks(lower, [&](int first, int last) { add_block(lower, first, last); });
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

namespace {

/// Calls `pass` with as many of the columns j ≤ … < last as are passed over together.
template <class Pass>
int together(int count, Pass pass) {
  switch (std::min(count, kTogether)) {
  case 4:
    pass(std::integral_constant<int, 4>());
    return 4;
  case 3:
    pass(std::integral_constant<int, 3>());
    return 3;
  case 2:
    pass(std::integral_constant<int, 2>());
    return 2;
  default:
    pass(std::integral_constant<int, 1>());
    return 1;
  }
}

} // namespace

void FloatFactor::forward(const Block& block, Float4* x) const {
  const float* entry = entries_.data() + block.entries;
  const int* const rows = rows_.data() + block.rows;
  for (int j = block.first; j < block.last;) {
    j += together(block.last - j, [&](auto constant) {
      constexpr int kCount = decltype(constant)::value;
      Columns<kCount> columns;
      const int after = block.last - j - kCount;
      for (int c = 0; c < kCount; ++c) {
        x[j + c] = inverse_[static_cast<std::size_t>(j + c)] * x[j + c];
        for (int k = c + 1; k < kCount; ++k)
          x[j + k] -= entry[k - c - 1] * x[j + c];
        columns[static_cast<std::size_t>(c)] = entry + (kCount - c - 1);
        entry += kCount - c - 1 + after + block.row_count;
      }
      const std::array<Float4, kCount> values = [&] {
        std::array<Float4, kCount> out;
        std::copy(x + j, x + j + kCount, out.begin());
        return out;
      }();
      scatter<kCount>(columns, values.data(), x + j + kCount, after, rows, block.row_count, x);
    });
  }
}

void FloatFactor::backward(const Block& block, Float4* x) const {
  const int* const rows = rows_.data() + block.rows;
  const int width = block.last - block.first;
  // Column i of the block has width − 1 − i + row_count entries.
  const auto entries_before = [&](int i) {
    return static_cast<std::ptrdiff_t>(i) * (width - 1 + block.row_count) -
           static_cast<std::ptrdiff_t>(i) * (i - 1) / 2;
  };
  const float* const entry = entries_.data() + block.entries;
  // The same parts as in forward(), from the last to the first: the short one is at the end.
  int done = width;
  while (done > 0) {
    const int count = done % kTogether == 0 ? kTogether : done % kTogether;
    together(count, [&](auto constant) {
      constexpr int kCount = decltype(constant)::value;
      const int i = done - kCount, j = block.first + i;
      Columns<kCount> columns;
      for (int c = 0; c < kCount; ++c)
        columns[static_cast<std::size_t>(c)] = entry + entries_before(i + c) + (kCount - c - 1);
      std::array<Float4, kCount> sums;
      std::copy(x + j, x + j + kCount, sums.begin());
      gather<kCount>(columns, sums.data(), x + j + kCount, width - i - kCount, rows, block.row_count, x);
      for (int c = kCount; c-- > 0;) {
        const float* const within = entry + entries_before(i + c);
        for (int k = c + 1; k < kCount; ++k)
          sums[static_cast<std::size_t>(c)] -= within[k - c - 1] * x[j + k];
        x[j + c] = inverse_[static_cast<std::size_t>(j + c)] * sums[static_cast<std::size_t>(c)];
      }
    });
    done -= count;
  }
}

void FloatFactor::substitute(Float4* x) const {
  for (const Block& block : blocks_)
    forward(block, x);
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block)
    backward(*block, x);
}

} // namespace oversketch
