#pragma once

#include "core/clone/multigrid.h"
#include "core/clone/placed_pair.h"
#include "core/geometry/mask.h"

namespace oversketch {

/// mixed_side (guidance.h), in float, straight into the grids of a solve.
/// @param solve  on the mask.
/// @returns false where a pixel of either picture, in the mask or on its ring, is not finite.
/// @cost 8 ns a pixel where both pictures are opaque and blended as encoded.
bool set_mixed_side(const PlacedPair& pair, const Mask& mask, MultigridSolve& solve);

} // namespace oversketch
