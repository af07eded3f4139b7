#pragma once

#include "core/image/raster.h"

#include <array>
#include <utility>

namespace oversketch {

/// The eight neighbours of a pixel in the order in which they are asked: straight ones first.
inline constexpr std::array<std::pair<int, int>, 8> kSteps = {
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

/// For every pixel the index (y · width + x) of a covered pixel near it: itself when it is covered (not 0), else one
/// reached in the fewest steps to neighbours, straight ones first.  All −1 when no pixel is covered.
/// @cost O(pixels), about 30 ns each that is not covered.
Raster<int> find_nearest_covered(const Raster<char>& covered);

} // namespace oversketch
