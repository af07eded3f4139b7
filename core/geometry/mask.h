#pragma once

#include "core/base/rect.h"
#include "core/geometry/point.h"

#include <cstdint>
#include <vector>

namespace oversketch {

/// A set of pixels as runs, row by row.  Memory follows the number of runs, not the box round them.
///
/// Runs are sorted by y, then x, are not empty, and neither touch nor overlap within a row.  Coordinates may be
/// negative.
class Mask {
public:
  /// Pixels x0 ≤ x < x1 of row y.
  struct Run {
    int y = 0;
    int x0 = 0;
    int x1 = 0;
    bool operator==(const Run&) const = default;
  };

  Mask() = default;
  /// Takes runs in any order; overlapping and touching ones are merged, empty ones dropped.
  explicit Mask(std::vector<Run> runs);

  const std::vector<Run>& runs() const { return runs_; }
  /// The smallest rectangle round all pixels; all zero when there are none.
  const Rect& bounds() const { return bounds_; }
  std::int64_t count() const { return count_; }
  bool empty() const { return count_ == 0; }
  /// O(log runs).
  bool contains(int x, int y) const;
  bool operator==(const Mask& other) const { return runs_ == other.runs_; }

private:
  std::vector<Run> runs_;
  Rect bounds_;
  std::int64_t count_ = 0;
};

Mask translated(const Mask& mask, int dx, int dy);

/// The mask and every pixel that touches it by side or corner.  O(runs); nothing the size of the box is made.
Mask grown(const Mask& mask);

/// The pixels of the mask that lie in the rectangle.  O(log runs + runs in its rows).
Mask intersect(const Mask& mask, const Rect& rect);

/// The pixels whose centre lies inside the closed polygon, by the nonzero-winding rule, exactly.
///
/// Vertices are first rounded to 2⁻¹⁶ px; from there on the decision is exact integer arithmetic.  A centre that lies
/// on an edge belongs to the pixel set when the inside is to its right (or, on a horizontal edge, below): polygons that
/// share an edge share no pixel and leave none out.  contains() of curve.h decides by the same rule.
///
/// @param polygon  |coordinates| < kMaskCoordinateLimit (CHECK); see check_closed_curve().  Need not be simple.
/// @param clip     pixels outside are left out; also bounds the work.
/// @cost O(edges + rows crossed + runs log runs).
Mask rasterize_polygon(const Points& polygon, const Rect& clip);

/// Largest |coordinate| that rasterize_polygon takes, px.
inline constexpr double kMaskCoordinateLimit = 1 << 20;

} // namespace oversketch
