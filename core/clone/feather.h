#pragma once

#include "core/clone/pixel_graph.h"

#include <vector>

namespace oversketch {

/// Squared distance from each pixel's centre to the nearest centre of a pixel outside the mask, px², ≥ 1; exact, by
/// pixel number (Felzenszwalb and Huttenlocher 2012, on the mask's runs).
/// @cost O(pixels).
std::vector<double> squared_depths(const PixelGraph& graph);

/// How far inside each pixel is, 0…1: t²(3 − 2t) with t = min(1, depth / (feather_px + 1)).  All 1 at feather_px = 0.
std::vector<double> inside_weights(const PixelGraph& graph, double feather_px);

} // namespace oversketch
