#include "ui/canvas/view.h"

#include "core/base/check.h"

#include <algorithm>

namespace oversketch {

View panned(const View& view, Point by) {
  return {view.origin - by / view.zoom, view.zoom};
}

View zoomed(const View& view, Point fixed, double factor) {
  const double zoom = std::clamp(view.zoom * factor, kLeastZoom, kMostZoom);
  return {view.to_picture(fixed) - fixed / zoom, zoom};
}

View fitted(Point picture, Point canvas, double margin) {
  CHECK(picture.x > 0 && picture.y > 0 && canvas.x > 0 && canvas.y > 0, "sizes must be positive");
  // A canvas smaller than its margins still shows something.
  const Point room = {std::max(canvas.x - 2 * margin, 1.0), std::max(canvas.y - 2 * margin, 1.0)};
  const double zoom = std::clamp(std::min(room.x / picture.x, room.y / picture.y), kLeastZoom, kMostFit);
  return {0.5 * picture - canvas / (2 * zoom), zoom};
}

} // namespace oversketch
