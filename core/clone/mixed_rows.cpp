#include "core/clone/mixed_rows.h"

#include "core/base/parallel.h"
#include "core/clone/grid_kernels.h"
#include "core/clone/pixel_planes.h"
#include "core/clone/row_parts.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>
#include <vector>

namespace oversketch {
namespace {

/// Starting a thread costs as much as this many pixels.
constexpr int kLeastPixelsPerThread = 30'000;

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

/// Three planes of changing length, each kept with its room.
struct Sums {
  std::vector<float> values;
  std::size_t stride = 0;

  void make_room(std::size_t count) {
    if (count <= stride) return;
    stride = count;
    values.resize(3 * stride);
  }
  float* plane(std::size_t k) { return values.data() + k * stride; }
};

/// Walks along the mask's runs and those of a row beside them.
class RowBeside {
public:
  RowBeside(const std::vector<Mask::Run>& runs, std::size_t begin, int y) : runs_(runs), at_(begin), y_(y) {}

  /// `met(x0, x1, i)` for the parts of the run with neighbours in the mask, i the place of x0 among the row's pixels;
  /// `open(x0, x1)` for the others.  Runs from left to right.
  template <class Met, class Open>
  void walk(const Mask::Run& here, Met met, Open open) {
    int x = here.x0;
    while (at_ < runs_.size() && runs_[at_].y == y_) {
      const Mask::Run& run = runs_[at_];
      if (run.x0 >= here.x1) break;
      if (run.x1 > x) {
        const int from = std::max(run.x0, x), to = std::min(run.x1, here.x1);
        if (x < from) open(x, from);
        met(from, to, before_ + static_cast<std::size_t>(from - run.x0));
        x = to;
        if (run.x1 > here.x1) break;
      }
      before_ += static_cast<std::size_t>(run.x1 - run.x0);
      ++at_;
    }
    if (x < here.x1) open(x, here.x1);
  }

private:
  const std::vector<Mask::Run>& runs_;
  std::size_t at_;
  int y_;
  std::size_t before_ = 0;
};

PixelPlanes moved(PixelPlanes planes, std::ptrdiff_t by) {
  return {planes.first + by, planes.stride};
}

/// A row of the mask: its runs.
struct MaskRow {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t count = 0;
};

std::vector<MaskRow> list_rows(const std::vector<Mask::Run>& runs) {
  std::vector<MaskRow> rows;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (run == 0 || runs[run].y != runs[run - 1].y) rows.push_back({run, run, 0});
    rows.back().end = run + 1;
    rows.back().count += static_cast<std::size_t>(runs[run].x1 - runs[run].x0);
  }
  return rows;
}

/// Sums up b, row by row from the top.
class MixedSides {
public:
  MixedSides(const ReadPixels& read, const Mask& mask, const Mask& around, MultigridSolve& solve)
      : runs_(mask.runs()), solve_(solve), rows_(read, around) {}

  /// @param part  of all `rows`.
  /// @returns whether all is finite.
  bool run(std::span<const MaskRow> rows, std::span<const MaskRow> part) {
    auto above = static_cast<std::size_t>(part.data() - rows.data());
    // What another part computes, too.
    if (above > 0) compare_down(rows[--above]);
    for (const MaskRow& row : part) {
      std::swap(up_, down_);
      compare_down(row);
      rows_.rewind();
      const int y = runs_[row.begin].y;
      RowBeside upper(runs_, rows[above].begin, y - 1), lower(runs_, row.end, y + 1);
      std::size_t offset = 0;
      for (std::size_t run = row.begin; run < row.end; ++run) {
        add_run(run, offset, upper, lower);
        offset += length(runs_[run]);
      }
      above = static_cast<std::size_t>(&row - rows.data());
    }
    return is_finite_;
  }

private:
  /// The pairs of a row's pixels with those below.
  void compare_down(const MaskRow& row) {
    down_.make_room(row.count);
    rows_.rewind();
    std::size_t offset = 0;
    for (std::size_t run = row.begin; run < row.end; ++run) {
      const Mask::Run& here = runs_[run];
      kernels_.surplus(down_.plane(0) + offset, down_.stride, rows_.at(here.x0, here.y), rows_.at(here.x0, here.y + 1),
                       length(here));
      offset += length(here);
    }
  }

  void add_run(std::size_t index, std::size_t offset, RowBeside& upper, RowBeside& lower) {
    const Mask::Run& here = runs_[index];
    const std::size_t count = length(here);
    const PixelPlanes row = moved(rows_.at(here.x0 - 1, here.y), 1);
    const PixelPlanes above = moved(rows_.at(here.x0 - 1, here.y - 1), 1);
    const PixelPlanes below = moved(rows_.at(here.x0 - 1, here.y + 1), 1);
    sums_.make_room(count);
    along_.make_room(count + 1);
    kernels_.surplus(along_.plane(0), along_.stride, moved(row, -1), row, count + 1);
    kernels_.add_pairs(sums_.plane(0), sums_.stride, along_.plane(0), along_.stride, down_.plane(0) + offset,
                       down_.stride, count);
    add_ring(row, -1, 0);
    add_ring(row, static_cast<std::ptrdiff_t>(count), count - 1);
    add_above(here, row, above, upper);
    lower.walk(
        here, [](int, int, std::size_t) {}, [&](int x0, int x1) { add_ring_row(here, below, x0, x1); });
    // Of infinite values and not-a-numbers differences keep something.
    for (std::size_t k = 0; k < 3; ++k)
      is_finite_ = kernels_.are_finite(sums_.plane(k), count) && is_finite_;
    solve_.set_side(index, sums_.plane(0), sums_.stride);
  }

  void add_above(const Mask::Run& here, PixelPlanes row, PixelPlanes above, RowBeside& upper) {
    const auto subtract = [&](int x0, int x1, Sums& from, std::size_t at) {
      for (std::size_t k = 0; k < 3; ++k) {
        float* const sum = sums_.plane(k) + (x0 - here.x0);
        const float* const pairs = from.plane(k) + at;
        for (int i = 0; i < x1 - x0; ++i)
          sum[i] -= pairs[i];
      }
    };
    upper.walk(
        here, [&](int x0, int x1, std::size_t at) { subtract(x0, x1, up_, at); },
        [&](int x0, int x1) {
          kernels_.surplus(along_.plane(0), along_.stride, moved(above, x0 - here.x0), moved(row, x0 - here.x0),
                           static_cast<std::size_t>(x1 - x0));
          subtract(x0, x1, along_, 0);
          add_ring_row(here, above, x0, x1);
        });
  }

  void add_ring_row(const Mask::Run& here, PixelPlanes beside, int x0, int x1) {
    for (int x = x0; x < x1; ++x)
      add_ring(beside, x - here.x0, static_cast<std::size_t>(x - here.x0));
  }

  /// Adds d of a pixel outside the mask to its neighbour's sum.
  void add_ring(PixelPlanes outside, std::ptrdiff_t at, std::size_t sum) {
    const float* const source = outside.first + at;
    for (std::size_t k = 0; k < 3; ++k)
      sums_.plane(k)[sum] += source[(3 + k) * outside.stride] - source[k * outside.stride];
  }

  static std::size_t length(const Mask::Run& run) { return static_cast<std::size_t>(run.x1 - run.x0); }

  const std::vector<Mask::Run>& runs_;
  MultigridSolve& solve_;
  PlaneRows rows_;
  GridKernels kernels_ = GridKernels::choose();
  Sums sums_, along_;
  /// The pairs of a row's pixels with those below, by place in the row: of this row, and of the row before.
  Sums down_, up_;
  bool is_finite_ = true;
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

bool set_mixed_side(const ReadPixels& read, const Mask& mask, MultigridSolve& solve, int threads) {
  const Mask around = grown(mask);
  const std::vector<MaskRow> rows = list_rows(mask.runs());
  const auto most = static_cast<int>(std::min<std::int64_t>(threads, 1 + mask.count() / kLeastPixelsPerThread));
  const auto parts = cut_rows(std::span(rows), most, [](const MaskRow& row) { return row.count; });
  std::atomic<bool> is_finite = true;
  run_parallel(static_cast<int>(parts.size()), threads, [&](int i) {
    if (!MixedSides(read, mask, around, solve).run(rows, parts[static_cast<std::size_t>(i)])) is_finite = false;
  });
  return is_finite;
}

ReadPixels read_pair(const PlacedPair& pair) {
  return PairReader(pair);
}

} // namespace oversketch
