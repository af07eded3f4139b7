#include "core/geometry/box_levels.h"
#include "core/geometry/curve.h"
#include "core/geometry/predicates.h"

#include <array>
#include <cstddef>
#include <limits>

namespace oversketch {

namespace {

/// Turned axes along and across the direction in which most of the line's length runs: hatching, where boxes along x
/// and y all overlap, is thin across it.
struct Frame {
  Point along{1, 0};

  std::array<double, 2> operator()(Point p) const { return {dot(along, p), cross(along, p)}; }
};

/// Bounds of segments along x, y and the two turned axes; conservative for every point of the true segments.
struct Bounds {
  std::array<double, 4> low{HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::array<double, 4> high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Bounds& other) {
    for (std::size_t k = 0; k < 4; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  void add(Point p, const Frame& frame) {
    const auto [u, v] = frame(p);
    // Two roundings of products and one of their sum, each below half an ulp of |x| + |y|.
    const double slack = 2 * std::numeric_limits<double>::epsilon() * (std::abs(p.x) + std::abs(p.y));
    add({{p.x, p.y, u - slack, v - slack}, {p.x, p.y, u + slack, v + slack}});
  }
  bool overlaps(const Bounds& other) const {
    bool all = true;
    for (std::size_t k = 0; k < 4; ++k)
      all &= low[k] <= other.high[k] && other.low[k] <= high[k];
    return all;
  }
};

/// Segments of positive length, each with the number that it has among all.
class Segments {
public:
  Segments(const Points& points, bool closed) : closed_(closed) {
    const std::size_t n = points.size(), last = closed ? n : n - 1;
    for (std::size_t i = 0; i < last; ++i) {
      if (points[i] == points[i + 1 < n ? i + 1 : 0]) continue;
      starts_.push_back(points[i]);
      numbers_.push_back(static_cast<int>(i));
    }
    if (!starts_.empty()) starts_.push_back(closed ? points[0] : points[n - 1]);
    set_frame();
    levels_ = BoxLevels<Bounds>(size(), [this](int i) { return bounds(i); });
  }

  int size() const { return static_cast<int>(numbers_.size()); }
  int number(int i) const { return numbers_[static_cast<std::size_t>(i)]; }
  Point start(int i) const { return starts_[static_cast<std::size_t>(i)]; }
  Point end(int i) const { return starts_[static_cast<std::size_t>(i) + 1]; }

  /// The first segment after i that it crosses; −1 when there is none.
  int first_crossed_by(int i) const {
    const Bounds mine = bounds(i);
    return search(i, mine, levels_.top(), 0);
  }

private:
  Bounds bounds(int i) const {
    Bounds box;
    box.add(start(i), frame_);
    box.add(end(i), frame_);
    return box;
  }

  void set_frame() {
    // Doubling the angle lets opposite directions add up.
    std::complex<double> sum = 0;
    for (int i = 0; i < size(); ++i) {
      const std::complex<double> way = to_complex(end(i) - start(i));
      sum += way * (way / std::abs(way));
    }
    const std::complex<double> root = std::sqrt(sum);
    if (std::abs(root) > 0 && std::isfinite(std::abs(root))) frame_.along = to_point(root / std::abs(root));
  }

  int search(int i, const Bounds& mine, int level, int box) const {
    if (!levels_.box(level, box).overlaps(mine)) return -1;
    const int end = levels_.children_end(level, box);
    for (int child = box * levels_.kArity; child < end; ++child) {
      if (level == 0) {
        if (child > i && cross(i, child)) return child;
      } else if (last_item(level - 1, child) > i) {
        if (const int found = search(i, mine, level - 1, child); found >= 0) return found;
      }
    }
    return -1;
  }

  /// Upper bound of the items under a box.
  std::int64_t last_item(int level, int box) const {
    return (static_cast<std::int64_t>(box) + 1) * (4LL << (2 * level)) - 1;
  }

  bool cross(int i, int j) const {
    const Point a = start(i), b = end(i), c = start(j), d = end(j);
    const bool follows = j == i + 1, precedes = closed_ && i == 0 && j == size() - 1;
    if (follows || precedes) return (follows && folds_back(a, b, d)) || (precedes && folds_back(c, a, b));
    return segments_touch(a, b, c, d);
  }

  bool closed_;
  Points starts_;
  std::vector<int> numbers_;
  Frame frame_;
  BoxLevels<Bounds> levels_;
};

/// A common point of two touching segments, to rounding.
Point common_point(Point a, Point b, Point c, Point d) {
  const Point along = b - a, other = d - c;
  const double turn = cross(along, other);
  const bool on_one_line = orientation(a, b, c) == 0 && orientation(a, b, d) == 0;
  if (!on_one_line && turn != 0) return lerp(a, b, std::clamp(cross(c - a, other) / turn, 0.0, 1.0));
  // Overlapping on one line: the end of one that lies in the other, found by order along the line.
  const auto place = [&](Point p) { return dot(p - a, along) / dot(along, along); };
  return lerp(a, b, std::clamp(std::min(place(c), place(d)), 0.0, 1.0));
}

} // namespace

std::optional<Crossing> find_self_crossing(const Points& points, bool closed) {
  for (const Point p : points)
    CHECK(is_finite(p), "a line that is tested for crossings must be finite");
  if (points.size() < 2) return std::nullopt;
  const Segments segments(points, closed);
  for (int i = 0; i < segments.size(); ++i) {
    const int j = segments.first_crossed_by(i);
    if (j < 0) continue;
    const Point place = common_point(segments.start(i), segments.end(i), segments.start(j), segments.end(j));
    return Crossing{segments.number(i), segments.number(j), place};
  }
  return std::nullopt;
}

} // namespace oversketch
