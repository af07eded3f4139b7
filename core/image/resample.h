#pragma once

#include "core/image/image.h"

namespace oversketch {

/// A smaller picture; each new pixel is the mean of the area it covers, parts of pixels by the part that is covered.
///
/// Colour is averaged with its alpha as weight (premultiplied), so that transparent pixels leave no fringe, and given
/// back straight; where nothing is visible it is transparent black.  The mean is taken of the encoded values, as
/// thumbnails are made everywhere, not of linear light.  The same size gives the same picture, bit for bit.
///
/// @param width,height  1 … the picture's own (CHECK).
/// @cost O(pixels of `image`), about 7 ns each.
Image downscaled(const Image& image, int width, int height);

} // namespace oversketch
