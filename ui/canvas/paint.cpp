#include "ui/canvas/paint.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace oversketch {
namespace {

PackedColor packed(float r, float g, float b, float a = 1) {
  return ImGui::ColorConvertFloat4ToU32({r, g, b, a});
}

/// The part of a segment that can be seen, as parameters.
std::optional<std::pair<float, float>> seen_part(ImVec2 a, ImVec2 b, ImVec2 low, ImVec2 high) {
  float from = 0, to = 1;
  const auto cut = [&](float start, float step, float least, float most) {
    if (step == 0) return start >= least && start <= most;
    const float one = (least - start) / step, two = (most - start) / step;
    from = std::max(from, std::min(one, two));
    to = std::min(to, std::max(one, two));
    return from < to;
  };
  if (!cut(a.x, b.x - a.x, low.x, high.x) || !cut(a.y, b.y - a.y, low.y, high.y)) return std::nullopt;
  return std::pair(from, to);
}

} // namespace

void CanvasPaint::line(std::span<const Point> points, bool closed, PackedColor color, float width) const {
  if (points.size() < 2) return;
  std::vector<ImVec2> path;
  path.reserve(points.size());
  for (const Point p : points)
    path.push_back(at(p));
  list.AddPolyline(path.data(), static_cast<int>(path.size()), color, closed ? static_cast<int>(ImDrawFlags_Closed) : 0,
                   look.px(width));
}

void CanvasPaint::haloed_line(std::span<const Point> points, bool closed, PackedColor color, float width) const {
  line(points, closed, look.curve_halo, width + 2);
  line(points, closed, color, width);
}

void CanvasPaint::dashed_line(std::span<const Point> points, bool closed, PackedColor color, float width,
                              float dash) const {
  const float period = 2 * look.px(dash);
  float walked = 0;
  const std::size_t pieces = points.size() < 2 ? 0 : points.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < pieces; ++i) {
    const ImVec2 a = at(points[i]), b = at(points[(i + 1) % points.size()]);
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const auto seen = seen_part(a, b, corner, end);
    if (seen && length > 0) {
      const auto along = [&](float s) {
        return ImVec2(a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length);
      };
      const float from = seen->first * length, to = seen->second * length;
      for (float s = std::floor((walked + from) / period) * period - walked; s < to; s += period) {
        const float begin = std::max(s, from), stop = std::min(s + period / 2, to);
        if (begin < stop) list.AddLine(along(begin), along(stop), color, look.px(width));
      }
    }
    walked = std::fmod(walked + length, period);
  }
}

void CanvasPaint::dot(Point center, PackedColor color, float radius) const {
  const ImVec2 p = at(center);
  if (!shows(p, look.px(radius + 2))) return;
  list.AddCircleFilled(p, look.px(radius + 1), look.curve_halo);
  list.AddCircleFilled(p, look.px(radius), color);
}

void CanvasPaint::ring(Point center, PackedColor color, float radius, float width) const {
  const ImVec2 p = at(center);
  if (!shows(p, look.px(radius + 3))) return;
  list.AddCircle(p, look.px(radius), look.curve_halo, 0, look.px(width + 2));
  list.AddCircle(p, look.px(radius), color, 0, look.px(width));
}

PackedColor fraction_color(double fraction) {
  float r = 0, g = 0, b = 0;
  ImGui::ColorConvertHSVtoRGB(static_cast<float>(fraction - std::floor(fraction)), 0.75f, 0.95f, r, g, b);
  return packed(r, g, b);
}

PackedColor heat_color(double value) {
  const float v = static_cast<float>(std::clamp(value, 0.0, 1.0));
  float r = 0, g = 0, b = 0;
  ImGui::ColorConvertHSVtoRGB(0.62f * (1 - v), 0.85f, 0.95f, r, g, b);
  return packed(r, g, b);
}

} // namespace oversketch
