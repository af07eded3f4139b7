#include "app/gui/cursor_images.h"

#include "core/geometry/point.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oversketch::gui {
namespace {

struct Segment {
  Point a, b;
};

double distance(Point p, const Segment& s) {
  const Point along = s.b - s.a, to = p - s.a;
  const double t = std::clamp((to.x * along.x + to.y * along.y) / (along.x * along.x + along.y * along.y), 0.0, 1.0);
  return std::hypot(to.x - t * along.x, to.y - t * along.y);
}

/// A shaft from the middle with a head at its end, in a square from −1 to 1.
void add_arrow(std::vector<Segment>& segments, Point direction) {
  const Point across = {-direction.y, direction.x}, tip = 0.85 * direction, neck = 0.5 * direction;
  segments.push_back({{0, 0}, tip});
  segments.push_back({tip, neck + 0.3 * across});
  segments.push_back({tip, neck - 0.3 * across});
}

std::vector<Segment> list_segments(CursorShape shape) {
  std::vector<Segment> segments;
  const double d = std::sqrt(0.5);
  std::vector<Point> directions = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  if (shape == CursorShape::kResizeNwse) directions = {{d, d}, {-d, -d}};
  if (shape == CursorShape::kResizeNesw) directions = {{d, -d}, {-d, d}};
  for (const Point direction : directions)
    add_arrow(segments, direction);
  return segments;
}

unsigned char to_byte(double share) {
  return static_cast<unsigned char>(255 * std::clamp(share, 0.0, 1.0) + 0.5);
}

} // namespace

CursorImage draw_cursor(CursorShape shape, float scale) {
  CursorImage image;
  image.side = 2 * static_cast<int>(std::lround(11 * scale)) + 1;
  const double half = 0.5 * image.side;
  const auto segments = list_segments(shape);
  for (int y = 0; y < image.side; ++y) {
    for (int x = 0; x < image.side; ++x) {
      const Point p = {(x + 0.5 - half) / half, (y + 0.5 - half) / half};
      double nearest = 2;
      for (const Segment& segment : segments)
        nearest = std::min(nearest, distance(p, segment));
      const double px = nearest * half / scale;
      const unsigned char light = to_byte(1.4 - px), opacity = to_byte(2.6 - px);
      image.rgba.insert(image.rgba.end(), {light, light, light, opacity});
    }
  }
  return image;
}

} // namespace oversketch::gui
