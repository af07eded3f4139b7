#include "core/clone/mixed_rows.h"

#include "core/clone/grid_kernels.h"
#include "core/clone/pixel_planes.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace oversketch {
namespace {

/// The planes of a row, for all pixels that the mask's pixels in it and in the rows beside it touch.
class PlaneRows {
public:
  PlaneRows(const ReadPixels& read, const Mask& around) : read_(read), runs_(around.runs()) {}

  /// From x on, where x and what follows to the end of a run of the mask next to it were asked for from left to right.
  PixelPlanes at(int x, int y) {
    Row& row = rows_[static_cast<std::size_t>(y & 3)];
    if (row.y != y || row.stride == 0) load(y, row);
    while (runs_[row.cursor].x1 <= x) {
      row.offset += static_cast<std::size_t>(runs_[row.cursor].x1 - runs_[row.cursor].x0);
      ++row.cursor;
    }
    return {row.planes.data() + row.offset + (x - runs_[row.cursor].x0), row.stride};
  }

  /// Before the runs of a row are walked again from the left.
  void rewind() {
    for (Row& row : rows_)
      row.cursor = row.begin, row.offset = 0;
  }

private:
  struct Row {
    int y = 0;
    std::vector<float> planes;
    std::size_t stride = 0;
    std::size_t begin = 0;
    /// The run that is being read, and the pixels before it.
    std::size_t cursor = 0;
    std::size_t offset = 0;
  };

  void load(int y, Row& row) {
    auto run =
        std::lower_bound(runs_.begin(), runs_.end(), y, [](const Mask::Run& a, int value) { return a.y < value; });
    row.y = y;
    row.begin = row.cursor = static_cast<std::size_t>(run - runs_.begin());
    row.offset = row.stride = 0;
    for (auto at = run; at != runs_.end() && at->y == y; ++at)
      row.stride += static_cast<std::size_t>(at->x1 - at->x0);
    row.planes.resize(6 * row.stride);
    float* out = row.planes.data();
    for (; run != runs_.end() && run->y == y; out += run->x1 - run->x0, ++run)
      read_(*run, out, row.stride);
  }

  const ReadPixels& read_;
  const std::vector<Mask::Run>& runs_;
  std::array<Row, 4> rows_;
};

/// What the pairs of a row's pixels with those below must be given, where one of the two is in the mask.
class PairsBelow {
public:
  /// Of the row y, whose pixels in the mask are `here`; `below` those of the next row.
  void compare(int y, std::span<const Mask::Run> here, std::span<const Mask::Run> below, PlaneRows& rows,
               const GridKernels& kernels) {
    y_ = y;
    unite(here, below);
    stride_ = runs_.empty() ? 0 : runs_.back().before + static_cast<std::size_t>(length(runs_.back()));
    surplus_.resize(std::max(surplus_.size(), 3 * stride_));
    rows.rewind();
    for (const Run& run : runs_)
      kernels.surplus(surplus_.data() + run.before, stride_, rows.at(run.x0, y), rows.at(run.x0, y + 1),
                      static_cast<std::size_t>(length(run)));
    cursor_ = 0;
  }

  bool are_of(int y) const { return y_ == y && !runs_.empty(); }

  /// From x on, where what follows to the end of its run of the mask is asked for from left to right.
  PairPlanes at(int x) {
    while (runs_[cursor_].x1 <= x)
      ++cursor_;
    const Run& run = runs_[cursor_];
    return {surplus_.data() + run.before + static_cast<std::size_t>(x - run.x0), stride_};
  }
  void rewind() { cursor_ = 0; }

private:
  struct Run {
    int x0 = 0;
    int x1 = 0;
    /// Pixels in the runs before it.
    std::size_t before = 0;
  };
  static int length(const Run& run) { return run.x1 - run.x0; }

  void unite(std::span<const Mask::Run> a, std::span<const Mask::Run> b) {
    runs_.clear();
    while (!a.empty() || !b.empty()) {
      std::span<const Mask::Run>& next = b.empty() || (!a.empty() && a.front().x0 <= b.front().x0) ? a : b;
      const Mask::Run& run = next.front();
      if (runs_.empty())
        runs_.push_back({run.x0, run.x1, 0});
      else if (runs_.back().x1 < run.x0)
        runs_.push_back({run.x0, run.x1, runs_.back().before + static_cast<std::size_t>(length(runs_.back()))});
      else
        runs_.back().x1 = std::max(runs_.back().x1, run.x1);
      next = next.subspan(1);
    }
  }

  int y_ = 0;
  std::vector<Run> runs_;
  std::size_t cursor_ = 0;
  /// Three planes; the room of longer rows is kept.
  std::vector<float> surplus_;
  std::size_t stride_ = 0;
};

/// Where runs have no neighbours in the mask in the row beside theirs.
class OpenBeside {
public:
  /// @param beside  of that row.
  explicit OpenBeside(std::span<const Mask::Run> beside) : beside_(beside) {}

  /// Calls open(x0, x1) for these parts; runs from left to right.
  template <class Open>
  void walk(const Mask::Run& here, Open open) {
    int x = here.x0;
    while (!beside_.empty() && beside_.front().x0 < here.x1) {
      if (x < beside_.front().x0) open(x, beside_.front().x0);
      x = std::max(x, beside_.front().x1);
      if (x >= here.x1) return;
      beside_ = beside_.subspan(1);
    }
    if (x < here.x1) open(x, here.x1);
  }

private:
  std::span<const Mask::Run> beside_;
};

/// Sums up b, row by row from the top.
class MixedSides {
public:
  /// @param around  `mask` grown by a pixel.
  MixedSides(ReadPixels read, const Mask& mask, std::shared_ptr<const Mask> around, MultigridSolve& solve)
      : read_(std::move(read)), runs_(mask.runs()), around_(std::move(around)), solve_(solve), rows_(read_, *around_) {}

  /// The runs of a row, begin ≤ run < end.
  /// @returns whether all is finite.
  bool add_row(std::size_t begin, std::size_t end) {
    const int y = runs_[begin].y;
    const auto here = std::span(runs_).subspan(begin, end - begin);
    const auto above = before(begin), below = after(end);
    std::swap(up_, down_);
    if (!up_.are_of(y - 1)) up_.compare(y - 1, above, here, rows_, kernels_);
    down_.compare(y, here, below, rows_, kernels_);
    rows_.rewind();
    up_.rewind();
    OpenBeside upper(above), lower(below);
    bool is_finite = true;
    for (std::size_t run = begin; run < end; ++run)
      is_finite = add_run(run, upper, lower) && is_finite;
    return is_finite;
  }

private:
  /// The runs in the row above the one that begins with that run, and below the one that ends before it.
  std::span<const Mask::Run> before(std::size_t run) const {
    std::size_t begin = run;
    while (begin > 0 && runs_[begin - 1].y == runs_[run].y - 1)
      --begin;
    return std::span(runs_).subspan(begin, run - begin);
  }
  std::span<const Mask::Run> after(std::size_t run) const {
    std::size_t end = run;
    while (end < runs_.size() && runs_[end].y == runs_[run - 1].y + 1)
      ++end;
    return std::span(runs_).subspan(run, end - run);
  }

  /// @returns whether all is finite.
  bool add_run(std::size_t run, OpenBeside& upper, OpenBeside& lower) {
    const Mask::Run& here = runs_[run];
    const int count = here.x1 - here.x0;
    const GridSlots<float> side = solve_.side(run);
    const auto planes = [&](int dy) { return moved(rows_.at(here.x0 - 1, here.y + dy), 1); };
    const PixelPlanes row = planes(0);
    // Of infinite values and not-a-numbers differences keep something.
    const bool is_finite =
        kernels_.sum_pairs(side, row, up_.at(here.x0), down_.at(here.x0), static_cast<std::size_t>(count));
    add_ring(side, 0, moved(row, -1));
    add_ring(side, count - 1, moved(row, count));
    const auto add_ring_row = [&](PixelPlanes beside, int x0, int x1) {
      for (int i = x0 - here.x0; i < x1 - here.x0; ++i)
        add_ring(side, i, moved(beside, i));
    };
    upper.walk(here, [&](int x0, int x1) { add_ring_row(planes(-1), x0, x1); });
    lower.walk(here, [&](int x0, int x1) { add_ring_row(planes(1), x0, x1); });
    return is_finite;
  }

  /// Adds d of a pixel outside the mask to its neighbour's sum.
  static void add_ring(GridSlots<float> side, int pixel, PixelPlanes outside) {
    float* const sum = side.at(static_cast<std::size_t>(pixel));
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += outside.first[(3 + k) * outside.stride] - outside.first[k * outside.stride];
  }

  static PixelPlanes moved(PixelPlanes planes, std::ptrdiff_t by) { return {planes.first + by, planes.stride}; }

  ReadPixels read_;
  const std::vector<Mask::Run>& runs_;
  std::shared_ptr<const Mask> around_;
  MultigridSolve& solve_;
  PlaneRows rows_;
  GridKernels kernels_ = GridKernels::choose();
  /// Of this row, and of the row before.
  PairsBelow down_, up_;
};

/// Reads a placed pair.
class PairReader {
public:
  explicit PairReader(const PlacedPair& pair) : pair_(pair) {}

  void operator()(const Mask::Run& run, float* out, std::size_t stride) const {
    if (!pair_.is_plain() || !read_opaque(run, out, stride)) read_any(run, out, stride);
  }

private:
  /// @returns whether all are opaque; else what was written is not meant.
  bool read_opaque(const Mask::Run& run, float* out, std::size_t stride) const {
    bool is_opaque =
        to_planes(&pair_.source_pixel(run.x0, run.y), static_cast<std::size_t>(run.x1 - run.x0), out, stride);
    float* const target = out + 3 * stride;
    // The target's pixels follow each other but where it ends.
    for (int x = run.x0; x < run.x1;) {
      const int from = pair_.target_x(x), last = pair_.target_x(run.x1 - 1);
      const bool moves = x + 1 < run.x1 && pair_.target_x(x + 1) == from + 1;
      const int count = moves ? last - from + 1 : 1;
      is_opaque &=
          to_planes(&pair_.target_pixel(x, run.y), static_cast<std::size_t>(count), target + (x - run.x0), stride);
      x += count;
    }
    return is_opaque;
  }

  void read_any(const Mask::Run& run, float* out, std::size_t stride) const {
    for (int x = run.x0; x < run.x1; ++x, ++out) {
      const PlacedPair::Values values = pair_.at(x, run.y);
      for (std::size_t k = 0; k < 3; ++k) {
        out[k * stride] = static_cast<float>(values.source.v[k]);
        out[(3 + k) * stride] = static_cast<float>(values.target.v[k]);
      }
    }
  }

  const PlacedPair& pair_;
};

} // namespace

void set_mixed_side(const ReadPixels& read, const Mask& mask, MultigridSolve& solve) {
  const auto around = std::make_shared<const Mask>(grown(mask));
  solve.set_side_by([read, &mask, around, &solve] {
    const auto sides = std::make_shared<MixedSides>(read, mask, around, solve);
    return [sides](std::size_t begin, std::size_t end) { return sides->add_row(begin, end); };
  });
}

ReadPixels read_pair(const PlacedPair& pair) {
  return PairReader(pair);
}

} // namespace oversketch
