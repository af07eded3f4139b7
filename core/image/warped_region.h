#pragma once

#include "core/base/rect.h"
#include "core/image/image.h"
#include "core/image/raster.h"

namespace oversketch {

/// Pixels that stand at a place of their own: pixels.at(0, 0) is pixel (rect.x, rect.y).  What the warp makes and the
/// blending takes.  Alpha 0 where there is nothing.
struct WarpedRegion {
  /// Same size as `pixels`.
  Rect rect;
  Raster<Rgba> pixels;
};

} // namespace oversketch
