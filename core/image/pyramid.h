#pragma once

#include "core/image/image.h"

#include <memory>

namespace oversketch {

/// A picture and its halvings, for reading it at a smaller scale.
///
/// Level 0 is the picture itself.  Pixel (x, y) of level k + 1 is the mean of the four pixels (2x, 2y)…(2x+1, 2y+1) of
/// level k, colours weighed by alpha and transparent black where nothing is visible; where the size is odd the last
/// column or row is repeated.  A point (x, y) of the picture is (x, y) / 2ᵏ at level k.  The last level is one pixel.
///
/// Making one costs nothing: a level is made when it is first asked for, with those below it, and kept.  All of them
/// hold a third of the picture's memory.  Copies share them.
///
/// @threads safe to read from several threads.
/// @cost about 2 ns a pixel of the level below.
class ImagePyramid {
public:
  /// Not explicit: a picture is a pyramid of which nothing is made yet.
  ImagePyramid(Image image);

  const Image& image() const;
  /// The number of the level of one pixel; 0 for an empty picture.
  int top() const;
  /// 0 … top() (CHECK).
  const Raster<Rgba>& level(int k) const;

private:
  struct Levels;
  std::shared_ptr<Levels> levels_;
};

} // namespace oversketch
