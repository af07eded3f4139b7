#include "core/geometry/segment_tree.h"

#include "core/base/check.h"

#include <array>

namespace oversketch {

namespace {

struct Waiting {
  double squared;
  int level;
  int box;
};

/// Boxes still to be looked at: at most three siblings wait on each level while the fourth is open.
struct WaitingList {
  std::array<Waiting, 64> entries;
  int size = 0;

  void push(const Waiting& w) { entries[static_cast<std::size_t>(size++)] = w; }
  Waiting pop() { return entries[static_cast<std::size_t>(--size)]; }
};

} // namespace

SegmentTree::SegmentTree(const Points& points, bool closed) : ring_(points) {
  CHECK(!points.empty(), "a segment tree of no points");
  if (closed || points.size() == 1) ring_.push_back(points.front());
  levels_ = BoxLevels<Bounds>(static_cast<int>(ring_.size()) - 1, [&](int i) {
    const Point a = ring_[static_cast<std::size_t>(i)], b = ring_[static_cast<std::size_t>(i) + 1];
    return Bounds{{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
  });
}

SegmentHit SegmentTree::nearest(Point p) const {
  CHECK(is_finite(p), "nearest point to a point that is not finite");
  constexpr int arity = BoxLevels<Bounds>::kArity;
  SegmentHit best;
  WaitingList waiting;
  waiting.push({0, levels_.top(), 0});
  while (waiting.size > 0) {
    const Waiting here = waiting.pop();
    if (here.squared > best.squared) continue;
    const int begin = here.box * arity, end = levels_.children_end(here.level, here.box);
    if (here.level == 0) {
      for (int i = begin; i < end; ++i) {
        SegmentHit hit =
            nearest_on_segment(ring_[static_cast<std::size_t>(i)], ring_[static_cast<std::size_t>(i) + 1], p);
        hit.segment = i;
        if (hit.squared < best.squared || (hit.squared == best.squared && i < best.segment)) best = hit;
      }
      continue;
    }
    // The nearest child must be popped first: sorted by falling distance.
    std::array<Waiting, arity> children;
    int count = 0;
    for (int i = begin; i < end; ++i) {
      const Waiting child{levels_.box(here.level - 1, i).squared_distance(p), here.level - 1, i};
      if (child.squared > best.squared) continue;
      int k = count++;
      for (; k > 0 && children[static_cast<std::size_t>(k) - 1].squared <= child.squared; --k)
        children[static_cast<std::size_t>(k)] = children[static_cast<std::size_t>(k) - 1];
      children[static_cast<std::size_t>(k)] = child;
    }
    for (int k = 0; k < count; ++k)
      waiting.push(children[static_cast<std::size_t>(k)]);
  }
  return best;
}

} // namespace oversketch
