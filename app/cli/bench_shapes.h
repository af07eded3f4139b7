#pragma once

#include "core/geometry/mask.h"
#include "core/image/image.h"

#include <cstdint>

namespace oversketch::cli {

/// A picture with slopes, waves and grain; opaque.  The same for the same seed.
Raster<Rgba> make_picture(int width, int height, std::uint32_t seed);

// Masks of about that many pixels, wholly at positive coordinates.

/// A smooth shape.
Mask make_blob(double pixels);
/// A band, 16 times as long as it is wide, that winds.
Mask make_snake(double pixels);
/// The smooth shape with about 30 round holes.
Mask make_holed(double pixels);

} // namespace oversketch::cli
