#pragma once

#include "core/geometry/mask.h"

#include <cstdint>
#include <vector>

namespace oversketch {

/// The pixels of a mask numbered 0, 1, 2… run by run, and who neighbours whom (left, right, above, below).
///
/// Within a run neighbours are consecutive numbers; vertical neighbours come in stretches; neighbours outside the mask
/// (the ring) are listed one by one.  Memory follows the runs and the perimeter, not the area.
struct PixelGraph {
  /// upper + i lies above lower + i, for 0 ≤ i < length.
  struct Stretch {
    int upper = 0;
    int lower = 0;
    int length = 0;
  };
  /// The mask's pixel number `pixel` has the neighbour (x, y) outside the mask.
  struct RingEdge {
    int pixel = 0;
    int x = 0;
    int y = 0;
  };

  /// At most INT_MAX pixels (CHECK).
  explicit PixelGraph(const Mask& pixels);

  Mask mask;
  int count = 0;
  /// Number of the first pixel of each run of the mask.
  std::vector<int> first;
  /// Ordered by `lower`.
  std::vector<Stretch> stretches;
  std::vector<RingEdge> ring;
};

} // namespace oversketch
