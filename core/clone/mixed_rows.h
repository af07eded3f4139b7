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

/// mixed_side (guidance.h), in float, straight into the grids of a solve, while that solves next: clone.not-finite
/// there where a pixel of either picture, in the mask or on its ring, is not finite.
/// @param read  of stretches of the mask grown by a pixel; of corners that touch no side of it any values will do.
///   Called by all threads.  What it reads, and the mask, must last until solved.
/// @param solve  on the mask; stays where it is until solved.
/// @cost 4 ns a pixel, and reading each.
void set_mixed_side(const ReadPixels& read, const Mask& mask, MultigridSolve& solve);

} // namespace oversketch
