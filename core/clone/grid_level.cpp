#include "core/clone/grid_level.h"

#include <algorithm>
#include <limits>

namespace oversketch {
namespace {

template <class T>
std::int64_t allocated(const std::vector<T>& values) {
  return static_cast<std::int64_t>(values.capacity() * sizeof(T));
}

/// Walks along the runs of a neighbouring row: what lies above or below x, and how far that stays so.
class Side {
public:
  /// @param cut_step  a pair is cut by the number of its upper node: 0 where that is the neighbour, else the offset
  ///   is told by `here`.
  Side(const GridLevel& level, int row, int y, bool neighbour_is_upper)
      : level_(level), neighbour_is_upper_(neighbour_is_upper) {
    if (row < 0 || row >= level.rows() || level.y_of(row) != y) return;
    run_ = level.begin_of(row);
    end_ = level.end_of(row);
  }

  struct Answer {
    int run = -1;
    int stop = 0;
  };

  /// @param here  number of the node at x.  x must not decrease from call to call.
  Answer at(int x, int here) {
    while (run_ < end_ && level_.x1_of(run_) <= x)
      ++run_;
    constexpr int kFar = std::numeric_limits<int>::max();
    if (run_ >= end_) return {-1, kFar};
    if (level_.x0_of(run_) > x) return {-1, level_.x0_of(run_)};
    const int stop = level_.x1_of(run_);
    if (level_.cuts.empty()) return {run_, stop};
    const int upper = neighbour_is_upper_ ? level_.first_of(run_) + x - level_.x0_of(run_) : here;
    const auto cut = std::lower_bound(level_.cuts.begin(), level_.cuts.end(), upper);
    if (cut == level_.cuts.end()) return {run_, stop};
    if (*cut == upper) return {-1, x + 1};
    return {run_, std::min(stop, x + (*cut - upper))};
  }

private:
  const GridLevel& level_;
  bool neighbour_is_upper_;
  int run_ = 0;
  int end_ = 0;
};

GridPiece::Cells cells_of(const GridLevel& level, const GridPiece& piece, int y, int colour, int run_above,
                          int run_below) {
  GridPiece::Cells cells;
  const int x = piece.x0 + ((piece.x0 + y + colour) & 1);
  cells.count = (piece.x1 - x + 1) / 2;
  if (cells.count <= 0) {
    cells.count = 0;
    return cells;
  }
  const int run = piece.run, x0 = level.x0_of(run), first = level.first_of(run), i = x - x0;
  const int odd = first + (level.first_of(run + 1) - first + 1) / 2;
  cells.at = (i & 1) == 0 ? first + i / 2 : odd + i / 2;
  cells.west = (i & 1) == 0 ? odd + i / 2 - 1 : first + i / 2;
  if (run_above >= 0) cells.north = level.slot(run_above, x);
  if (run_below >= 0) cells.south = level.slot(run_below, x);
  cells.opens = i == 0;
  cells.closes = x + 2 * (cells.count - 1) == level.x1_of(run) - 1;
  return cells;
}

} // namespace

int GridLevel::find_row(int y) const {
  if (row_ys.empty()) return y >= y0 && y - y0 < rows() ? y - y0 : -1;
  const auto at = std::lower_bound(row_ys.begin(), row_ys.end(), y);
  return at != row_ys.end() && *at == y ? static_cast<int>(at - row_ys.begin()) : -1;
}

int GridLevel::find_run(int row, int x) const {
  const auto begin = runs.begin() + begin_of(row), end = runs.begin() + end_of(row);
  const auto after = std::upper_bound(begin, end, x, [](int value, const Run& run) { return value < run.x0; });
  if (after == begin) return -1;
  const int run = static_cast<int>(after - 1 - runs.begin());
  return x < x1_of(run) ? run : -1;
}

int GridLevel::find(int x, int y) const {
  const int row = find_row(y);
  if (row < 0) return -1;
  const int run = find_run(row, x);
  return run < 0 ? -1 : first_of(run) + x - x0_of(run);
}

bool GridLevel::is_cut(int number) const {
  return std::binary_search(cuts.begin(), cuts.end(), number);
}

std::int64_t GridRowIndex::bytes() const {
  return allocated(pieces) + allocated(first_piece) + allocated(first_irregular[0]) + allocated(first_irregular[1]);
}

std::int64_t GridLevel::bytes() const {
  return allocated(row_ys) + allocated(row_runs) + allocated(runs) + allocated(cuts) + allocated(irregular[0]) +
         allocated(irregular[1]) + index.bytes();
}

void expand_row(const GridLevel& level, int row, std::vector<GridPiece>& out) {
  out.clear();
  const int y = level.y_of(row);
  Side up(level, row - 1, y - 1, true), down(level, row + 1, y + 1, false);
  for (int run = level.begin_of(row); run < level.end_of(row); ++run) {
    const int x0 = level.x0_of(run), x1 = level.x1_of(run), first = level.first_of(run);
    for (int x = x0; x < x1;) {
      const Side::Answer above = up.at(x, first + x - x0), below = down.at(x, first + x - x0);
      GridPiece piece;
      piece.x0 = x;
      piece.x1 = std::min({x1, above.stop, below.stop});
      piece.run = run;
      if (above.run >= 0) piece.above = level.first_of(above.run) + x - level.x0_of(above.run);
      if (below.run >= 0) piece.below = level.first_of(below.run) + x - level.x0_of(below.run);
      for (int colour = 0; colour < 2; ++colour)
        piece.cells[static_cast<std::size_t>(colour)] = cells_of(level, piece, y, colour, above.run, below.run);
      out.push_back(piece);
      x = piece.x1;
    }
  }
}

std::int64_t index_rows(GridLevel& level, std::int64_t most_bytes) {
  const int rows = level.rows();
  const std::int64_t of_rows = 3 * (rows + 1) * static_cast<std::int64_t>(sizeof(int));
  const auto room = [&](std::size_t pieces) {
    return of_rows + static_cast<std::int64_t>(pieces * sizeof(GridPiece)) <= most_bytes;
  };
  GridRowIndex index;
  const auto begin_row = [](std::vector<int>& first, std::size_t at) { first.push_back(static_cast<int>(at)); };
  std::array<std::size_t, 2> irregular{};
  std::vector<GridPiece> pieces;
  for (int row = 0; row < rows; ++row) {
    expand_row(level, row, pieces);
    if (!room(index.pieces.size() + pieces.size())) return 0;
    begin_row(index.first_piece, index.pieces.size());
    index.pieces.insert(index.pieces.end(), pieces.begin(), pieces.end());
    for (std::size_t colour = 0; colour < 2; ++colour) {
      const std::vector<GridLevel::Irregular>& list = level.irregular[colour];
      std::size_t& at = irregular[colour];
      while (at < list.size() && list[at].slot < level.first_in(row))
        ++at;
      begin_row(index.first_irregular[colour], at);
    }
  }
  begin_row(index.first_piece, index.pieces.size());
  for (std::size_t colour = 0; colour < 2; ++colour)
    begin_row(index.first_irregular[colour], level.irregular[colour].size());
  for (std::vector<int>* first : {&index.first_piece, &index.first_irregular[0], &index.first_irregular[1]})
    first->shrink_to_fit();
  index.pieces.shrink_to_fit();
  level.index = std::move(index);
  return level.index.bytes();
}

GridLevel make_finest_level(const Mask& mask, double screening) {
  GridLevel level;
  const std::vector<Mask::Run>& runs = mask.runs();
  level.diagonal = static_cast<float>(4 + screening);
  level.runs.reserve(runs.size() + 1);
  int rows = 0, y = 0, count = 0;
  bool has_gaps = false;
  for (const Mask::Run& run : runs) {
    if (rows == 0 || run.y != y) {
      has_gaps |= rows > 0 && run.y != y + 1;
      ++rows;
    }
    y = run.y;
  }
  level.row_runs.reserve(static_cast<std::size_t>(rows) + 1);
  if (has_gaps) level.row_ys.reserve(static_cast<std::size_t>(rows));
  if (!runs.empty()) level.y0 = runs.front().y;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (k == 0 || runs[k].y != runs[k - 1].y) {
      level.row_runs.push_back(static_cast<int>(k));
      if (has_gaps) level.row_ys.push_back(runs[k].y);
    }
    level.runs.push_back({runs[k].x0, count});
    count += runs[k].x1 - runs[k].x0;
  }
  level.row_runs.push_back(static_cast<int>(runs.size()));
  level.runs.push_back({0, count});
  return level;
}

} // namespace oversketch
