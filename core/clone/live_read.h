#pragma once

#include "core/clone/live_data.h"
#include "core/clone/mixed_rows.h"
#include "core/image/display.h"

namespace oversketch {

/// Reads a live region and the picture under it, shifted by (dx, dy), its edge pixels repeated outside; both must
/// outlive it.  In units of 1 for level 255, or the domain's.
/// @param options  not of mode monochrome.
ReadPixels read_live(const Raster<Rgba8>& below, const LiveRegion::Data& region, int dx, int dy,
                     const BlendOptions& options);

} // namespace oversketch
