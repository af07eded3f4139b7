#pragma once

#include "core/geometry/point.h"

namespace oversketch {

/// How a canvas shows a picture: `zoom` screen pixels per picture pixel, `origin` the picture's place at the canvas's
/// top left corner.  A value; moving it about changes nothing else.
struct View {
  Point origin;
  double zoom = 1;

  bool operator==(const View&) const = default;
  Point to_canvas(Point picture) const { return zoom * (picture - origin); }
  Point to_picture(Point canvas) const { return origin + canvas / zoom; }
};

/// Least and greatest zoom: a picture of 65,535 px still fits a small window, and a pixel becomes a hand's breadth.
inline constexpr double kLeastZoom = 1.0 / 512, kMostZoom = 256;

/// The view moved so that what lay under the pointer goes along with it.
/// @param by  canvas pixels.
View panned(const View& view, Point by);

/// The view zoomed so that what lies under `fixed` stays there; the zoom is kept within its limits.
/// @param fixed  canvas pixels.
View zoomed(const View& view, Point fixed, double factor);

/// Small pictures are fitted no larger than this.
inline constexpr double kMostFit = 4;

/// The whole picture in the middle of the canvas, with a margin.
/// @param picture, canvas  sizes in pixels; positive.
View fitted(Point picture, Point canvas, double margin = 16);

} // namespace oversketch
