#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace oversketch {

/// Boxes round runs of consecutive items, then round runs of those, up to one: a search tree that keeps the items'
/// order.
///
/// Level 0 holds one box for every kArity items, level k one for every kArity boxes of level k − 1.  Items that follow
/// a curve are near each other already, so no sorting is needed; memory is at most n / 3 + O(log n) boxes, whatever the
/// input.
///
/// `BoxType` is default-made empty and has `void add(const BoxType&)`.
template <class BoxType>
class BoxLevels {
public:
  static constexpr int kArity = 4;

  BoxLevels() = default;
  /// `box_of(i)` is the box of item i, 0 ≤ i < count.  O(count).
  template <class BoxOf>
  BoxLevels(int count, BoxOf&& box_of) : count_(count) {
    if (count <= 0) return;
    starts_.push_back(0);
    for (int i = 0; i < count; i += kArity) {
      BoxType box;
      for (int k = i; k < std::min(count, i + kArity); ++k)
        box.add(box_of(k));
      boxes_.push_back(box);
    }
    while (static_cast<int>(boxes_.size()) - starts_.back() > 1)
      add_level();
  }

  int item_count() const { return count_; }
  /// Number of the level with one box; −1 when there are no items.
  int top() const { return static_cast<int>(starts_.size()) - 1; }
  int size(int level) const {
    const bool last = level == top();
    return (last ? static_cast<int>(boxes_.size()) : starts_[static_cast<std::size_t>(level) + 1]) - start(level);
  }
  const BoxType& box(int level, int i) const { return boxes_[static_cast<std::size_t>(start(level) + i)]; }
  /// Children of box i of a level run from i · kArity to before this: boxes of the level below, or items for level 0.
  int children_end(int level, int i) const { return std::min((i + 1) * kArity, level == 0 ? count_ : size(level - 1)); }

private:
  int start(int level) const { return starts_[static_cast<std::size_t>(level)]; }
  void add_level() {
    const int begin = starts_.back(), end = static_cast<int>(boxes_.size());
    starts_.push_back(end);
    for (int i = begin; i < end; i += kArity) {
      BoxType box;
      for (int k = i; k < std::min(end, i + kArity); ++k)
        box.add(boxes_[static_cast<std::size_t>(k)]);
      boxes_.push_back(box);
    }
  }

  int count_ = 0;
  std::vector<BoxType> boxes_;
  std::vector<int> starts_;
};

} // namespace oversketch
