#pragma once

#include "core/clone/live_pixel.h"
#include "core/image/display.h"

namespace oversketch::cli {

/// What a move cannot go without, on a run of pixels: source and picture read, picture written.  As fast as it can be:
/// what it is held against is optimized, too.
void mix_pixels(const LivePixel* source, const Rgba8* below, int count, Rgba8* out);

} // namespace oversketch::cli
