#include "core/clone/quadtree.h"

#include "core/base/check.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <utility>

namespace oversketch {
namespace {

using Leaf = Quadtree::Leaf;

/// The runs of a mask, found by row.
class Rows {
public:
  explicit Rows(const Mask& mask) : runs_(mask.runs()), top_(mask.bounds().y) {
    start_.reserve(static_cast<std::size_t>(mask.bounds().height) + 1);
    for (std::size_t k = 0; k < runs_.size(); ++k)
      while (static_cast<int>(start_.size()) <= runs_[k].y - top_)
        start_.push_back(k);
    start_.push_back(runs_.size());
  }

  /// Runs of the rows y0 ≤ y < y1.
  std::pair<std::size_t, std::size_t> between(int y0, int y1) const {
    const int last = static_cast<int>(start_.size()) - 1;
    return {start_[static_cast<std::size_t>(std::clamp(y0 - top_, 0, last))],
            start_[static_cast<std::size_t>(std::clamp(y1 - top_, 0, last))]};
  }

  /// All pixels x0 ≤ x < x1 of a row.
  bool covers(int x0, int x1, int y) const {
    const std::size_t k = first_right_of(x0, y);
    return k < runs_.size() && runs_[k].y == y && runs_[k].x0 <= x0 && runs_[k].x1 >= x1;
  }

  /// Any of them.
  bool meets(int x0, int x1, int y) const {
    const std::size_t k = first_right_of(x0, y);
    return k < runs_.size() && runs_[k].y == y && runs_[k].x0 < x1;
  }

private:
  /// The first run of the row that ends right of x.
  std::size_t first_right_of(int x, int y) const {
    auto [low, high] = between(y, y + 1);
    if (y < top_) return runs_.size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (runs_[middle].x1 > x)
        high = middle;
      else
        low = middle + 1;
    }
    return low;
  }

  const std::vector<Mask::Run>& runs_;
  int top_;
  std::vector<std::size_t> start_;
};

class Cutter {
public:
  Cutter(const Mask& mask, int k) : mask_(mask), rows_(mask), k_(k) {}

  std::vector<Leaf> cut() {
    const Rect& box = mask_.bounds();
    const auto widest = static_cast<unsigned>(std::min(box.width, box.height) / (2 * k_ + 1));
    const int size = static_cast<int>(std::bit_floor(std::max(widest, 1U)));
    for (int y = box.y; y < box.bottom(); y += size)
      cut_strip(y, size);
    return std::move(leaves_);
  }

private:
  /// Squares of the strip that hold pixels of the mask; not the others, of which a box may have many more.
  void cut_strip(int y, int size) {
    const auto [first, last] = rows_.between(y, y + size);
    columns_.clear();
    for (std::size_t k = first; k < last; ++k) {
      const Mask::Run& run = mask_.runs()[k];
      const int x = mask_.bounds().x;
      columns_.push_back({(run.x0 - x) / size, (run.x1 - 1 - x) / size});
    }
    std::sort(columns_.begin(), columns_.end());
    int next = 0;
    for (const auto& [from, to] : columns_)
      for (next = std::max(next, from); next <= to; ++next)
        visit(mask_.bounds().x + next * size, y, size);
  }

  void visit(int x, int y, int size) {
    if (size == 1) {
      if (rows_.covers(x, x + 1, y)) leaves_.push_back({x, y, 1});
      return;
    }
    if (is_deep(x, y, size)) {
      leaves_.push_back({x, y, size});
      return;
    }
    if (size > 2 && !meets(x, y, size)) return;
    const int half = size / 2;
    for (const int dy : {0, half})
      for (const int dx : {0, half})
        visit(x + dx, y + dy, half);
  }

  bool is_deep(int x, int y, int size) const {
    const int margin = k_ * size + 1;
    const int x0 = x - margin, x1 = x + size + margin, y0 = y - margin, y1 = y + size + margin;
    // The outermost rows first: where the answer is no, they mostly know.
    if (!rows_.covers(x0, x1, y0) || !rows_.covers(x0, x1, y1 - 1)) return false;
    for (int row = y0 + 1; row < y1 - 1; ++row)
      if (!rows_.covers(x0, x1, row)) return false;
    return true;
  }

  bool meets(int x, int y, int size) const {
    for (int row = y; row < y + size; ++row)
      if (rows_.meets(x, x + size, row)) return true;
    return false;
  }

  const Mask& mask_;
  Rows rows_;
  int k_;
  std::vector<Leaf> leaves_;
  std::vector<std::pair<int, int>> columns_;
};

/// Numbers the points and ties those that hang.
class Tier {
public:
  Tier(Quadtree& tree, const Rect& box) : tree_(tree), box_(box) {}

  void tie() {
    const auto count = static_cast<int>(tree_.leaves.size());
    tree_.points = count;
    tree_.unknown.assign(tree_.leaves.size(), 0);
    for (int i = 0; i < count; ++i)
      tie_first(i);
    for (int i = 0; i < count; ++i)
      add_corners(i);
    for (int& number : tree_.unknown)
      if (number == 0) number = tree_.unknowns++;
  }

private:
  /// Whether a coordinate, counted from the box, is a multiple.
  static bool divides(int size, int from_box) { return (from_box & (size - 1)) == 0; }

  void hang(int point, int first, int second) {
    CHECK(first >= 0 && second >= 0, "the ends of an edge with a hanging point are first pixels");
    tree_.unknown[static_cast<std::size_t>(point)] = -1;
    tree_.hanging.push_back({point, {first, second}});
  }

  /// A leaf's first pixel hangs on the right or lower edge of a leaf twice as large.
  void tie_first(int i) {
    const auto [x, y, s] = tree_.leaf(i);
    const bool even_x = divides(2 * s, x - box_.x), even_y = divides(2 * s, y - box_.y);
    if (even_x && !even_y && is_leaf(x - 2 * s, y - s, 2 * s)) hang(i, tree_.find(x, y - s), tree_.find(x, y + s));
    if (even_y && !even_x && is_leaf(x - s, y - 2 * s, 2 * s)) hang(i, tree_.find(x - s, y), tree_.find(x + s, y));
  }

  bool is_leaf(int x, int y, int size) const {
    const int leaf = tree_.find(x, y);
    return leaf >= 0 && tree_.leaf(leaf).size == size;
  }

  void add_corners(int i) {
    const auto [x, y, s] = tree_.leaf(i);
    tree_.corners.push_back({at(x + s, y, s), at(x, y + s, s), s > 1 ? at(x + s, y + s, s) : -1});
  }

  /// The point at a corner of a leaf of that size, −1 outside the mask.
  int at(int x, int y, int s) {
    if (const int leaf = tree_.find(x, y); leaf >= 0) return leaf;
    // No leaf begins here: it is halfway along the left or upper edge of a leaf twice as large.
    const bool on_left = divides(2 * s, x - box_.x) && is_leaf(x, y - s, 2 * s);
    if (!on_left && !is_leaf(x - s, y, 2 * s)) return -1;
    const auto [place, is_new] = between_.try_emplace({x, y}, tree_.points);
    if (!is_new) return place->second;
    tree_.unknown.push_back(-1);
    if (on_left)
      hang(tree_.points, tree_.find(x, y - s), tree_.find(x, y + s));
    else
      hang(tree_.points, tree_.find(x - s, y), tree_.find(x + s, y));
    return tree_.points++;
  }

  Quadtree& tree_;
  Rect box_;
  std::map<std::pair<int, int>, int> between_;
};

} // namespace

Quadtree::Quadtree(const Mask& mask, int k) : top_(mask.bounds().y) {
  CHECK(k >= 1 && k <= 16, "leaves grow with the distance");
  CHECK(!mask.empty(), "a mask to cut up");
  // Cut in an order that has each row's leaves from left to right: it is enough to sort by rows.
  const std::vector<Leaf> cut = Cutter(mask, k).cut();
  row_start_.assign(static_cast<std::size_t>(mask.bounds().height) + 1, 0);
  for (const Leaf& leaf : cut)
    ++row_start_[static_cast<std::size_t>(leaf.y - top_) + 1];
  std::partial_sum(row_start_.begin(), row_start_.end(), row_start_.begin());
  std::vector<int> next(row_start_.begin(), row_start_.end() - 1);
  leaves.resize(cut.size());
  for (const Leaf& leaf : cut)
    leaves[static_cast<std::size_t>(next[static_cast<std::size_t>(leaf.y - top_)]++)] = leaf;
  Tier(*this, mask.bounds()).tie();
  for (const Mask::Run& run : mask.runs())
    first_leaf.push_back(find(run.x0, run.y));
}

int Quadtree::find(int x, int y) const {
  const int row = y - top_;
  if (row < 0 || row + 1 >= static_cast<int>(row_start_.size())) return -1;
  const auto first = leaves.begin() + row_start_[static_cast<std::size_t>(row)];
  const auto last = leaves.begin() + row_start_[static_cast<std::size_t>(row) + 1];
  const auto leaf = std::lower_bound(first, last, x, [](const Leaf& a, int column) { return a.x < column; });
  return leaf != last && leaf->x == x ? static_cast<int>(leaf - leaves.begin()) : -1;
}

} // namespace oversketch
