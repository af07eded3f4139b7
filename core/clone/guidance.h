#pragma once

#include "core/clone/channels.h"
#include "core/clone/pixel_graph.h"
#include "core/clone/placed_pair.h"

#include <vector>

namespace oversketch {

/// Right-hand sides of A u = b, A the 5-point Laplacian of the mask, u = f − g the correction of the source; by pixel
/// number.  d = f* − g below.

/// d at the outer pixel of each of the graph's ring edges.
std::vector<Channels> ring_differences(const PlacedPair& pair, const PixelGraph& graph);

/// Import: u harmonic, u = d on the ring:  b_p = Σ_{q ∉ Ω} d_q over the neighbours q of p.  Only the ring is read.
std::vector<Channels> membrane_side(const PlacedPair& pair, const PixelGraph& graph);

/// Mixed: each pair of neighbours p, q with at least one in the mask follows the target where
/// ‖f*_p − f*_q‖ > ‖g_p − g_q‖ over the channels, else the source (ties too):
/// b_p = Σ_{q ∉ Ω} d_q + Σ_{q where the target is stronger} (d_p − d_q).
std::vector<Channels> mixed_side(const PlacedPair& pair, const PixelGraph& graph);

} // namespace oversketch
