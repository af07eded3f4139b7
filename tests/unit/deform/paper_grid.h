#pragma once

#include "core/mesh/quad_mesh.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace oversketch::paper_test {

struct GridMesh {
  QuadMesh mesh;
  std::vector<int> loop;
};

/// The cells (x, y) of a width × height grid that `keep` takes, with their boundary; they must form one disc.
inline GridMesh make_grid(int width, int height, const std::function<bool(int, int)>& keep, double cell = 10,
                          Point origin = {}) {
  GridMesh out;
  out.mesh.cell = cell;
  std::map<std::pair<int, int>, int> ids;
  const auto vertex = [&](int x, int y) {
    const auto [at, fresh] = ids.emplace(std::pair(x, y), static_cast<int>(ids.size()));
    if (fresh) out.mesh.vertices.push_back(origin + Point{x * cell, y * cell});
    return at->second;
  };
  const auto kept = [&](int x, int y) { return x >= 0 && y >= 0 && x < width && y < height && keep(x, y); };
  std::map<int, int> next;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!kept(x, y)) continue;
      const std::array<int, 4> c{vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)};
      out.mesh.cells.push_back(c);
      out.mesh.coverage.push_back(1);
      if (!kept(x, y - 1)) next[c[0]] = c[1];
      if (!kept(x + 1, y)) next[c[1]] = c[2];
      if (!kept(x, y + 1)) next[c[2]] = c[3];
      if (!kept(x - 1, y)) next[c[3]] = c[0];
    }
  }
  const int first = next.begin()->first;
  for (int i = first; out.loop.empty() || i != first; i = next.at(i))
    out.loop.push_back(i);
  return out;
}

/// 6 × 5 cells without a corner: every kind of vertex with δ ≠ 0.
inline GridMesh make_bitten_grid(double cell = 10, Point origin = {}) {
  return make_grid(
      6, 5, [](int x, int y) { return x < 4 || y > 1; }, cell, origin);
}

} // namespace oversketch::paper_test
