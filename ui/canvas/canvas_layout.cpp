#include "ui/canvas/canvas_layout.h"

#include <algorithm>
#include <cmath>

namespace oversketch {

bool contains(const Box& box, Point p) {
  return p.x >= box.low.x && p.y >= box.low.y && p.x < box.high.x && p.y < box.high.y;
}

const Box* CanvasLayout::box(Side side) const {
  if (side == Side::kTarget) return &target;
  return source ? &*source : nullptr;
}

std::optional<Side> CanvasLayout::side_at(Point window) const {
  if (source && contains(*source, window)) return Side::kSource;
  if (contains(target, window)) return Side::kTarget;
  return std::nullopt;
}

double CanvasLayout::split_at(double window_x) const {
  const double left = source ? source->low.x : target.low.x;
  return std::clamp((window_x - left) / (target.high.x - left), kLeastSplit, 1 - kLeastSplit);
}

CanvasLayout lay_out_canvases(const Box& area, double split, bool two, double splitter_px) {
  CanvasLayout layout;
  const Point size{std::max(1.0, area.size().x), std::max(1.0, area.size().y)};
  layout.target = {area.low, area.low + size};
  if (!two || size.x < splitter_px + 2) return layout;
  const double share = std::clamp(split, kLeastSplit, 1 - kLeastSplit);
  const double middle =
      area.low.x + std::clamp(std::round(share * size.x), 1 + splitter_px / 2, size.x - 1 - splitter_px / 2);
  const double left = std::floor(middle - splitter_px / 2), right = std::ceil(left + splitter_px);
  layout.source = Box{area.low, {left, area.low.y + size.y}};
  layout.splitter = Box{{left, area.low.y}, {right, area.low.y + size.y}};
  layout.target.low.x = right;
  layout.target.high.x = std::max(layout.target.high.x, right + 1);
  return layout;
}

} // namespace oversketch
