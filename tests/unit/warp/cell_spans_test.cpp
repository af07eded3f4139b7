#include "core/warp/cell_spans.h"

#include "core/base/check.h"
#include "core/warp/nearest_covered.h"
#include "tests/unit/warp/warp_support.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

constexpr int kNoCell = -1;

/// Which cell is drawn at each pixel of the rect; also holds the spans to their order.
Raster<int> map_cells(const QuadMesh& mesh, const Points& deformed, const Rect& rect) {
  std::vector<CellInverse> inverses;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    inverses.emplace_back(mesh, deformed, cell);
  const CellRaster raster(mesh, deformed, inverses, rect, nullptr);
  const CellSpans spans = raster.rows(rect.y, rect.bottom());
  Raster<int> cells(rect.width, rect.height, kNoCell);
  for (int y = rect.y; y < rect.bottom(); ++y) {
    int end = rect.x;
    for (const CellSpan& span : spans.row(y)) {
      EXPECT_TRUE(end <= span.x0 && span.x0 < span.x1 && span.x1 <= rect.right());
      end = span.x1;
      for (int x = span.x0; x < span.x1; ++x)
        cells.at(x - rect.x, y - rect.y) = span.cell;
    }
  }
  return cells;
}

/// The mesh with one cell alone.
QuadMesh only(const QuadMesh& mesh, std::size_t cell) {
  QuadMesh out = mesh;
  out.cells = {mesh.cells[cell]};
  return out;
}

TEST(CellSpans, RefusesVerticesOutOfRange) {
  const QuadMesh mesh = grid_mesh({0, 0}, 10, 1, 1);
  Points far = mesh.vertices;
  far[0].x = -kMaskCoordinateLimit;
  EXPECT_THROW((void)map_cells(mesh, far, {0, 0, 4, 4}), BugError);
  EXPECT_TRUE(map_cells(mesh, mesh.vertices, {0, 0, 0, 0}).empty());
}

TEST(CellSpans, CellsPartThePixelsInAnyMesh) {
  // Each cell painted alone: together every pixel inside is painted exactly once, and the boundary's shape does not
  // matter.
  std::mt19937 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const QuadMesh mesh = grid_mesh({5, 5}, 6, 8, 8);
    Points deformed = mesh.vertices;
    // Half of the trials on whole and half pixels, where every tie comes up; inner vertices only.
    std::uniform_real_distribution<double> step(-2.0, 2.0);
    for (int y = 1; y < 8; ++y)
      for (int x = 1; x < 8; ++x) {
        Point& p = deformed[static_cast<std::size_t>(y * 9 + x)];
        p += {step(random), step(random)};
        if (trial % 2) p = {std::round(2 * p.x) / 2, std::round(2 * p.y) / 2};
      }
    const double angle = trial < 20 ? 0 : 0.1 * trial;
    for (Point& p : deformed)
      p = Similarity{std::polar(1.0, angle), {40, 10}}(p);
    const Rect rect{-60, -60, 200, 200};
    Raster<int> times(rect.width, rect.height, 0);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
      const Raster<int> map = map_cells(only(mesh, cell), deformed, rect);
      for (std::size_t i = 0; i < map.values().size(); ++i)
        times.values()[i] += map.values()[i] != kNoCell;
    }
    const Points outer = {deformed[0], deformed[8], deformed[80], deformed[72]};
    for (int y = 0; y < rect.height; ++y)
      for (int x = 0; x < rect.width; ++x) {
        const Point p{rect.x + x + 0.5, rect.y + y + 0.5};
        // Signed distance from the outer square; only a centre right on it is left to the rounding.
        double inside = HUGE_VAL;
        for (std::size_t k = 0; k < 4; ++k) {
          const Point a = outer[k], b = outer[(k + 1) % 4];
          inside = std::min(inside, cross(b - a, p - a) / distance(a, b));
        }
        ASSERT_LE(times.at(x, y), 1) << trial;
        if (std::abs(inside) > 0.002) {
          ASSERT_EQ(times.at(x, y), inside > 0 ? 1 : 0) << trial;
        }
      }
  }
}

TEST(CellSpans, AnEdgeBelongsToTheRightAndBelow) {
  const QuadMesh mesh = grid_mesh({0.5, 0.5}, 3, 1, 1);
  const Raster<int> map = map_cells(mesh, mesh.vertices, {-2, -2, 10, 10});
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x)
      EXPECT_EQ(map.at(x, y), x >= 2 && x < 5 && y >= 2 && y < 5 ? 0 : kNoCell) << x << "," << y;
}

TEST(CellSpans, AgreesWithThePolygonMaskOfEachCell) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(0, 30);
  const QuadMesh mesh = grid_mesh({0, 0}, 10, 1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const Point a{place(random), place(random)};
    const Similarity map{std::polar(0.3 + trial * 0.005, 0.1 * trial), to_complex(a)};
    const Points deformed = transformed(mesh.vertices, map);
    Points quad;
    for (const int k : mesh.cells[0]) {
      const Point p = deformed[static_cast<std::size_t>(k)];
      quad.push_back({std::round(p.x * 1024) / 1024, std::round(p.y * 1024) / 1024});
    }
    const Rect rect{-40, -40, 120, 120};
    const Mask expected = rasterize_polygon(quad, rect);
    const Raster<int> got = map_cells(mesh, deformed, rect);
    for (int y = 0; y < rect.height; ++y)
      for (int x = 0; x < rect.width; ++x)
        ASSERT_EQ(got.at(x, y) == 0, expected.contains(rect.x + x, rect.y + y)) << trial << ": " << x << "," << y;
  }
}

TEST(FindNearestCovered, FewestStepsAndStraightOnesFirst) {
  Raster<char> cells(9, 7, 0);
  const Raster<int> none = find_nearest_covered(cells);
  for (const int i : none.values())
    EXPECT_EQ(i, -1);
  cells.at(1, 1) = 1;
  cells.at(7, 5) = 1;
  const Raster<int> nearest = find_nearest_covered(cells);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x) {
      const int to_first = std::max(std::abs(x - 1), std::abs(y - 1)),
                to_second = std::max(std::abs(x - 7), std::abs(y - 5));
      if (to_first != to_second) {
        EXPECT_EQ(nearest.at(x, y), to_first < to_second ? 10 : 52) << x << "," << y;
      }
    }
}

} // namespace
} // namespace oversketch
