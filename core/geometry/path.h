#pragma once

#include "core/base/check.h"
#include "core/geometry/point.h"

#include <cstddef>
#include <utility>

namespace oversketch {

/// An open polyline by arc length.  At least one point; repeats are allowed.
class Path {
public:
  explicit Path(Points points) : points_(std::move(points)), arc_(points_.size()) {
    CHECK(!points_.empty(), "a path needs points");
    for (std::size_t i = 1; i < points_.size(); ++i)
      arc_[i] = arc_[i - 1] + distance(points_[i - 1], points_[i]);
  }

  const Points& points() const { return points_; }
  double length() const { return arc_.back(); }
  double s_at(std::size_t i) const { return arc_[i]; }
  /// The point at arc length s; the ends before and after.  O(log n).
  Point at(double s) const {
    if (!(s > 0)) return points_.front();
    const auto after = std::upper_bound(arc_.begin(), arc_.end(), s);
    if (after == arc_.end()) return points_.back();
    const std::size_t i = static_cast<std::size_t>(after - arc_.begin());
    return lerp(points_[i - 1], points_[i], (s - arc_[i - 1]) / (arc_[i] - arc_[i - 1]));
  }

private:
  Points points_;
  std::vector<double> arc_;
};

} // namespace oversketch
