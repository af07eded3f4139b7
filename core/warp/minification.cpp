#include "core/warp/minification.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// Sums of forward Jacobians at a vertex, by orientation: the target's way for a source pixel to the right, and
/// downwards.
struct Sum {
  int count = 0;
  Point along_x, along_y;
};
struct Sums {
  Sum upright, turned_over;
};

void add_corner(Sums& sums, Point source_1, Point source_2, Point target_1, Point target_2) {
  const double area = cross(source_1, source_2), deformed = cross(target_1, target_2);
  if (area == 0 || deformed == 0) return;
  Sum& sum = (area > 0) == (deformed > 0) ? sums.upright : sums.turned_over;
  ++sum.count;
  sum.along_x += (source_2.y * target_1 - source_1.y * target_2) / area;
  sum.along_y += (source_1.x * target_2 - source_2.x * target_1) / area;
}

Minification::Vertex vertex_of(const Sums& sums, int top) {
  const Sum& sum = sums.upright.count >= sums.turned_over.count ? sums.upright : sums.turned_over;
  if (sum.count == 0) return {};
  const Point x = sum.along_x / sum.count, y = sum.along_y / sum.count;
  const double det = cross(x, y), squares = dot(x, x) + dot(y, y);
  const double larger = std::sqrt(0.5 * (squares + std::sqrt(std::max(0.0, squares * squares - 4 * det * det))));
  Minification::Vertex vertex{std::min(minification_stage(larger / std::abs(det)), top + 1.0),
                              Point{y.y, -x.y} / (4 * det), Point{-y.x, x.x} / (4 * det)};
  // No farther than the whole picture; what is as good as flat may be anything.
  const double far = std::ldexp(1.0, top);
  for (Point* way : {&vertex.along_x, &vertex.along_y})
    *way = is_finite(*way) ? Point{std::clamp(way->x, -far, far), std::clamp(way->y, -far, far)} : Point{};
  return vertex;
}

} // namespace

double minification_stage(double sigma) {
  if (!(sigma > 1.5)) return 0;
  if (!std::isfinite(sigma)) return HUGE_VAL;
  if (sigma < 2) return std::min(1.0, (sigma - 1.5) / 0.25);
  const int level = std::ilogb(sigma);
  return level + std::min(1.0, (std::ldexp(sigma, -level) - 1) / 0.25);
}

Minification::Minification(const QuadMesh& mesh, const Points& deformed, int top) : mesh_(mesh) {
  std::vector<Sums> sums(mesh.vertices.size());
  for (const auto& cell : mesh.cells)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto at = static_cast<std::size_t>(cell[k]), after = static_cast<std::size_t>(cell[(k + 1) % 4]),
                 before = static_cast<std::size_t>(cell[(k + 3) % 4]);
      add_corner(sums[at], mesh.vertices[after] - mesh.vertices[at], mesh.vertices[before] - mesh.vertices[at],
                 deformed[after] - deformed[at], deformed[before] - deformed[at]);
    }
  vertices_.reserve(sums.size());
  for (const Sums& sum : sums)
    vertices_.push_back(vertex_of(sum, top));
  shrinks_ = std::ranges::any_of(vertices_, [](const Vertex& vertex) { return vertex.stage > 0; });
  touched_.reserve(mesh.cells.size());
  for (const auto& cell : mesh.cells)
    touched_.push_back(
        std::ranges::any_of(cell, [&](int vertex) { return vertices_[static_cast<std::size_t>(vertex)].stage > 0; }));
}

std::array<Minification::Vertex, 4> Minification::corners(int cell) const {
  std::array<Vertex, 4> out;
  for (std::size_t k = 0; k < 4; ++k)
    out[k] = vertices_[static_cast<std::size_t>(mesh_.cells[static_cast<std::size_t>(cell)][k])];
  return out;
}

} // namespace oversketch
