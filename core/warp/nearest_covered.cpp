#include "core/warp/nearest_covered.h"

#include <algorithm>
#include <vector>

namespace oversketch {

Raster<int> find_nearest_covered(const Raster<char>& covered) {
  constexpr int kNone = -1;
  const int width = covered.width(), height = covered.height();
  Raster<int> nearest(width, height, kNone);
  const auto index = [width](int x, int y) { return y * width + x; };
  const auto has_open_neighbour = [&](int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
        if (covered.at(u, v) == 0) return true;
    return false;
  };
  std::vector<int> front;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (covered.at(x, y) == 0) continue;
      nearest.at(x, y) = index(x, y);
      if (has_open_neighbour(x, y)) front.push_back(index(x, y));
    }
  std::vector<int> next;
  while (!front.empty()) {
    next.clear();
    for (const auto& [dx, dy] : kSteps)
      for (const int from : front) {
        const int x = from % width + dx, y = from / width + dy;
        if (!covered.rect().contains(x, y) || nearest.at(x, y) != kNone) continue;
        nearest.at(x, y) = nearest.at(from % width, from / width);
        next.push_back(index(x, y));
      }
    front.swap(next);
  }
  return nearest;
}

} // namespace oversketch
