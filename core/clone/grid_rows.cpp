#include "core/clone/grid_rows.h"

#include "core/clone/float4.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace oversketch {
namespace {

constexpr std::size_t kC = kGridChannels;

std::size_t at_slot(int slot) {
  return kC * static_cast<std::size_t>(slot);
}

using Floats = Float4::Lanes;

Floats load(const float* from) {
  Floats v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

/// Three of the four numbers.  Where the slot after it is written later, all four may go.
void store(float* slot, const Floats& v) {
  std::memcpy(slot, &v, kC * sizeof(float));
}
void store_over(float* slot, const Floats& v) {
  std::memcpy(slot, &v, sizeof v);
}

/// For the next but nearest cache.
void ask_for(const float* at) {
  __builtin_prefetch(at, 0, 2);
  // A function that does nothing else GCC takes for one without effect: it drops the calls.
  asm volatile("");
}

/// Values from left to right become those of a run's slots (1st, 3rd, 5th…, 2nd, 4th…).
/// @param line  readable one float beyond its end.
void split(const float* line, int count, float* slots) {
  const auto every_second = [](const float* from, int n, float* to) {
    for (int i = 0; i + 1 < n; ++i, from += 2 * kC, to += kC)
      store_over(to, load(from));
    if (n > 0) store(to, load(from));
  };
  const int half = (count + 1) / 2;
  every_second(line, half, slots);
  every_second(line + kC, count - half, slots + at_slot(half));
}

/// The reverse, times `factor`.
/// @param slots  readable one float beyond their end.
void join(const float* slots, int count, float factor, float* line) {
  const float *even = slots, *odd = slots + at_slot((count + 1) / 2);
  int i = 0;
  for (; i + 2 < count; i += 2, even += kC, odd += kC, line += 2 * kC) {
    store_over(line, factor * load(even));
    store_over(line + kC, factor * load(odd));
  }
  if (i < count) store(line, factor * load(even));
  if (i + 1 < count) store(line + kC, factor * load(odd));
}

/// Row `row`'s of what an index lists.
template <class T>
std::span<const T> of_row(const std::vector<T>& list, const std::vector<int>& first, int row) {
  const auto r = static_cast<std::size_t>(row), begin = static_cast<std::size_t>(first[r]);
  return std::span(list).subspan(begin, static_cast<std::size_t>(first[r + 1]) - begin);
}

} // namespace

std::size_t GridRows::longest_cells(const GridLevel& level) {
  int longest = 0;
  for (std::size_t run = 0; run + 1 < level.runs.size(); ++run)
    longest = std::max(longest, level.runs[run + 1].first - level.runs[run].first);
  return at_slot((longest + 1) / 2 + 1);
}

void GridRows::fetch(int row, std::size_t part, std::size_t parts, const Needed& needed) const {
  constexpr std::size_t kLine = 64 / sizeof(float);
  const auto in_part = [&](int first, int last, auto ask) {
    const std::size_t begin = at_slot(first), lines = (at_slot(last) - begin + kLine - 1) / kLine;
    const std::size_t until = begin + lines * (part + 1) / parts * kLine;
    for (std::size_t at = begin + lines * part / parts * kLine; at < until; at += kLine)
      ask(at);
  };
  const auto ask_u = [&](std::size_t at) { ask_for(values_.u + at); };
  const auto ask_b = [&](std::size_t at) { ask_for(values_.b + at); };
  const int first = level_.first_in(row), last = level_.last_in(row);
  const bool is_b_read = !values_.is_b_beside_boundary;
  if (needed.u && needed.all_b && is_b_read)
    return in_part(first, last, [&](std::size_t at) {
      ask_b(at);
      ask_u(at);
    });
  if (needed.u) in_part(first, last, ask_u);
  if (!is_b_read) return;
  if (needed.all_b) return in_part(first, last, ask_b);
  const int y = level_.y_of(row);
  for (int run = level_.begin_of(row); run < level_.end_of(row); ++run) {
    const int begin = level_.first_of(run), end = level_.first_of(run + 1), middle = begin + (end - begin + 1) / 2;
    if (((level_.x0_of(run) + y) & 1) == level_.coarse_colour())
      in_part(begin, middle, ask_b);
    else
      in_part(middle, end, ask_b);
  }
}

std::span<const GridPiece> GridRows::pieces(int row) {
  if (!level_.index.empty()) return of_row(level_.index.pieces, level_.index.first_piece, row);
  const auto at = static_cast<std::size_t>(row) % pieces_.size();
  if (pieces_row_[at] != row) {
    expand_row(level_, row, pieces_[at]);
    pieces_row_[at] = row;
  }
  return pieces_[at];
}

/// Calls work(slot, b, neighbours, floats) for stretches of one colour, a missing neighbour standing as zeros.
template <class Work>
void GridRows::for_cells(const float* u, int row, int colour, Work work) {
  for (const GridPiece& piece : pieces(row)) {
    const GridPiece::Cells& cells = piece.cells[static_cast<std::size_t>(colour)];
    if (cells.count == 0) continue;
    const auto pick = [&](int from, int count, bool has_west, bool has_east) {
      const std::size_t west = at_slot(cells.west + from);
      const GridNeighbours at{has_west ? u + west : zeros_, has_east ? u + west + kC : zeros_,
                              cells.north >= 0 ? u + at_slot(cells.north + from) : zeros_,
                              cells.south >= 0 ? u + at_slot(cells.south + from) : zeros_};
      const bool is_b_zero =
          values_.is_b_beside_boundary && has_west && has_east && cells.north >= 0 && cells.south >= 0;
      const int slot = cells.at + from;
      work(slot, is_b_zero ? zeros_ : values_.b + at_slot(slot), at, at_slot(count));
    };
    int from = 0, to = cells.count;
    if (cells.opens) pick(from++, 1, false, !(cells.closes && cells.count == 1));
    if (cells.closes && from < to) --to;
    if (from < to) pick(from, to - from, true, true);
    if (cells.closes && to >= from && to < cells.count) pick(to, 1, true, false);
  }
}

/// Calls work(slot, scale) for the irregular nodes of a row.
template <class Work>
void GridRows::for_irregular(int row, int colour, Work work) const {
  const auto c = static_cast<std::size_t>(colour);
  const std::vector<GridLevel::Irregular>& list = level_.irregular[c];
  if (!level_.index.empty()) {
    for (const GridLevel::Irregular& node : of_row(list, level_.index.first_irregular[c], row))
      work(at_slot(node.slot), node.scale);
    return;
  }
  const int end = level_.last_in(row);
  auto node = std::lower_bound(list.begin(), list.end(), level_.first_in(row),
                               [](const GridLevel::Irregular& a, int slot) { return a.slot < slot; });
  for (; node != list.end() && node->slot < end; ++node)
    work(at_slot(node->slot), node->scale);
}

void GridRows::relax(int row, int colour) {
  for_cells(values_.u, row, colour, [&](int slot, const float* b, const GridNeighbours& at, std::size_t count) {
    kernels_.relax(values_.u + at_slot(slot), b, at, count, inverse_);
  });
  for_irregular(row, colour, [&](std::size_t at, float scale) {
    for (std::size_t k = 0; k < kC; ++k)
      values_.u[at + k] *= scale;
  });
}

void GridRows::overrelax(int row, int colour, float factor) {
  const auto scale_irregular = [&](auto scale_of) {
    for_irregular(row, colour, [&](std::size_t at, float scale) {
      for (std::size_t k = 0; k < kC; ++k)
        values_.u[at + k] *= scale_of(scale);
    });
  };
  // Both terms are scaled after, and only the first shall be.
  scale_irregular([](float scale) { return 1 / scale; });
  for_cells(values_.u, row, colour, [&](int slot, const float* b, const GridNeighbours& at, std::size_t count) {
    kernels_.overrelax(values_.u + at_slot(slot), b, at, count, factor * inverse_, 1 - factor);
  });
  scale_irregular([](float scale) { return scale; });
}

void GridRows::relax_from_zero(int row, int colour) {
  for_cells(values_.u, row, colour, [&](int slot, const float* b, const GridNeighbours&, std::size_t count) {
    kernels_.relax_zero(values_.u + at_slot(slot), b, count, inverse_);
  });
  for_irregular(row, colour, [&](std::size_t at, float scale) {
    for (std::size_t k = 0; k < kC; ++k)
      values_.u[at + k] *= scale;
  });
}

void GridRows::inject(int row, const GridLevel& coarse, const float* coarse_u, float factor) {
  if (!has_coarse_nodes(row)) return;
  const int y = level_.y_of(row), coarse_row = coarse.find_row((y - level_.coarse_y) >> 1);
  int run = coarse_row < 0 ? 0 : coarse.begin_of(coarse_row);
  const int end = coarse_row < 0 ? 0 : coarse.end_of(coarse_row);
  for (int fine = level_.begin_of(row); fine < level_.end_of(row); ++fine) {
    // The first node of the coarse nodes' colour, and how many there are.
    const int x0 = level_.x0_of(fine), x1 = level_.x1_of(fine), first = x0 + ((x0 - level_.coarse_x) & 1);
    if (first >= x1) continue;
    int at = level_.slot(fine, first);
    const int after = at + (x1 - first + 1) / 2;
    const auto clear_until = [&](int slot) { std::fill(values_.u + at_slot(at), values_.u + at_slot(slot), 0.0f); };
    for (; run < end && 2 * coarse.x0_of(run) + level_.coarse_x < x1; ++run) {
      const int to = level_.slot(fine, 2 * coarse.x0_of(run) + level_.coarse_x);
      const int count = coarse.x1_of(run) - coarse.x0_of(run);
      clear_until(to);
      join(coarse_u + at_slot(coarse.first_of(run)), count, factor, values_.u + at_slot(to));
      at = to + count;
    }
    clear_until(after);
  }
}

void GridRows::correct(int row) {
  // Of the four neighbours only those in rows with coarse nodes carry anything.
  const bool level_ones = has_coarse_nodes(row);
  const int colour = 1 - level_.coarse_colour();
  for_cells(values_.u, row, colour, [&](int slot, const float*, const GridNeighbours& at, std::size_t count) {
    kernels_.add_half(values_.u + at_slot(slot), level_ones ? at.west : at.north, level_ones ? at.east : at.south,
                      count);
  });
}

void GridRows::correct_from_side(int row) {
  const bool level_ones = has_coarse_nodes(row);
  const int colour = 1 - level_.coarse_colour();
  for_cells(values_.u, row, colour, [&](int slot, const float* b, const GridNeighbours& at, std::size_t count) {
    kernels_.start_half(values_.u + at_slot(slot), b, level_ones ? at.west : at.north, level_ones ? at.east : at.south,
                        count, inverse_);
  });
}

const float* GridRows::residual(int row) {
  Residual& cached = residuals_[static_cast<std::size_t>(row) % residuals_.size()];
  if (cached.row == row) return cached.values.data();
  const std::size_t size = at_slot(level_.last_in(row) - level_.first_in(row));
  if (cached.values.size() < size) cached.values.resize(size);
  cached.row = row;
  if (of_ == Of::kValues)
    fill_residual(row, cached.values.data());
  else
    fill_residual_of_half(row, cached.values.data());
  return cached.values.data();
}

void GridRows::fill_residual(int row, float* r) {
  const int first = level_.first_in(row), colour = level_.coarse_colour();
  const float extra = level_.diagonal - 4;
  for_cells(values_.u, row, colour, [&](int slot, const float* b, const GridNeighbours& at, std::size_t count) {
    kernels_.residual(r + at_slot(slot - first), b, values_.u + at_slot(slot), at, count, extra);
  });
  for_irregular(row, colour, [&](std::size_t at, float scale) {
    const float surplus = level_.diagonal / scale - level_.diagonal;
    for (std::size_t k = 0; k < kC; ++k)
      r[at - at_slot(first) + k] -= surplus * values_.u[at + k];
  });
}

void GridRows::fill_residual_of_half(int row, float* r) {
  const int first = level_.first_in(row), colour = level_.coarse_colour();
  const bool is_side = of_ == Of::kSide;
  for_cells(is_side ? values_.b : values_.u, row, colour,
            [&](int slot, const float* b, const GridNeighbours& at, std::size_t count) {
              kernels_.eliminate(r + at_slot(slot - first), b, at, count, is_side ? inverse_ : 1);
            });
}

float GridRows::largest_residual(int row) {
  const float* const r = residual(row);
  float largest = 0;
  for (const GridPiece& piece : pieces(row)) {
    const GridPiece::Cells& cells = piece.cells[static_cast<std::size_t>(level_.coarse_colour())];
    if (cells.count == 0) continue;
    const float* const at = r + at_slot(cells.at - level_.first_in(row));
    largest = std::max(largest, kernels_.largest(at, at_slot(cells.count)));
  }
  return largest;
}

const float* GridRows::corners(int row, int side, int x0, int x1, std::vector<float>& room) {
  const int near = row + side;
  if (near < 0 || near >= level_.rows() || level_.y_of(near) != level_.y_of(row) + side) return zeros_;
  const float* const r = residual(near);
  const auto at = [&](int run, int x) { return r + at_slot(level_.slot(run, x) - level_.first_in(near)); };
  const auto begin = level_.runs.begin() + level_.begin_of(near), end = level_.runs.begin() + level_.end_of(near);
  const auto after = std::upper_bound(begin, end, x0, [](int x, const GridLevel::Run& run) { return x < run.x0; });
  int run = static_cast<int>(after - level_.runs.begin());
  if (after != begin && x1 < level_.x1_of(--run)) return at(run, x0);
  room.assign(at_slot((x1 - x0) / 2 + 1), 0.0f);
  for (; run < level_.end_of(near) && level_.x0_of(run) <= x1; ++run) {
    int from = std::max(x0, level_.x0_of(run));
    from += (from ^ x0) & 1;
    const int to = std::min(x1, level_.x1_of(run) - 1);
    if (from <= to) std::copy_n(at(run, from), at_slot((to - from) / 2 + 1), room.data() + at_slot((from - x0) / 2));
  }
  return room.data();
}

void GridRows::restrict_to(const GridLevel& coarse, int coarse_row, float* coarse_b) {
  const int y = 2 * coarse.y_of(coarse_row) + level_.coarse_y, row = level_.find_row(y);
  const float* const centre = residual(row);
  int fine = level_.begin_of(row);
  for (int run = coarse.begin_of(coarse_row); run < coarse.end_of(coarse_row); ++run) {
    const int length = coarse.x1_of(run) - coarse.x0_of(run), x = 2 * coarse.x0_of(run) + level_.coarse_x;
    while (level_.x1_of(fine) <= x)
      ++fine;
    const float* const above = corners(row, -1, x - 1, x + 2 * length - 1, corners_[0]);
    const float* const below = corners(row, 1, x - 1, x + 2 * length - 1, corners_[1]);
    if (line_.size() < at_slot(length + 1)) line_.resize(at_slot(length + 1));
    const float* const middle = centre + at_slot(level_.slot(fine, x) - level_.first_in(row));
    kernels_.weigh(line_.data(), middle, above, below, at_slot(length));
    split(line_.data(), length, coarse_b + at_slot(coarse.first_of(run)));
  }
}

void GridRows::restrict_half_to(const GridLevel& coarse, int coarse_row, float* coarse_b) {
  of_ = Of::kHalf;
  restrict_to(coarse, coarse_row, coarse_b);
}

void GridRows::restrict_side_to(const GridLevel& coarse, int coarse_row, float* coarse_b) {
  of_ = Of::kSide;
  restrict_to(coarse, coarse_row, coarse_b);
}

} // namespace oversketch
