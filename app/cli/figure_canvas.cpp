#include "app/cli/figure_canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oversketch::cli {
namespace {

constexpr int kLinesPerPixel = 16;

/// Where a sampling line meets an edge, and which way the edge goes there.
struct LineCrossing {
  float x = 0;
  int turn = 0;
};

/// The crossings of rings with the sampling lines of some rows, sorted by line and by x.
class Crossings {
public:
  Crossings(std::span<const Points> rings, int first_row, int last_row) : top_(first_row * kLinesPerPixel) {
    const auto lines = static_cast<std::size_t>(std::max(0, last_row - first_row) * kLinesPerPixel);
    start_.assign(lines + 1, 0);
    for_each(rings, [&](std::size_t line, float, int) { ++start_[line + 1]; });
    for (std::size_t i = 0; i < lines; ++i)
      start_[i + 1] += start_[i];
    crossings_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for_each(rings, [&](std::size_t line, float x, int turn) { crossings_[next[line]++] = {x, turn}; });
    for (std::size_t i = 0; i < lines; ++i)
      std::sort(crossings_.begin() + start_[i], crossings_.begin() + start_[i + 1],
                [](const LineCrossing& a, const LineCrossing& b) { return a.x < b.x; });
  }

  std::span<const LineCrossing> line(int row, int k) const {
    const auto i = static_cast<std::size_t>(row * kLinesPerPixel + k - top_);
    return std::span(crossings_).subspan(start_[i], start_[i + 1] - start_[i]);
  }

private:
  template <class Visit>
  void for_each(std::span<const Points> rings, const Visit& visit) const {
    const auto lines = static_cast<int>(start_.size()) - 1;
    for (const Points& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        Point a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
        const int turn = a.y < b.y ? 1 : -1;
        if (turn < 0) std::swap(a, b);
        // Line l runs at y = (l + ½) / kLinesPerPixel; it meets edges half open, a.y ≤ y < b.y.
        const auto line_at = [&](double y) {
          return std::clamp(std::ceil(y * kLinesPerPixel - 0.5) - top_, 0.0, static_cast<double>(lines));
        };
        const int first = static_cast<int>(line_at(a.y)), last = static_cast<int>(line_at(b.y));
        const double slope = first < last ? (b.x - a.x) / (b.y - a.y) : 0;
        for (int l = first; l < last; ++l) {
          const double y = (l + top_ + 0.5) / kLinesPerPixel;
          visit(static_cast<std::size_t>(l), static_cast<float>(a.x + slope * (y - a.y)), turn);
        }
      }
  }

  int top_;
  std::vector<std::size_t> start_;
  std::vector<LineCrossing> crossings_;
};

/// Adds the part of each pixel of a row that lies between x0 and x1.
void add_span(std::vector<float>& row, float x0, float x1) {
  x0 = std::max(x0, 0.0f);
  x1 = std::min(x1, static_cast<float>(row.size()));
  if (!(x0 < x1)) return;
  const auto first = static_cast<std::size_t>(x0), last = std::min(static_cast<std::size_t>(x1), row.size() - 1);
  constexpr float kShare = 1.0f / kLinesPerPixel;
  if (first == last) {
    row[first] += kShare * (x1 - x0);
    return;
  }
  row[first] += kShare * (static_cast<float>(first + 1) - x0);
  for (std::size_t x = first + 1; x < last; ++x)
    row[x] += kShare;
  row[last] += kShare * (x1 - static_cast<float>(last));
}

void add_line(std::vector<float>& row, std::span<const LineCrossing> crossings) {
  int winding = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (winding != 0) add_span(row, crossings[i - 1].x, crossings[i].x);
    winding += crossings[i].turn;
  }
}

Points segment_ring(Point a, Point b, double width) {
  const double l = distance(a, b);
  if (!(l > 0)) return {};
  const Point n = (0.5 * width / l) * turned(b - a);
  return {a + n, b + n, b - n, a - n};
}

} // namespace

Rgba color_of(std::uint32_t rgb, double alpha) {
  const auto channel = [&](int shift) { return static_cast<float>((rgb >> shift) & 255u) / 255.0f; };
  return {channel(16), channel(8), channel(0), static_cast<float>(alpha)};
}

Points circle_ring(Point centre, double radius) {
  const int corners = std::max(8, static_cast<int>(std::ceil(8 * std::sqrt(radius))));
  Points ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = -2 * std::numbers::pi * i / corners;
    ring.push_back(centre + radius * Point{std::cos(angle), std::sin(angle)});
  }
  return ring;
}

Canvas::Canvas(int width, int height, Rgba paper) : pixels_(width, height, paper) {}

void Canvas::mix(int x, int y, const Rgba& color, float coverage, Mix mix) {
  Rgba& under = pixels_.at(x, y);
  const float alpha = color.a * std::min(coverage, 1.0f);
  const float kept = mix == Mix::kAtop ? 1 - alpha : under.a * (1 - alpha);
  const float total = mix == Mix::kAtop ? 1 : alpha + kept;
  if (!(total > 0)) return;
  const auto blend = [&](float top, float bottom) { return (top * alpha + bottom * kept) / total; };
  const float left = mix == Mix::kAtop ? under.a : total;
  under = {blend(color.r, under.r), blend(color.g, under.g), blend(color.b, under.b), left};
}

void Canvas::fill(std::span<const Points> rings, Rgba color, Mix how) {
  Box box;
  for (const Points& ring : rings)
    for (const Point p : ring)
      box.add(p);
  if (box.empty()) return;
  const auto row_of = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, static_cast<double>(height()))); };
  const int first = row_of(std::floor(box.low.y)), last = row_of(std::ceil(box.high.y));
  const int left = static_cast<int>(std::clamp(std::floor(box.low.x), 0.0, static_cast<double>(width())));
  const int right = static_cast<int>(std::clamp(std::ceil(box.high.x) + 1, 0.0, static_cast<double>(width())));
  if (first >= last || left >= right) return;
  const Crossings crossings(rings, first, last);
  std::vector<float> row(static_cast<std::size_t>(width()));
  for (int y = first; y < last; ++y) {
    std::fill(row.begin() + left, row.begin() + right, 0.0f);
    for (int k = 0; k < kLinesPerPixel; ++k)
      add_line(row, crossings.line(y, k));
    for (int x = left; x < right; ++x)
      if (row[static_cast<std::size_t>(x)] > 0) mix(x, y, color, row[static_cast<std::size_t>(x)], how);
  }
}

void Canvas::fill(const Points& ring, Rgba color, Mix how) {
  fill(std::span(&ring, 1), color, how);
}

void Canvas::stroke(const Points& line, double width, bool closed, Rgba color, Mix how) {
  std::vector<Points> rings;
  const std::size_t segments = closed ? line.size() : std::max<std::size_t>(line.size(), 1) - 1;
  for (std::size_t i = 0; i < segments; ++i)
    rings.push_back(segment_ring(line[i], line[(i + 1) % line.size()], width));
  for (const Point p : line)
    rings.push_back(circle_ring(p, 0.5 * width));
  fill(rings, color, how);
}

void Canvas::stroke_segments(std::span<const Points> segments, double width, Rgba color, Mix how) {
  std::vector<Points> rings;
  for (const Points& segment : segments)
    for (std::size_t i = 1; i < segment.size(); ++i)
      rings.push_back(segment_ring(segment[i - 1], segment[i], width));
  fill(rings, color, how);
}

void Canvas::disc(Point centre, double radius, Rgba color) {
  fill(circle_ring(centre, radius), color);
}

void Canvas::cross(Point centre, double arm, double width, Rgba color) {
  const std::vector<Points> rings = {segment_ring(centre - Point{arm, 0}, centre + Point{arm, 0}, width),
                                     segment_ring(centre - Point{0, arm}, centre + Point{0, arm}, width)};
  fill(rings, color);
}

void Canvas::arrow(Point tail, Point head, double width, Rgba color) {
  const double l = distance(tail, head);
  if (!(l > 0)) return;
  const double point = std::min(4 * width, l);
  const Point along = (1 / l) * (head - tail), neck = head - point * along, side = 0.45 * point * turned(along);
  const std::vector<Points> rings = {segment_ring(tail, neck, width), {neck + side, head, neck - side}};
  fill(rings, color);
}

void Canvas::rectangle(double x, double y, double width, double height, Rgba color) {
  fill(Points{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, color);
}

void Canvas::draw(const Raster<Rgba>& picture, int x, int y) {
  const Rect shown = intersect(translated(picture.rect(), x, y), pixels_.rect());
  for (int row = shown.y; row < shown.bottom(); ++row)
    for (int column = shown.x; column < shown.right(); ++column)
      mix(column, row, picture.at(column - x, row - y), 1, Mix::kOver);
}

} // namespace oversketch::cli
