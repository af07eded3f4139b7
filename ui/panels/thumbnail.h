#pragma once

#include "core/image/display.h"

#include <memory>

namespace oversketch {

/// A small copy of a picture: each pixel the mean of some samples of what it covers.  For pictures of any size at the
/// same cost: sixteen samples a pixel of the small one.
/// @param most_px  of its longer side; the copy is never larger than the picture.
std::shared_ptr<const Raster<Rgba8>> make_thumbnail(const Raster<Rgba8>& picture, int most_px);

} // namespace oversketch
