#pragma once

#include "core/mesh/region_mesh.h"

#include <vector>

namespace oversketch {

/// Which place of a mesh's boundary loop stands for which place of the region's outline.
///
/// The boundary is a staircase near the outline.  Places on it are counted in vertices: place p lies between
/// boundary()[⌊p⌋] and the next one of the loop; places count on past the loop's end.  The map is the isotonic
/// regression (cyclic, least squares) of the nearest boundary edges of the cell copies that the outline runs through:
/// strictly increasing, and one loop a round, however the outline winds.
/// @threads const.
class BoundaryMap {
public:
  /// @cost O(outline length / cell + vertices).
  explicit BoundaryMap(const RegionMesh& region);

  int loop_size() const { return loop_size_; }
  /// The place that belongs to arc length s of region.outline(); increasing by loop_size() each time round.
  double place_at(double s) const;

private:
  int loop_size_;
  double length_;
  /// Nodes of one round and the first one again; both increasing.
  std::vector<double> s_;
  std::vector<double> places_;
};

} // namespace oversketch
