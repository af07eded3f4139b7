#pragma once

#include "core/clone/multigrid.h"
#include "core/clone/placed_pair.h"
#include "core/geometry/mask.h"

#include <cstddef>
#include <functional>

namespace oversketch {

/// Reads a stretch of pixels: red, green, blue of the source, then of the target, as they are blended, into six planes
/// `stride` floats apart.
using ReadPixels = std::function<void(const Mask::Run& stretch, float* planes, std::size_t stride)>;

/// Of a placed pair, which must outlive it.
ReadPixels read_pair(const PlacedPair& pair);

/// mixed_side (guidance.h), in float, straight into the grids of a solve.
/// @param read  of stretches of the mask grown by a pixel; of corners that touch no side of it any values will do.
///   Called by all threads.
/// @param solve  on the mask.
/// @param threads  that work; the same bits with any number.
/// @returns false where a pixel of either picture, in the mask or on its ring, is not finite.
/// @cost 5 ns a pixel, and reading each.
bool set_mixed_side(const ReadPixels& read, const Mask& mask, MultigridSolve& solve, int threads = 1);

} // namespace oversketch
