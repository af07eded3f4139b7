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

/// How much stronger the target must be to win over the source in mixed gradients: t² − s² > √(kTie (t² + s²)), t and s
/// the norms.  Differences of 8-bit pictures often tie; their float values then differ by rounding, which must not
/// decide.  10⁻¹¹ is above that (up to 10⁻¹³; 5·10⁻¹² in the log domain), and below the next difference of 8 bits.
inline constexpr double kTie = 1e-11;

/// Mixed: each pair of neighbours p, q with at least one in the mask follows the target where
/// ‖f*_p − f*_q‖ > ‖g_p − g_q‖ over the channels (by more than a tie, see kTie), else the source:
/// b_p = Σ_{q ∉ Ω} d_q + Σ_{q where the target is stronger} (d_p − d_q).
std::vector<Channels> mixed_side(const PlacedPair& pair, const PixelGraph& graph);

} // namespace oversketch
