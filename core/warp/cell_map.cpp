#include "core/warp/cell_map.h"

#include "core/base/check.h"
#include "core/warp/cell_inverse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace oversketch {
namespace {

// 2⁻¹⁰ px: with |coordinates| < 2²⁰ px every product below stays under 2⁶³.
constexpr std::int64_t kOne = 1024;
constexpr std::int64_t kHalf = kOne / 2;

struct FixedPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

FixedPoint to_fixed(Point p) {
  CHECK(std::abs(p.x) < kMaskCoordinateLimit && std::abs(p.y) < kMaskCoordinateLimit, "vertex out of range");
  return {std::llround(p.x * static_cast<double>(kOne)), std::llround(p.y * static_cast<double>(kOne))};
}

std::int64_t divide_up(std::int64_t a, std::int64_t positive) {
  const std::int64_t quotient = a / positive;
  return quotient + (a % positive > 0);
}

/// First pixel (row or column) whose centre is at `fixed` or beyond it.
std::int64_t first_centre(std::int64_t fixed) {
  return divide_up(fixed - kHalf, kOne);
}

/// A side, the upper end first.
struct Side {
  FixedPoint top, bottom;

  bool crosses_row(std::int64_t centre_y) const { return top.y <= centre_y && centre_y < bottom.y; }
  /// First pixel whose centre is on the side or to its right, exactly.
  std::int64_t first_pixel(std::int64_t centre_y) const {
    const std::int64_t height = bottom.y - top.y;
    return divide_up((top.x - kHalf) * height + (centre_y - top.y) * (bottom.x - top.x), kOne * height);
  }
};

class Painter {
public:
  Painter(const QuadMesh& mesh, const Points& deformed, const Rect& rect, const Mask* region)
      : mesh_(mesh), deformed_(deformed), rect_(rect), region_(region), cells_(rect.width, rect.height, kNoCell) {}

  void paint(int cell) {
    std::array<Side, 4> sides;
    std::int64_t low = INT64_MAX, high = INT64_MIN;
    for (std::size_t k = 0; k < 4; ++k) {
      FixedPoint a = vertex(cell, k), b = vertex(cell, (k + 1) % 4);
      if (b.y < a.y) std::swap(a, b);
      sides[k] = {a, b};
      low = std::min(low, a.y), high = std::max(high, b.y);
    }
    const std::int64_t first = std::max<std::int64_t>(first_centre(low), rect_.y);
    const std::int64_t end = std::min<std::int64_t>(first_centre(high), rect_.bottom());
    for (std::int64_t y = first; y < end; ++y)
      paint_row(cell, sides, y);
  }

  Raster<int> take() { return std::move(cells_); }

private:
  FixedPoint vertex(int cell, std::size_t corner) const {
    return to_fixed(deformed_[static_cast<std::size_t>(mesh_.cells[static_cast<std::size_t>(cell)][corner])]);
  }

  void paint_row(int cell, const std::array<Side, 4>& sides, std::int64_t y) {
    std::array<std::int64_t, 4> ends;
    std::size_t count = 0;
    for (const Side& side : sides) {
      if (!side.crosses_row(y * kOne + kHalf)) continue;
      const std::int64_t x = side.first_pixel(y * kOne + kHalf);
      std::size_t at = count++;
      for (; at > 0 && ends[at - 1] > x; --at)
        ends[at] = ends[at - 1];
      ends[at] = x;
    }
    for (std::size_t k = 0; k + 1 < count; k += 2) {
      const auto x0 = static_cast<int>(std::clamp<std::int64_t>(ends[k], rect_.x, rect_.right()));
      const auto x1 = static_cast<int>(std::clamp<std::int64_t>(ends[k + 1], rect_.x, rect_.right()));
      paint_span(cell, static_cast<int>(y), x0, x1);
    }
  }

  void paint_span(int cell, int y, int x0, int x1) {
    for (int x = x0; x < x1; ++x) {
      int& here = cells_.at(x - rect_.x, y - rect_.y);
      if (here == kNoCell || region_ == nullptr || wins(cell, here, {x + 0.5, y + 0.5})) here = cell;
    }
  }

  bool wins(int later, int earlier, Point p) {
    if (in_region(CellInverse(mesh_, deformed_, later)(p))) return true;
    return !in_region(CellInverse(mesh_, deformed_, earlier)(p));
  }

  bool in_region(Point source) const {
    const bool sane = std::abs(source.x) < kMaskCoordinateLimit && std::abs(source.y) < kMaskCoordinateLimit;
    return sane && region_->contains(static_cast<int>(std::floor(source.x)), static_cast<int>(std::floor(source.y)));
  }

  const QuadMesh& mesh_;
  const Points& deformed_;
  const Rect rect_;
  const Mask* region_;
  Raster<int> cells_;
};

} // namespace

Raster<int> map_cells(const QuadMesh& mesh, const Points& deformed, const Rect& rect, const Mask* source_region) {
  Painter painter(mesh, deformed, rect, source_region);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    painter.paint(cell);
  return painter.take();
}

Raster<int> find_nearest_covered(const Raster<int>& cells) {
  const int width = cells.width(), height = cells.height();
  Raster<int> nearest(width, height, kNoCell);
  const auto index = [width](int x, int y) { return y * width + x; };
  const auto has_open_neighbour = [&](int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
        if (cells.at(u, v) == kNoCell) return true;
    return false;
  };
  std::vector<int> front;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (cells.at(x, y) == kNoCell) continue;
      nearest.at(x, y) = index(x, y);
      if (has_open_neighbour(x, y)) front.push_back(index(x, y));
    }
  constexpr std::array<std::pair<int, int>, 8> kSteps = {
      {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  std::vector<int> next;
  while (!front.empty()) {
    next.clear();
    for (const auto& [dx, dy] : kSteps)
      for (const int from : front) {
        const int x = from % width + dx, y = from / width + dy;
        if (!cells.rect().contains(x, y) || nearest.at(x, y) != kNoCell) continue;
        nearest.at(x, y) = nearest.at(from % width, from / width);
        next.push_back(index(x, y));
      }
    front.swap(next);
  }
  return nearest;
}

} // namespace oversketch
