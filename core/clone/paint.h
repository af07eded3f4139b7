#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/pixel_graph.h"
#include "core/clone/placed_pair.h"

#include <span>

namespace oversketch {

/// What is painted: the pair, and the correction u by pixel number (empty: u = 0).
struct Painting {
  const PlacedPair& pair;
  const PixelGraph& graph;
  const BlendOptions& options;
  std::span<const Channels> correction;
};

/// Box round the pixels of the target under the mask shifted by (dx, dy); all zero when there are none.
Rect painted_rect(const Raster<Rgba>& target, const Mask& mask, int dx, int dy);

/// Writes the blended pixels (see clone_into) into the target: all of them, or none after an error.
/// @param target  the one that the pair reads.
/// @returns the largest |red, green or blue| written.
/// @errors clone.not-finite (a result past the largest float), cancelled.
Result<double> paint(Raster<Rgba>& target, const Painting& painting, int dx, int dy, const Watch& watch);

} // namespace oversketch
