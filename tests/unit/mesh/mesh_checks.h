#pragma once

#include "core/mesh/region_mesh.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace oversketch {

using Edge = std::pair<int, int>;

/// How often each edge is run through, in the direction from the smaller vertex minus the other one; zeros left out.
using EdgeChain = std::map<Edge, int>;

inline void run_through(EdgeChain& chain, int from, int to) {
  const auto at = chain.try_emplace(Edge{std::min(from, to), std::max(from, to)}, 0).first;
  at->second += from < to ? 1 : -1;
  if (at->second == 0) chain.erase(at);
}

inline std::set<Edge> edges_of(const QuadMesh& mesh) {
  std::set<Edge> edges;
  for (const auto& cell : mesh.cells)
    for (int k = 0; k < 4; ++k)
      edges.insert({std::min(cell[k], cell[(k + 1) & 3]), std::max(cell[k], cell[(k + 1) & 3])});
  return edges;
}

inline bool is_connected(const QuadMesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  int parts = static_cast<int>(parent.size());
  for (const auto& [a, b] : edges_of(mesh)) {
    const int i = find(a), j = find(b);
    if (i == j) continue;
    parent[i] = j;
    --parts;
  }
  return parts == 1;
}

/// Whole squares, connected, of Euler characteristic 1, with the given loop as its boundary.
inline void expect_disc(const QuadMesh& mesh, const std::vector<int>& boundary) {
  ASSERT_EQ(mesh.coverage.size(), mesh.cells.size());
  const std::set<Edge> edges = edges_of(mesh);
  EXPECT_EQ(
      static_cast<int>(mesh.vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(mesh.cells.size()), 1);
  EXPECT_TRUE(is_connected(mesh));
  EdgeChain of_cells, of_loop;
  for (const auto& cell : mesh.cells) {
    const Point low = mesh.vertices[cell[0]];
    const double tiny = 1e-12 * (1 + std::abs(low.x) + std::abs(low.y));
    for (int k = 0; k < 4; ++k) {
      run_through(of_cells, cell[k], cell[(k + 1) & 3]);
      const Point corner = mesh.vertices[cell[k]] - low;
      ASSERT_NEAR(corner.x, k == 1 || k == 2 ? mesh.cell : 0, tiny);
      ASSERT_NEAR(corner.y, k >= 2 ? mesh.cell : 0, tiny);
    }
  }
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const int a = boundary[i], b = boundary[i + 1 == boundary.size() ? 0 : i + 1];
    ASSERT_TRUE(edges.contains({std::min(a, b), std::max(a, b)})) << "boundary step " << i << " is no edge";
    run_through(of_loop, a, b);
  }
  EXPECT_EQ(of_cells, of_loop);
}

/// Area of the part of a polygon within a square, by cutting it at one side after the other (Sutherland and Hodgman).
inline double area_within(Points polygon, Point low, Point high) {
  const auto cut = [&](auto inside, auto meet) {
    Points kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point a = polygon[i], b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      if (inside(a)) kept.push_back(a);
      if (inside(a) != inside(b)) kept.push_back(meet(a, b));
    }
    polygon = std::move(kept);
  };
  const auto at_x = [](double x) { return [x](Point a, Point b) { return lerp(a, b, (x - a.x) / (b.x - a.x)); }; };
  const auto at_y = [](double y) { return [y](Point a, Point b) { return lerp(a, b, (y - a.y) / (b.y - a.y)); }; };
  cut([&](Point p) { return p.x >= low.x; }, at_x(low.x));
  cut([&](Point p) { return p.x <= high.x; }, at_x(high.x));
  cut([&](Point p) { return p.y >= low.y; }, at_y(low.y));
  cut([&](Point p) { return p.y <= high.y; }, at_y(high.y));
  double area = 0;
  const Point centre = 0.5 * (low + high);
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += 0.5 * cross(polygon[i] - centre, polygon[i + 1 == polygon.size() ? 0 : i + 1] - centre);
  return area;
}

} // namespace oversketch
