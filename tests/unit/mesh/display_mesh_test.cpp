#include "core/mesh/display_mesh.h"

#include "mesh_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <limits>

namespace oversketch {
namespace {

using shapes::Case;

class DisplayMeshTest : public testing::TestWithParam<Case> {
protected:
  RegionMesh control(MeshKind kind) const {
    return std::move(*make_region_mesh(ClosedCurve(GetParam().outline), GetParam().cell, kind));
  }
  double tiny() const { return 1e-9 * std::max(1.0, 1e-5 * std::abs(GetParam().outline[0].x)); }
};

TEST(DisplayMesh, RefusesWhatItCannotMesh) {
  const auto control = make_region_mesh(ClosedCurve({{0, 0}, {100, 0}, {100, 50}, {0, 50}}), 10, MeshKind::kCovering);
  ASSERT_TRUE(control.ok());
  for (const double cell :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(make_display_mesh(*control, cell).error().code, "mesh.cell");
  EXPECT_EQ(make_display_mesh(*control, 0.05).error().code, "mesh.too-many-vertices");
  EXPECT_EQ(make_display_mesh(*control, 1e-300).error().code, "mesh.too-many-vertices");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(make_display_mesh(*control, 5, {stop.get_token(), {}, nullptr}).error().code, cancelled().code);
}

TEST(DisplayMesh, CellIsTheLargestPartOfAControlCellThatIsSmallEnough) {
  const auto control = make_region_mesh(ClosedCurve({{0, 0}, {100, 0}, {100, 50}, {0, 50}}), 12, MeshKind::kCovering);
  ASSERT_TRUE(control.ok());
  for (const auto& [wanted, divisions] : {std::pair{30.0, 1}, {12.0, 1}, {11.9, 2}, {6.0, 2}, {5.9, 3}, {1.2, 10}}) {
    const auto display = make_display_mesh(*control, wanted);
    ASSERT_TRUE(display.ok());
    EXPECT_EQ(display->divisions, divisions);
    EXPECT_DOUBLE_EQ(display->mesh.cell, 12.0 / divisions);
  }
}

TEST(DisplayMesh, UndividedCoveringMeshIsTheControlMesh) {
  const auto control = make_region_mesh(ClosedCurve(shapes::spiral(4, 6, 1.5)), 10, MeshKind::kCovering);
  const auto display = make_display_mesh(*control, 10);
  EXPECT_EQ(display->mesh.cells, control->mesh().cells);
  EXPECT_EQ(display->mesh.vertices, control->mesh().vertices);
  EXPECT_EQ(prolong(control->mesh(), control->mesh().vertices, *display), control->mesh().vertices);
}

TEST(DisplayMesh, ExtrapolatesOnlyBeyondTheControlMesh) {
  Points disc;
  for (int i = 0; i < 400; ++i)
    disc.push_back(to_point(std::polar(97.0, 2 * std::numbers::pi * i / 400)));
  const auto control = make_region_mesh(ClosedCurve(disc), 10, MeshKind::kTrimmed);
  const auto display = make_display_mesh(*control, 2);
  int beyond = 0;
  for (std::size_t i = 0; i < display->mesh.vertices.size(); ++i) {
    const CellPoint at = display->in_control[i];
    bool in_mesh = false;
    for (const auto& cell : control->mesh().cells) {
      const Point from_corner = display->mesh.vertices[i] - control->mesh().vertices[cell[0]];
      in_mesh |= std::min(from_corner.x, from_corner.y) > -1e-9 && std::max(from_corner.x, from_corner.y) < 10 + 1e-9;
    }
    EXPECT_EQ(std::min(at.u, at.v) >= 0 && std::max(at.u, at.v) <= 1, in_mesh);
    beyond += in_mesh ? 0 : 1;
  }
  EXPECT_GT(beyond, 0);
}

TEST_P(DisplayMeshTest, VerticesLieWhereTheyWere) {
  for (const MeshKind kind : {MeshKind::kCovering, MeshKind::kTrimmed})
    for (const double part : {1.0, 0.4, 0.13}) {
      const RegionMesh region = control(kind);
      const auto display = make_display_mesh(region, part * GetParam().cell);
      ASSERT_TRUE(display.ok());
      ASSERT_EQ(display->in_control.size(), display->mesh.vertices.size());
      const Points placed = prolong(region.mesh(), region.mesh().vertices, *display);
      const double most = kind == MeshKind::kCovering ? 0 : 1;
      for (std::size_t i = 0; i < placed.size(); ++i) {
        ASSERT_LT(distance(placed[i], display->mesh.vertices[i]), tiny());
        const CellPoint at = display->in_control[i];
        ASSERT_TRUE(std::min(at.u, at.v) >= -most && std::max(at.u, at.v) <= 1 + most);
      }
    }
}

TEST_P(DisplayMeshTest, IsItselfADisc) {
  const RegionMesh region = control(MeshKind::kCovering);
  const auto display = make_display_mesh(region, 0.3 * GetParam().cell);
  ASSERT_TRUE(display.ok());
  const QuadMesh& mesh = display->mesh;
  EXPECT_EQ(static_cast<int>(mesh.vertices.size()) - static_cast<int>(edges_of(mesh).size()) +
                static_cast<int>(mesh.cells.size()),
            1);
  EXPECT_TRUE(is_connected(mesh));
  double area = 0;
  for (const double coverage : mesh.coverage)
    area += coverage * mesh.cell * mesh.cell;
  EXPECT_NEAR(area, region.outline().signed_area(), tiny() * bounds(GetParam().outline).diagonal() * 10);
}

TEST_P(DisplayMeshTest, FollowsSimilaritiesExactly) {
  const Similarity similarity{std::polar(1.7, 2.1), {31, -9}};
  for (const MeshKind kind : {MeshKind::kCovering, MeshKind::kTrimmed}) {
    const RegionMesh region = control(kind);
    const auto display = make_display_mesh(region, 0.3 * GetParam().cell);
    const Points moved = prolong(region.mesh(), transformed(region.mesh().vertices, similarity), *display);
    for (std::size_t i = 0; i < moved.size(); ++i)
      ASSERT_LT(distance(moved[i], similarity(display->mesh.vertices[i])), 10 * tiny());
  }
}

/// Every control vertex goes its own way: each display cell must be the bilinear image of its part of one control cell,
/// the one in whose copy the display cell lies.
TEST_P(DisplayMeshTest, CellsFollowTheControlCopyTheyLieIn) {
  const RegionMesh region = control(MeshKind::kCovering);
  const auto display = make_display_mesh(region, 0.3 * GetParam().cell);
  shapes::Random random(3);
  Points positions;
  for (std::size_t i = 0; i < region.mesh().vertices.size(); ++i)
    positions.push_back({shapes::uniform(random, 0, 100), shapes::uniform(random, 0, 100)});
  const Points moved = prolong(region.mesh(), positions, *display);
  const Box box = bounds(GetParam().outline);
  // The display mesh as a mesh of its own tells in which of its copies a point lies.
  const QuadMesh& mesh = display->mesh;
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const Point p{shapes::uniform(random, box.low.x, box.high.x), shapes::uniform(random, box.low.y, box.high.y)};
    if (!contains(region.outline().points(), p)) continue;
    const Point expected = locate(region.mesh(), positions, *region.locate(p));
    double nearest = HUGE_VAL;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
      const Point uv = (p - mesh.vertices[mesh.cells[cell][0]]) / mesh.cell;
      if (std::min(uv.x, uv.y) < -1e-9 || std::max(uv.x, uv.y) > 1 + 1e-9) continue;
      nearest = std::min(nearest, distance(locate(mesh, moved, {static_cast<int>(cell), uv.x, uv.y}), expected));
    }
    ASSERT_LT(nearest, 1e-7);
    if (++checked == 200) break;
  }
  EXPECT_GT(checked, 0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, DisplayMeshTest, testing::ValuesIn(shapes::cases()), shapes::name_of);

} // namespace
} // namespace oversketch
