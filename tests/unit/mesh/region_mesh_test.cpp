#include "core/mesh/region_mesh.h"

#include "core/mesh/cell_copies.h"

#include "mesh_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace oversketch {
namespace {

using shapes::Case;

RegionMesh make(const Points& outline, double cell, MeshKind kind = MeshKind::kCovering) {
  auto made = make_region_mesh(ClosedCurve(outline), cell, kind);
  if (!made) throw std::runtime_error(to_string(made.error()));
  return std::move(*made);
}

std::string code_of(const Points& outline, double cell, const Watch& watch = {}) {
  const auto made = make_region_mesh(ClosedCurve(outline), cell, MeshKind::kCovering, watch);
  return made ? "" : made.error().code;
}

/// The first place at which the segment from p to q meets the outline, by trying every segment.
struct Meeting {
  double part = 2;
  double s = 0;
};

Meeting first_meeting(const ClosedCurve& outline, Point p, Point q) {
  Meeting first;
  const Points& points = outline.points();
  for (int i = 0; i < outline.size(); ++i) {
    const Point a = points[i], b = points[i + 1 == outline.size() ? 0 : i + 1];
    const double across = cross(q - p, b - a);
    if (across == 0) continue;
    const double part = cross(a - p, b - a) / across, along = cross(a - p, q - p) / across;
    if (part < 0 || part > 1 || along < 0 || along > 1 || part >= first.part) continue;
    first = {part, outline.s_at(i) + along * distance(a, b)};
  }
  return first;
}

bool in_unit(const CellPoint& at, double tiny = 1e-9) {
  return at.u >= -tiny && at.u <= 1 + tiny && at.v >= -tiny && at.v <= 1 + tiny;
}

class RegionMeshTest : public testing::TestWithParam<Case> {
protected:
  double size() const { return bounds(GetParam().outline).diagonal(); }
  /// Rounding of coordinates, px.
  double tiny() const { return 1e-9 * std::max(1.0, 1e-5 * std::abs(GetParam().outline[0].x)); }
};

TEST(RegionMesh, RefusesWhatItCannotMesh) {
  const Points square{{0, 0}, {100, 0}, {100, 50}, {0, 50}};
  EXPECT_EQ(code_of(square, 0), "mesh.cell");
  EXPECT_EQ(code_of(square, -1), "mesh.cell");
  EXPECT_EQ(code_of(square, std::numeric_limits<double>::quiet_NaN()), "mesh.cell");
  EXPECT_EQ(code_of(square, std::numeric_limits<double>::infinity()), "mesh.cell");
  EXPECT_EQ(code_of(square, 100.001), "mesh.cell-too-large");
  EXPECT_EQ(code_of(square, 100), "");
  EXPECT_EQ(code_of(square, 0.05), "mesh.too-many-vertices");
  EXPECT_EQ(code_of(square, 1e-300), "mesh.too-many-vertices");
  // Long and thin: hardly any area, but more cells along the outline than there may be.
  EXPECT_EQ(code_of({{0, 0}, {1000, 900}, {1000, 900.0001}, {0, 0.0001}}, 0.0004), "mesh.too-many-vertices");
  EXPECT_EQ(code_of({{0, 0}, {100, 0}, {100, 100}, {50, -50}}, 10), "mesh.not-simple");
  EXPECT_EQ(code_of({{0, 0}, {100, 100}, {100, 0}, {0, 100}}, 10), "mesh.not-simple");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(code_of(square, 10, {stop.get_token(), {}, nullptr}), cancelled().code);
}

TEST(RegionMesh, CrossingOutlinesNeverMakeAnInconsistentMesh) {
  shapes::Random random(5);
  for (int i = 0; i < 300; ++i) {
    Points outline;
    for (int k = 0; k < 4 + i % 9; ++k)
      outline.push_back({std::floor(shapes::uniform(random, 0, 9)) * 5, std::floor(shapes::uniform(random, 0, 9)) * 5});
    if (!(bounds(outline).diagonal() > 20)) continue;
    const auto made = make_region_mesh(ClosedCurve(outline), 10, MeshKind::kTrimmed);
    if (!made)
      EXPECT_EQ(made.error().code, "mesh.not-simple");
    else
      EXPECT_GT(made->mesh().cells.size(), 0U);
  }
}

TEST(RegionMesh, SquareHasTheCellsOfItsGrid) {
  const RegionMesh region = make({{0, 0}, {40, 0}, {40, 40}, {0, 40}}, 10);
  // Four cells and a half on either side.
  EXPECT_EQ(region.mesh().cells.size(), 25U);
  EXPECT_EQ(region.mesh().vertices.size(), 36U);
  EXPECT_EQ(region.boundary().size(), 20U);
  EXPECT_EQ(region.mesh().vertices[0], (Point{-5, -5}));
  EXPECT_DOUBLE_EQ(region.mesh().coverage[0], 0.25);
  EXPECT_DOUBLE_EQ(region.mesh().coverage[1], 0.5);
  EXPECT_DOUBLE_EQ(region.mesh().coverage[6], 1);
}

TEST(RegionMesh, ArmsOfAHairpinShareNoVertex) {
  // Both arms run through the cells round x = 30; they join far below.
  const RegionMesh region = make(shapes::slit(60, 100, 1e-9, 31.7), 10);
  const CellPoint left = *region.locate({31.5, 20}), right = *region.locate({31.9, 20});
  EXPECT_NE(left.cell, right.cell);
  const auto &a = region.mesh().cells[left.cell], &b = region.mesh().cells[right.cell];
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(region.mesh().vertices[a[k]], region.mesh().vertices[b[k]]);
    for (const int vertex : b)
      EXPECT_NE(a[k], vertex);
  }
  EXPECT_EQ(region.locate({31.5, 95})->cell, region.locate({31.9, 95})->cell);
}

TEST(RegionMesh, PointsLevelWithACrossingAreLocated) {
  // Lines at −5, 5, 15 …: the outline crosses the vertical ones at whole coordinates.
  const RegionMesh region = make({{0, 35}, {35, 0}, {45, 0}, {80, 35}, {80, 45}, {45, 80}, {35, 80}, {0, 45}}, 10);
  for (int x = 0; x <= 80; ++x)
    for (int y = 0; y <= 80; ++y) {
      const double to_edge = 45 - std::abs(x - 40) - std::abs(y - 40);
      const Point p{static_cast<double>(x), static_cast<double>(y)};
      if (to_edge != 0 && x % 80 != 0 && y % 80 != 0) {
        EXPECT_EQ(region.copies().copy_at(p).has_value(), to_edge > 0) << x << ", " << y;
      }
    }
}

TEST(RegionMesh, RemovedCellsAreReplacedByTheNearestNeighbour) {
  Points disc;
  for (int i = 0; i < 400; ++i)
    disc.push_back(to_point(std::polar(97.0, 2 * std::numbers::pi * i / 400)));
  const RegionMesh covering = make(disc, 10), trimmed = make(disc, 10, MeshKind::kTrimmed);
  EXPECT_LT(trimmed.mesh().cells.size(), covering.mesh().cells.size());
  double furthest = 0;
  for (double s = 0; s < trimmed.outline().length(); s += 0.1) {
    const CellPoint at = trimmed.locate_outline(s);
    furthest = std::max({furthest, -at.u, at.u - 1, -at.v, at.v - 1});
  }
  // A cell is left out when it is covered by less than half; the chord of a half lies at most 1/√2 from two sides.
  EXPECT_GT(furthest, 0.3);
  EXPECT_LT(furthest, 0.75);
}

TEST_P(RegionMeshTest, IsADiscWhoseBoundaryIsOneLoop) {
  for (const MeshKind kind : {MeshKind::kCovering, MeshKind::kTrimmed}) {
    const RegionMesh region = make(GetParam().outline, GetParam().cell, kind);
    expect_disc(region.mesh(), region.boundary());
  }
}

TEST_P(RegionMeshTest, CoverageIsTheAreaInEachCell) {
  const RegionMesh region = make(GetParam().outline, GetParam().cell);
  const QuadMesh& mesh = region.mesh();
  std::map<std::pair<double, double>, double> by_cell;
  double sum = 0;
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    EXPECT_GE(mesh.coverage[i], 0);
    EXPECT_LE(mesh.coverage[i], 1);
    const Point low = mesh.vertices[mesh.cells[i][0]];
    by_cell[{low.x, low.y}] += mesh.coverage[i];
    sum += mesh.coverage[i];
  }
  EXPECT_NEAR(sum * mesh.cell * mesh.cell, region.outline().signed_area(), tiny() * size() * 10);
  for (const auto& [at, coverage] : by_cell) {
    const Point low{at.first, at.second}, high = low + Point{mesh.cell, mesh.cell};
    EXPECT_NEAR(coverage, area_within(region.outline().points(), low, high) / (mesh.cell * mesh.cell), 10 * tiny());
  }
}

TEST_P(RegionMeshTest, OutlineLiesInItsCells) {
  const RegionMesh region = make(GetParam().outline, GetParam().cell);
  const ClosedCurve& outline = region.outline();
  EXPECT_GT(outline.signed_area(), 0);
  const int samples = 5000;
  for (int i = -10; i < samples; ++i) {
    const double s = outline.length() * i / samples;
    const CellPoint at = region.locate_outline(s);
    ASSERT_TRUE(in_unit(at, tiny())) << "s = " << s << ": " << at.u << ", " << at.v;
    ASSERT_LT(distance(locate(region.mesh(), region.mesh().vertices, at), outline.at(s)), tiny());
  }
  for (int i = 0; i < outline.size(); ++i) {
    const CellPoint at = region.locate_outline(outline.s_at(i));
    ASSERT_LT(distance(locate(region.mesh(), region.mesh().vertices, at), outline.points()[i]), tiny());
  }
}

/// From a point straight on to the outline, without leaving the cell: the same piece of the region, so the same copy.
TEST_P(RegionMeshTest, InsidePointsLieInTheCopyOfTheOutlineTheySee) {
  const RegionMesh region = make(GetParam().outline, GetParam().cell);
  const Box box = bounds(region.outline().points());
  shapes::Random random(7);
  int seen = 0;
  for (int i = 0; i < 3000; ++i) {
    Point p{shapes::uniform(random, box.low.x, box.high.x), shapes::uniform(random, box.low.y, box.high.y)};
    if (i % 4 == 0) p = region.mesh().vertices[i % region.mesh().vertices.size()];
    if (!contains(region.outline().points(), p)) continue;
    const auto at = region.locate(p);
    ASSERT_TRUE(at.has_value());
    ASSERT_TRUE(region.copies().copy_at(p).has_value());
    ASSERT_TRUE(in_unit(*at, tiny()));
    ASSERT_LT(distance(locate(region.mesh(), region.mesh().vertices, *at), p), tiny());
    const Point q = p + to_point(std::polar(region.mesh().cell, shapes::uniform(random, 0, 7)));
    const Meeting meeting = first_meeting(region.outline(), p, q);
    const Point low = region.mesh().vertices[region.mesh().cells[at->cell][0]], hit = lerp(p, q, meeting.part) - low;
    const double margin = 1e-6 * region.mesh().cell;
    if (meeting.part > 1 || std::min(hit.x, hit.y) < margin || std::max(hit.x, hit.y) > region.mesh().cell - margin)
      continue;
    EXPECT_EQ(region.locate_outline(meeting.s).cell, at->cell) << p.x << ", " << p.y;
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

/// A short way inside the region over one cell edge leads to a copy glued along that edge.
TEST_P(RegionMeshTest, CopiesAreGluedWhereTheRegionGoesOn) {
  const RegionMesh region = make(GetParam().outline, GetParam().cell);
  const QuadMesh& mesh = region.mesh();
  shapes::Random random(9);
  const Box box = bounds(region.outline().points());
  for (int i = 0; i < 3000; ++i) {
    const Point p{shapes::uniform(random, box.low.x, box.high.x), shapes::uniform(random, box.low.y, box.high.y)};
    if (!contains(region.outline().points(), p)) continue;
    const int cell = region.locate(p)->cell;
    const Point low = mesh.vertices[mesh.cells[cell][0]];
    for (int side = 0; side < 4; ++side) {
      const Point step =
          std::array<Point, 4>{Point{0, low.y - p.y - 1e-3}, Point{low.x + mesh.cell - p.x + 1e-3, 0},
                               Point{0, low.y + mesh.cell - p.y + 1e-3}, Point{low.x - p.x - 1e-3, 0}}[side];
      if (first_meeting(region.outline(), p, p + step).part <= 1) continue;
      const auto& next = mesh.cells[region.locate(p + step)->cell];
      EXPECT_EQ(mesh.cells[cell][side], next[(side + 3) & 3]);
      EXPECT_EQ(mesh.cells[cell][(side + 1) & 3], next[(side + 2) & 3]);
    }
  }
}

TEST_P(RegionMeshTest, StartAndDirectionOfTheOutlineDoNotMatter) {
  const RegionMesh region = make(GetParam().outline, GetParam().cell);
  Points turned = GetParam().outline;
  std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turned.size() / 3), turned.end());
  std::reverse(turned.begin(), turned.end());
  const RegionMesh again = make(turned, GetParam().cell);
  EXPECT_EQ(again.mesh().cells, region.mesh().cells);
  EXPECT_EQ(again.mesh().vertices, region.mesh().vertices);
  EXPECT_EQ(again.boundary().size(), region.boundary().size());
}

TEST_P(RegionMeshTest, TrimmedLeavesOutWhatIsHardlyCovered) {
  const RegionMesh covering = make(GetParam().outline, GetParam().cell);
  const RegionMesh trimmed = make(GetParam().outline, GetParam().cell, MeshKind::kTrimmed);
  const auto well_covered = [](const RegionMesh& region) {
    return std::count_if(region.mesh().coverage.begin(), region.mesh().coverage.end(),
                         [](double c) { return c >= 0.5; });
  };
  EXPECT_EQ(well_covered(trimmed), well_covered(covering));
  EXPECT_LE(trimmed.mesh().cells.size(), covering.mesh().cells.size());
  const ClosedCurve& outline = trimmed.outline();
  for (int i = 0; i < 2000; ++i) {
    const double s = outline.length() * i / 2000;
    const CellPoint at = trimmed.locate_outline(s);
    ASSERT_TRUE(in_unit(at, 1 + tiny()));
    ASSERT_LT(distance(locate(trimmed.mesh(), trimmed.mesh().vertices, at), outline.at(s)), tiny());
  }
}

/// Whole coordinates are level with many vertices and crossings.
TEST_P(RegionMeshTest, WholePointsAreInsideOrOutside) {
  const RegionMesh region = make(GetParam().outline, GetParam().cell);
  const Box box = bounds(region.outline().points());
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 60; ++column) {
      const Point p{std::floor(box.low.x) + column * std::ceil(box.size().x / 60),
                    std::floor(box.low.y) + row * std::ceil(box.size().y / 60)};
      if (region.outline().nearest(p).distance < tiny()) continue;
      EXPECT_EQ(region.copies().copy_at(p).has_value(), contains(region.outline().points(), p)) << p.x << ", " << p.y;
    }
}

TEST_P(RegionMeshTest, PointsOutsideAreLocatedOnlyNearTheOutline) {
  const RegionMesh region = make(GetParam().outline, GetParam().cell);
  const Box box = bounds(region.outline().points());
  shapes::Random random(11);
  const Point margin{2 * region.mesh().cell, 2 * region.mesh().cell};
  for (int i = 0; i < 500; ++i) {
    const Point p{shapes::uniform(random, box.low.x - margin.x, box.high.x + margin.x),
                  shapes::uniform(random, box.low.y - margin.y, box.high.y + margin.y)};
    if (contains(region.outline().points(), p)) continue;
    EXPECT_FALSE(region.copies().copy_at(p).has_value());
    const auto at = region.locate(p);
    EXPECT_EQ(at.has_value(), region.outline().nearest(p).distance <= region.mesh().cell);
    if (!at) continue;
    EXPECT_TRUE(in_unit(*at, 1 + tiny()));
    EXPECT_LT(distance(locate(region.mesh(), region.mesh().vertices, *at), p), tiny());
  }
  EXPECT_FALSE(region.locate({std::numeric_limits<double>::quiet_NaN(), 0}).has_value());
}

INSTANTIATE_TEST_SUITE_P(Shapes, RegionMeshTest, testing::ValuesIn(shapes::cases()), shapes::name_of);

} // namespace
} // namespace oversketch
