#include "core/base/check.h"
#include "core/clone/grid_level.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oversketch {
namespace {

constexpr std::size_t kLeft = 0, kRight = 1, kUp = 2, kDown = 3;

const GridBorder* find_border(const GridMaking& made, int number) {
  const auto at = std::lower_bound(made.border.begin(), made.border.end(), number,
                                   [](const GridBorder& border, int value) { return border.number < value; });
  return at != made.border.end() && at->number == number ? &*at : nullptr;
}

/// Calls `visit(row, piece)` for all pieces of a level, in order.
template <class Visit>
void for_pieces(const GridLevel& level, Visit visit) {
  std::vector<GridPiece> pieces;
  for (int row = 0; row < level.rows(); ++row) {
    expand_row(level, row, pieces);
    for (const GridPiece& piece : pieces)
      visit(row, piece);
  }
}

/// Which directions of the node at x of a piece are not connected.
std::array<bool, 4> missing_at(const GridLevel& level, const GridPiece& piece, int x) {
  return {x == level.x0_of(piece.run), x == level.x1_of(piece.run) - 1, piece.above < 0, piece.below < 0};
}

/// Calls `visit(row, piece, x, missing)` for the nodes with a direction missing, in order.
template <class Visit>
void for_border(const GridLevel& level, Visit visit) {
  for_pieces(level, [&](int row, const GridPiece& piece) {
    const bool all = piece.above < 0 || piece.below < 0;
    const int last = piece.x1 - 1;
    for (int x = piece.x0; x <= last; x = all || x == last ? x + 1 : last) {
      const std::array<bool, 4> missing = missing_at(level, piece, x);
      if (missing != std::array<bool, 4>{}) visit(row, piece, x, missing);
    }
  });
}

/// The part [x0, x1) of the finer level's columns, in columns of the coarser.
std::pair<int, int> halved(int x0, int x1, int offset) {
  return {(x0 - offset + 1) >> 1, ((x1 - 1 - offset) >> 1) + 1};
}

class Coarsener {
public:
  Coarsener(GridMaking& fine, double screening) : made_(fine), fine_(fine.level) {
    coarse_.spacing = 2 * fine.spacing;
    coarse_.level.diagonal = static_cast<float>(4 + screening * coarse_.spacing * coarse_.spacing);
  }

  GridMaking run() {
    choose_nodes();
    find_candidates();
    find_links();
    drop_isolated();
    number_nodes();
    if (coarse_.level.count() == 0) return std::move(coarse_);
    find_cuts();
    find_border_nodes();
    add_masses();
    weigh();
    return std::move(coarse_);
  }

private:
  struct Interval {
    int x0 = 0;
    int x1 = 0;
  };
  struct CoarseRow {
    int y = 0;
    int fine_row = 0;
    std::vector<Interval> runs;
    /// Connected with the next row, which then is y + 1.
    std::vector<Interval> links;
  };

  void choose_nodes() {
    std::array<std::int64_t, 4> counts{};
    for (int row = 0; row < fine_.rows(); ++row)
      for (int run = fine_.begin_of(row); run < fine_.end_of(row); ++run)
        for (int offset = 0; offset < 2; ++offset) {
          const auto [from, to] = halved(fine_.x0_of(run), fine_.x1_of(run), offset);
          counts[static_cast<std::size_t>(2 * (fine_.y_of(row) & 1) + offset)] += to - from;
        }
    const auto fewest = static_cast<int>(std::min_element(counts.begin(), counts.end()) - counts.begin());
    fine_.coarse_x = fewest & 1;
    fine_.coarse_y = fewest >> 1;
  }

  void find_candidates() {
    for (int row = 0; row < fine_.rows(); ++row) {
      const int y = fine_.y_of(row) - fine_.coarse_y;
      if ((y & 1) != 0) continue;
      CoarseRow made{y >> 1, row, {}, {}};
      for (int run = fine_.begin_of(row); run < fine_.end_of(row); ++run)
        if (const auto [from, to] = halved(fine_.x0_of(run), fine_.x1_of(run), fine_.coarse_x); from < to)
          made.runs.push_back({from, to});
      if (!made.runs.empty()) rows_.push_back(std::move(made));
    }
  }

  void find_links() {
    std::vector<GridPiece> pieces;
    for (std::size_t k = 0; k + 1 < rows_.size(); ++k) {
      const int between = rows_[k].fine_row + 1;
      if (rows_[k + 1].y != rows_[k].y + 1 || rows_[k + 1].fine_row != between + 1) continue;
      expand_row(fine_, between, pieces);
      for (const GridPiece& piece : pieces)
        if (piece.above >= 0 && piece.below >= 0)
          if (const auto [from, to] = halved(piece.x0, piece.x1, fine_.coarse_x); from < to)
            rows_[k].links.push_back({from, to});
    }
  }

  static bool is_linked(const std::vector<Interval>& links, int x) {
    const auto after = std::upper_bound(links.begin(), links.end(), x,
                                        [](int value, const Interval& link) { return value < link.x0; });
    return after != links.begin() && x < (after - 1)->x1;
  }

  void drop_isolated() {
    for (std::size_t k = 0; k < rows_.size(); ++k)
      std::erase_if(rows_[k].runs, [&](const Interval& run) {
        if (run.x1 - run.x0 > 1 || is_linked(rows_[k].links, run.x0)) return false;
        return k == 0 || rows_[k - 1].y + 1 != rows_[k].y || !is_linked(rows_[k - 1].links, run.x0);
      });
    std::erase_if(rows_, [](const CoarseRow& row) { return row.runs.empty(); });
  }

  void number_nodes() {
    GridLevel& level = coarse_.level;
    std::size_t runs = 0;
    bool has_gaps = false;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      runs += rows_[k].runs.size();
      has_gaps |= k > 0 && rows_[k].y != rows_[k - 1].y + 1;
    }
    level.runs.reserve(runs + 1);
    level.row_runs.reserve(rows_.size() + 1);
    int count = 0;
    if (!rows_.empty()) level.y0 = rows_.front().y;
    for (const CoarseRow& row : rows_) {
      level.row_runs.push_back(static_cast<int>(level.runs.size()));
      if (has_gaps) level.row_ys.push_back(row.y);
      for (const Interval& run : row.runs) {
        level.runs.push_back({run.x0, count});
        count += run.x1 - run.x0;
      }
    }
    level.row_runs.push_back(static_cast<int>(level.runs.size()));
    level.runs.push_back({0, count});
  }

  /// Pairs above each other that are not linked.  Found before there are cuts, so that pieces show all such pairs.
  void find_cuts() {
    std::vector<int> cuts;
    for_pieces(coarse_.level, [&](int row, const GridPiece& piece) {
      if (piece.below < 0) return;
      const std::vector<Interval>& links = rows_[static_cast<std::size_t>(row)].links;
      const int base = coarse_.level.first_of(piece.run) - coarse_.level.x0_of(piece.run);
      auto link = std::lower_bound(links.begin(), links.end(), piece.x0,
                                   [](const Interval& one, int x) { return one.x1 <= x; });
      for (int x = piece.x0; x < piece.x1;) {
        while (link != links.end() && link->x1 <= x)
          ++link;
        if (link != links.end() && link->x0 <= x)
          x = link->x1;
        else
          cuts.push_back(base + x++);
      }
    });
    cuts.shrink_to_fit();
    coarse_.level.cuts = std::move(cuts);
  }

  void find_border_nodes() {
    for_border(coarse_.level, [&](int row, const GridPiece& piece, int x, const std::array<bool, 4>& missing) {
      const int fx = 2 * x + fine_.coarse_x, fy = 2 * coarse_.level.y_of(row) + fine_.coarse_y;
      GridBorder border{coarse_.level.first_of(piece.run) + x - coarse_.level.x0_of(piece.run), {}, 0};
      constexpr std::array<int, 4> kX = {-1, 1, 0, 0}, kY = {0, 0, -1, 1};
      for (std::size_t side = 0; side < 4; ++side)
        if (missing[side]) border.distance[side] = distance(fx, fy, kX[side], kY[side], side);
      coarse_.border.push_back(border);
      coarse_.is_tricky |= is_thin_wall(piece, x, coarse_.level.y_of(row), missing);
    });
  }

  /// Whether one missing node, or none, parts the node from another to its right or below.
  bool is_thin_wall(const GridPiece& piece, int x, int y, const std::array<bool, 4>& missing) const {
    const GridLevel& level = coarse_.level;
    const bool is_last = piece.run + 2 == static_cast<int>(level.runs.size());
    const bool right =
        missing[kRight] && !is_last && level.x0_of(piece.run + 1) > x && level.x0_of(piece.run + 1) <= x + 2;
    return right || (missing[kDown] && (level.find(x, y + 1) >= 0 || level.find(x, y + 2) >= 0));
  }

  /// From the finer level's node (x, y) to the boundary, which lies within two of its steps.
  float distance(int x, int y, int dx, int dy, std::size_t side) const {
    const GridBorder* here = find_border(made_, fine_.find(x, y));
    if (here != nullptr && here->distance[side] > 0) return here->distance[side];
    const GridBorder* next = find_border(made_, fine_.find(x + dx, y + dy));
    CHECK(next != nullptr && next->distance[side] > 0, "a pair of nodes is connected or meets the boundary");
    return static_cast<float>(made_.spacing) + next->distance[side];
  }

  bool is_intact(int x, int y) const {
    const GridLevel& level = coarse_.level;
    const int upper = level.find_row(y), lower = level.find_row(y + 1);
    if (upper < 0 || lower < 0) return false;
    const int above = level.find_run(upper, x), below = level.find_run(lower, x);
    if (above < 0 || below < 0 || level.x1_of(above) <= x + 1 || level.x1_of(below) <= x + 1) return false;
    const int number = level.first_of(above) + x - level.x0_of(above);
    return !level.is_cut(number) && !level.is_cut(number + 1);
  }

  using Mass = std::pair<int, float>;

  /// Spreads an entry of the finer level's (x, y), counted from the coarse nodes, over the nodes round it.
  void spread(float mass, int x, int y, std::vector<Mass>& out) const {
    const int nx = 1 + (x & 1), ny = 1 + (y & 1);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        if (const int number = coarse_.level.find((x >> 1) + i, (y >> 1) + j); number >= 0)
          out.push_back({number, mass / static_cast<float>(nx * ny)});
  }

  /// What node (x, y), half-way between two coarse nodes, has lost towards the middles of the cells on both sides.
  void spread_lost(const GridBorder& border, int x, int y, std::vector<Mass>& out) const {
    const bool across = (x & 1) != 0;
    for (const int step : {-1, 1}) {
      const std::size_t side = across ? (step < 0 ? kUp : kDown) : (step < 0 ? kLeft : kRight);
      if (border.distance[side] == 0) continue;
      const int cx = across ? x : x + step, cy = across ? y + step : y;
      if (is_intact(cx >> 1, cy >> 1)) spread(static_cast<float>(made_.spacing) / border.distance[side], cx, cy, out);
    }
  }

  void add_masses() {
    std::vector<Mass> masses;
    std::size_t run = 0, row = 0;
    for (const GridBorder& border : made_.border) {
      while (fine_.first_of(static_cast<int>(run) + 1) <= border.number)
        ++run;
      while (fine_.row_runs[row + 1] <= static_cast<int>(run))
        ++row;
      const int x = fine_.runs[run].x0 + border.number - fine_.runs[run].first - fine_.coarse_x;
      const int y = fine_.y_of(static_cast<int>(row)) - fine_.coarse_y;
      if (border.mass > 0) spread(border.mass, x, y, masses);
      if (((x ^ y) & 1) != 0) spread_lost(border, x, y, masses);
    }
    std::stable_sort(masses.begin(), masses.end(), [](const Mass& a, const Mass& b) { return a.first < b.first; });
    coarse_.is_tricky |= !masses.empty();
    merge(masses);
  }

  void merge(const std::vector<Mass>& masses) {
    std::vector<GridBorder> out;
    out.reserve(coarse_.border.size() + masses.size());
    auto at = masses.begin();
    const auto take = [&](GridBorder border) {
      for (; at != masses.end() && at->first == border.number; ++at)
        border.mass += at->second;
      out.push_back(border);
    };
    for (const GridBorder& border : coarse_.border) {
      while (at != masses.end() && at->first < border.number)
        take({at->first, {}, 0});
      take(border);
    }
    while (at != masses.end())
      take({at->first, {}, 0});
    coarse_.border = std::move(out);
  }

  void weigh() {
    GridLevel& level = coarse_.level;
    std::size_t run = 0, row = 0;
    for (const GridBorder& border : coarse_.border) {
      double change = border.mass;
      for (const float distance : border.distance)
        if (distance > 0) change += coarse_.spacing / distance - 1;
      if (std::abs(change) < 1e-6) continue;
      while (level.first_of(static_cast<int>(run) + 1) <= border.number)
        ++run;
      while (level.row_runs[row + 1] <= static_cast<int>(run))
        ++row;
      const int x = level.runs[run].x0 + border.number - level.runs[run].first;
      const auto colour = static_cast<std::size_t>((x + level.y_of(static_cast<int>(row))) & 1);
      level.irregular[colour].push_back(
          {level.slot(static_cast<int>(run), x), static_cast<float>(level.diagonal / (level.diagonal + change))});
    }
    for (auto& list : level.irregular) {
      std::sort(list.begin(), list.end(),
                [](const GridLevel::Irregular& a, const GridLevel::Irregular& b) { return a.slot < b.slot; });
      list.shrink_to_fit();
    }
  }

  GridMaking& made_;
  GridLevel& fine_;
  GridMaking coarse_;
  std::vector<CoarseRow> rows_;
};

} // namespace

GridMaking make_finest(const Mask& mask, double screening) {
  GridMaking made;
  made.level = make_finest_level(mask, screening);
  for_border(made.level, [&](int, const GridPiece& piece, int x, const std::array<bool, 4>& missing) {
    GridBorder border{made.level.first_of(piece.run) + x - made.level.x0_of(piece.run), {}, 0};
    for (std::size_t side = 0; side < 4; ++side)
      border.distance[side] = missing[side] ? 1.0f : 0.0f;
    made.border.push_back(border);
  });
  return made;
}

GridMaking coarsen(GridMaking& fine, double screening) {
  return Coarsener(fine, screening).run();
}

} // namespace oversketch
