#include "core/clone/mixed_rows.h"

#include "core/clone/guidance.h"

#include <algorithm>
#include <array>
#include <vector>

namespace oversketch {
namespace {

struct PixelValues {
  Float4 source;
  Float4 target;
};

Float4 difference(const PixelValues& p) {
  return p.target - p.source;
}

/// surplus() of guidance.cpp, without a branch: which of two noises is stronger cannot be foretold.
inline Float4 surplus(const PixelValues& p, const PixelValues& q) {
  const Float4::Lanes s = p.source.v - q.source.v, t = p.target.v - q.target.v;
  const Float4::Lanes ss = s * s, tt = t * t, less = tt - ss, both = tt + ss;
  const float more = (less[0] + less[1]) + less[2], sum = (both[0] + both[1]) + both[2];
  const bool is_stronger = (more > 0) & (more * more > static_cast<float>(kTie) * sum);
  return {(t - s) * static_cast<float>(is_stronger)};
}

/// The values of a row, for all pixels that the mask's pixels in it and in the rows beside it touch.
class ValueRows {
public:
  ValueRows(const PlacedPair& pair, const Mask& mask) : pair_(pair), around_(grown(mask)) {}

  /// Values from x on; the pixels from x to the end of a run of the mask next to it are there.
  const PixelValues* at(int x, int y) {
    Row& row = rows_[static_cast<std::size_t>(y & 3)];
    if (row.y != y || row.values.empty()) read(y, row);
    const std::vector<Mask::Run>& runs = around_.runs();
    while (runs[row.cursor].x1 <= x) {
      row.offset += static_cast<std::size_t>(runs[row.cursor].x1 - runs[row.cursor].x0);
      ++row.cursor;
    }
    return row.values.data() + row.offset + (x - runs[row.cursor].x0);
  }

  /// Before the runs of a row are walked again from the left.
  void rewind() {
    for (Row& row : rows_)
      row.cursor = row.begin, row.offset = 0;
  }

private:
  struct Row {
    int y = 0;
    std::vector<PixelValues> values;
    std::size_t begin = 0;
    /// The run that is being read, and the values before it.
    std::size_t cursor = 0;
    std::size_t offset = 0;
  };

  void read(int y, Row& row) {
    const std::vector<Mask::Run>& runs = around_.runs();
    const auto first =
        std::lower_bound(runs.begin(), runs.end(), y, [](const Mask::Run& run, int value) { return run.y < value; });
    row.y = y;
    row.begin = row.cursor = static_cast<std::size_t>(first - runs.begin());
    row.offset = 0;
    row.values.clear();
    for (auto run = first; run != runs.end() && run->y == y; ++run)
      for (int x = run->x0; x < run->x1; ++x)
        row.values.push_back(value(x, y));
  }

  PixelValues value(int x, int y) const {
    const Rgba &s = pair_.source_pixel(x, y), &t = pair_.target_pixel(x, y);
    if (pair_.is_plain() && s.a == 1 && t.a == 1)
      return {{Float4::Lanes{s.r, s.g, s.b, 0}}, {Float4::Lanes{t.r, t.g, t.b, 0}}};
    const PlacedPair::Values values = pair_.at(x, y);
    return {to_float(values.source), to_float(values.target)};
  }

  static Float4 to_float(const Channels& c) {
    return {Float4::Lanes{static_cast<float>(c.v[0]), static_cast<float>(c.v[1]), static_cast<float>(c.v[2]), 0}};
  }

  const PlacedPair& pair_;
  Mask around_;
  std::array<Row, 4> rows_;
};

/// A row's sums, run by run from the top.
class MixedSums {
public:
  MixedSums(const PlacedPair& pair, const Mask& mask) : mask_(mask), rows_(pair, mask) {}

  /// b of a run of the mask.
  std::span<const Float4> run(std::size_t run) {
    const Mask::Run& here = mask_.runs()[run];
    if (run == 0 || here.y != mask_.runs()[run - 1].y) begin_row(run);
    const auto length = static_cast<std::size_t>(here.x1 - here.x0);
    const PixelValues* const row = rows_.at(here.x0 - 1, here.y) + 1;
    const PixelValues* const above = rows_.at(here.x0 - 1, here.y - 1) + 1;
    const PixelValues* const below = rows_.at(here.x0 - 1, here.y + 1) + 1;
    sums_.resize(length);
    down_.resize(down_.size() + length);
    Float4* const down = down_.data() + (down_.size() - length);

    Float4 from_left = surplus(row[0], row[-1]) + difference(row[-1]);
    for (std::size_t i = 0; i < length; ++i) {
      const Float4 to_right = surplus(row[i], row[i + 1]);
      down[i] = surplus(row[i], below[i]);
      sums_[i] = from_left + to_right + down[i];
      from_left = Float4{} - to_right;
    }
    sums_[length - 1] += difference(row[length]);
    add_above(here, row, above);
    add_below(here, below);
    return sums_;
  }

private:
  void begin_row(std::size_t run) {
    std::swap(up_, down_);
    down_.clear();
    const std::vector<Mask::Run>& runs = mask_.runs();
    // What stands in up_ belongs to the row before, if that is the row above.
    above_ = above_end_ = run;
    up_offset_ = 0;
    if (run > 0 && runs[run - 1].y == runs[run].y - 1) above_ = row_begin_;
    row_begin_ = run;
    below_ = run;
    while (below_ < runs.size() && runs[below_].y == runs[run].y)
      ++below_;
    rows_.rewind();
  }

  /// Pairs with the pixels above: in the mask they were looked at there.
  void add_above(const Mask::Run& here, const PixelValues* row, const PixelValues* above) {
    const std::vector<Mask::Run>& runs = mask_.runs();
    const auto open = [&](int from, int to) {
      for (int x = from; x < to; ++x) {
        const auto i = static_cast<std::size_t>(x - here.x0);
        sums_[i] += surplus(row[i], above[i]) + difference(above[i]);
      }
    };
    int x = here.x0;
    while (x < here.x1) {
      if (above_ >= above_end_) return open(x, here.x1);
      const Mask::Run& run = runs[above_];
      if (run.x1 <= x) {
        up_offset_ += static_cast<std::size_t>(run.x1 - run.x0);
        ++above_;
        continue;
      }
      const int from = std::clamp(run.x0, x, here.x1), to = std::min(run.x1, here.x1);
      open(x, from);
      for (int met = from; met < to; ++met)
        sums_[static_cast<std::size_t>(met - here.x0)] -= up_[up_offset_ + static_cast<std::size_t>(met - run.x0)];
      x = std::max(from, to);
    }
  }

  /// The pixels below that are outside the mask.
  void add_below(const Mask::Run& here, const PixelValues* below) {
    const std::vector<Mask::Run>& runs = mask_.runs();
    const auto open = [&](int from, int to) {
      for (int x = from; x < to; ++x)
        sums_[static_cast<std::size_t>(x - here.x0)] += difference(below[x - here.x0]);
    };
    int x = here.x0;
    while (x < here.x1) {
      if (below_ >= runs.size() || runs[below_].y != here.y + 1) return open(x, here.x1);
      if (runs[below_].x1 <= x) {
        ++below_;
        continue;
      }
      open(x, std::clamp(runs[below_].x0, x, here.x1));
      x = std::min(runs[below_].x1, here.x1);
      if (runs[below_].x0 >= here.x1) return;
    }
  }

  const Mask& mask_;
  ValueRows rows_;
  std::vector<Float4> sums_;
  /// The pairs with the pixels below, of this row so far and of the row above.
  std::vector<Float4> down_, up_;
  std::size_t row_begin_ = 0;
  /// The run above and the run below that come next; where in up_ the one above begins.
  std::size_t above_ = 0, above_end_ = 0, below_ = 0;
  std::size_t up_offset_ = 0;
};

} // namespace

bool set_mixed_side(const PlacedPair& pair, const Mask& mask, MultigridSolve& solve) {
  MixedSums sums(pair, mask);
  Float4 nothing;
  for (std::size_t run = 0; run < mask.runs().size(); ++run) {
    const std::span<const Float4> side = sums.run(run);
    // 0 · x is not 0 for infinite x and for not-a-number, of which differences keep something.
    for (const Float4& b : side)
      nothing += 0.0f * b;
    solve.set_side(run, side);
  }
  return nothing[0] == 0 && nothing[1] == 0 && nothing[2] == 0;
}

} // namespace oversketch
