#include "core/mesh/grid.h"

#include "core/base/check.h"

namespace oversketch {

namespace {

/// One cell more than fit, so that no side of the box lies on a line: a cell along such a side would hold nothing.
double cells_across(double size, double cell_px) {
  constexpr double kAlmostWhole = 1e-9;
  return std::floor(size / cell_px + kAlmostWhole) + 1;
}

} // namespace

Grid centred_grid(const Box& box, double cell_px) {
  CHECK(!box.empty() && cell_px > 0, "a grid needs a box and a cell");
  const Point size{cells_across(box.size().x, cell_px) * cell_px, cells_across(box.size().y, cell_px) * cell_px};
  return {box.centre() - 0.5 * size, cell_px, 1};
}

} // namespace oversketch
