#include "core/warp/warp.h"

#include "tests/unit/warp/warp_support.h"

#include <gtest/gtest.h>

#include <limits>

namespace oversketch {
namespace {

Rgba pixel_at(const WarpedRegion& region, int x, int y) {
  return region.pixels.at(x - region.rect.x, y - region.rect.y);
}

Points jittered(Points points, double by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(-by, by);
  for (Point& p : points)
    p += {step(random), step(random)};
  return points;
}

TEST(WarpRegion, RefusesWhatCannotBeDrawn) {
  const Image image = noise_image(40, 40, 1);
  const QuadMesh mesh = grid_mesh({0, 0}, 10, 4, 4);
  const Mask mask = rect_mask({5, 5, 10, 10});
  const auto code = [&](const Image& source, const Points& deformed, const Mask& wanted) {
    const Result<WarpedRegion> result = warp_region(source, mesh, deformed, wanted);
    return result.ok() ? std::string("ok") : result.error().code;
  };
  EXPECT_EQ(code(image, mesh.vertices, Mask()), "warp.empty-mask");
  EXPECT_EQ(code(Image(), mesh.vertices, mask), "warp.empty-source");
  EXPECT_EQ(code(image, mesh.vertices, Mask({{0, 0, 1}, {1000, 500000, 500001}})), "warp.too-large");
  EXPECT_EQ(code(image, mesh.vertices, rect_mask({500, 500, 3, 3})), "warp.no-cell");
  Points bad = mesh.vertices;
  bad[7].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(image, bad, mask), "warp.not-finite");
  EXPECT_EQ(warp_region(image, mesh, bad, mask).error().where, "mesh vertex 7");
  bad[7].y = -kMaskCoordinateLimit;
  EXPECT_EQ(code(image, bad, mask), "warp.too-far");

  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(warp_region(image, mesh, mesh.vertices, mask, Watch{stop.get_token(), {}, nullptr}).error(), cancelled());

  Points few = mesh.vertices;
  few.pop_back();
  EXPECT_THROW((void)warp_region(image, mesh, few, mask), BugError);
  QuadMesh wild = mesh;
  wild.cells[3][2] = 25;
  EXPECT_THROW((void)warp_region(image, wild, wild.vertices, mask), BugError);

  EXPECT_EQ(unwarped_region(image, Mask()).error().code, "warp.empty-mask");
  EXPECT_EQ(unwarped_region(Image(), mask).error().code, "warp.empty-source");
}

TEST(WarpRegion, IdentityIsExactToTheBit) {
  const Image image = noise_image(60, 50, 2, 0.0F);
  // Cells of no whole size at no whole place.
  const QuadMesh mesh = grid_mesh({-3.71, -2.13}, 7.3, 10, 9);
  const Mask mask = rect_mask({2, 3, 50, 40});
  for (const auto& [dx, dy] : {std::pair{0, 0}, std::pair{-17, 4001}}) {
    Points moved = mesh.vertices;
    for (Point& p : moved)
      p += {dx + 0.0, dy + 0.0};
    const Result<WarpedRegion> out = warp_region(image, mesh, moved, translated(mask, dx, dy));
    ASSERT_TRUE(out.ok());
    EXPECT_EQ(out->rect, (Rect{1 + dx, 2 + dy, 52, 42}));
    for (int y = 2; y < 44; ++y)
      for (int x = 1; x < 53; ++x)
        ASSERT_EQ(pixel_at(*out, x + dx, y + dy), image.at(x, y)) << x << "," << y;
  }
}

TEST(WarpRegion, QuarterTurnsAndMirrorsAreExact) {
  const Image image = noise_image(40, 40, 3);
  const QuadMesh mesh = grid_mesh({0, 0}, 8, 5, 5);
  const Mask mask = rect_mask({0, 0, 40, 40});
  Points turned_mesh, mirrored;
  for (const Point p : mesh.vertices) {
    turned_mesh.push_back(turned(p) + Point{40, 0});
    mirrored.push_back({40 - p.x, p.y});
  }
  const Result<WarpedRegion> a = warp_region(image, mesh, turned_mesh, mask);
  const Result<WarpedRegion> b = warp_region(image, mesh, mirrored, mask);
  ASSERT_TRUE(a.ok() && b.ok());
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(pixel_at(*a, 39 - y, x), image.at(x, y));
      ASSERT_EQ(pixel_at(*b, 39 - x, y), image.at(x, y));
    }
}

TEST(WarpRegion, SimilarityTakesEachPixelFromItsOwnPlace) {
  const Image image = coordinate_image(100, 100);
  const QuadMesh mesh = grid_mesh({10, 10}, 9.5, 8, 8);
  const Similarity map{std::polar(0.83, 0.7), {31.4, -5.2}};
  const Points deformed = transformed(mesh.vertices, map);
  const Mask mask = rasterize_polygon(transformed({{12, 12}, {84, 12}, {84, 84}, {12, 84}}, map), {0, 0, 200, 200});
  ASSERT_GT(mask.count(), 3000);
  const Result<WarpedRegion> out = warp_region(image, mesh, deformed, mask);
  ASSERT_TRUE(out.ok());
  for (const Mask::Run& run : mask.runs())
    for (int x = run.x0; x < run.x1; ++x) {
      const Point from = map.inverse()({x + 0.5, run.y + 0.5});
      const Rgba got = pixel_at(*out, x, run.y);
      ASSERT_NEAR(got.r, from.x, 2e-5);
      ASSERT_NEAR(got.g, from.y, 2e-5);
    }
}

TEST(WarpRegion, EveryPixelIsTheImageOfItsSourcePoint) {
  // Forward check of the inverse bilinear map: put the source point back through its cell.
  const Image image = coordinate_image(100, 100);
  const QuadMesh mesh = grid_mesh({10, 10}, 16, 5, 5);
  const Points deformed = jittered(mesh.vertices, 4, 5);
  const Mask mask = rect_mask({20, 20, 55, 55});
  const Result<WarpedRegion> out = warp_region(image, mesh, deformed, mask);
  ASSERT_TRUE(out.ok());
  for (int y = 20; y < 75; ++y)
    for (int x = 20; x < 75; ++x) {
      const Rgba got = pixel_at(*out, x, y);
      const double u = (got.r - 10.0) / 16, v = (got.g - 10.0) / 16;
      const int column = std::clamp(static_cast<int>(u), 0, 4), row = std::clamp(static_cast<int>(v), 0, 4);
      const CellPoint at{row * 5 + column, u - column, v - row};
      ASSERT_LT(distance(locate(mesh, deformed, at), {x + 0.5, y + 0.5}), 1e-4) << x << "," << y;
    }
}

TEST(WarpRegion, OnlyTheMaskAndItsNeighboursAreDrawn) {
  const Image image = noise_image(40, 40, 6);
  const QuadMesh mesh = grid_mesh({0, 0}, 10, 4, 4);
  const Mask mask({{10, 10, 12}, {11, 20, 21}, {30, 5, 30}});
  const Result<WarpedRegion> out = warp_region(image, mesh, mesh.vertices, mask);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->rect, (Rect{4, 9, 27, 23}));
  for (int y = 9; y < 32; ++y)
    for (int x = 4; x < 31; ++x) {
      bool near = false;
      for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u)
          near |= mask.contains(x + u, y + v);
      ASSERT_EQ(pixel_at(*out, x, y), near ? image.at(x, y) : (Rgba{0, 0, 0, 0}));
    }
}

TEST(WarpRegion, UncoveredPixelsContinueTheNearestCell) {
  const Image image = coordinate_image(100, 100);
  const QuadMesh mesh = grid_mesh({40, 40}, 5, 2, 2);
  const Similarity map{std::polar(1.2, 0.3), {3, -7}};
  const Points deformed = transformed(mesh.vertices, map);
  // Far larger than the mesh: the linear continuation of a similarity is the similarity.
  const Box box = bounds(deformed);
  const Mask mask = rect_mask({static_cast<int>(box.low.x) - 8, static_cast<int>(box.low.y) - 8, 30, 30});
  const Result<WarpedRegion> out = warp_region(image, mesh, deformed, mask);
  ASSERT_TRUE(out.ok());
  for (const Mask::Run& run : mask.runs())
    for (int x = run.x0; x < run.x1; ++x) {
      const Point from = map.inverse()({x + 0.5, run.y + 0.5});
      ASSERT_NEAR(pixel_at(*out, x, run.y).r, from.x, 1e-4);
      ASSERT_NEAR(pixel_at(*out, x, run.y).g, from.y, 1e-4);
    }
}

TEST(WarpRegion, HiddenColoursDoNotBleed) {
  Raster<Rgba> pixels(20, 20, Rgba{1, 0, 0, 0});
  for (int y = 0; y < 20; ++y)
    for (int x = 10; x < 20; ++x)
      pixels.at(x, y) = {0.25F, 0.5F, 0.75F, 1};
  const QuadMesh mesh = grid_mesh({0, 0}, 10, 2, 2);
  Points shifted = mesh.vertices;
  for (Point& p : shifted)
    p.x += 0.25;
  const Result<WarpedRegion> out = warp_region(Image(pixels), mesh, shifted, rect_mask({1, 1, 18, 18}));
  ASSERT_TRUE(out.ok());
  for (int y = 1; y < 19; ++y) {
    EXPECT_EQ(pixel_at(*out, 5, y).a, 0);
    const Rgba edge = pixel_at(*out, 10, y);
    EXPECT_NEAR(edge.a, 0.75, 1e-6);
    EXPECT_NEAR(edge.r, 0.25, 1e-6);
    EXPECT_NEAR(edge.g, 0.5, 1e-6);
    EXPECT_NEAR(edge.b, 0.75, 1e-6);
  }
  const Mask opaque = opaque_part(*out, rect_mask({1, 1, 18, 18}));
  EXPECT_EQ(opaque, rect_mask({10, 1, 9, 18}));
  EXPECT_EQ(opaque_part(*out, rect_mask({-50, -50, 100, 100})), rect_mask({10, 0, 10, 20}));
  EXPECT_TRUE(opaque_part(*out, Mask()).empty());
}

TEST(WarpRegion, FoldedAndDegenerateCellsAreDrawnAndTheLaterCellWins) {
  const Image image = coordinate_image(100, 100);
  const QuadMesh mesh = grid_mesh({0, 0}, 10, 2, 1);
  // The second cell is folded over the first.
  Points folded = mesh.vertices;
  folded[2] = {3, 0}, folded[5] = {3, 10};
  const Result<WarpedRegion> out = warp_region(image, mesh, folded, rect_mask({0, 0, 10, 10}));
  ASSERT_TRUE(out.ok());
  EXPECT_NEAR(pixel_at(*out, 1, 5).r, 1.5, 1e-5);
  EXPECT_NEAR(pixel_at(*out, 6, 5).r, 10 + 3.5 / 7 * 10, 1e-5);
  // All shapes of a cell, points and lines too: drawn without failing, values from the source.
  std::mt19937 random(8);
  std::uniform_int_distribution<int> place(0, 6);
  for (int trial = 0; trial < 2000; ++trial) {
    Points wild = mesh.vertices;
    for (Point& p : wild)
      p = {2.0 * place(random), 2.0 * place(random)};
    const Result<WarpedRegion> drawn = warp_region(image, mesh, wild, rect_mask({0, 0, 13, 13}));
    if (!drawn.ok()) {
      EXPECT_EQ(drawn.error().code, "warp.no-cell");
      continue;
    }
    for (const Rgba& p : drawn->pixels.values())
      ASSERT_TRUE(p.a == 1 && p.r >= 0.5F && p.r <= 99.5F);
  }
}

TEST(WarpRegion, ConcaveCellsStayWithinTheirSource) {
  const Image image = coordinate_image(60, 60);
  const QuadMesh mesh = grid_mesh({20, 20}, 20, 1, 1);
  Points concave = mesh.vertices;
  concave[3] = {25, 25};
  const Mask inside = rasterize_polygon({concave[0], concave[1], concave[3], concave[2]}, {0, 0, 60, 60});
  ASSERT_GT(inside.count(), 50);
  const Result<WarpedRegion> out = warp_region(image, mesh, concave, inside);
  ASSERT_TRUE(out.ok());
  for (const Mask::Run& run : inside.runs())
    for (int x = run.x0; x < run.x1; ++x) {
      const Rgba got = pixel_at(*out, x, run.y);
      ASSERT_TRUE(got.r >= 19.99F && got.r <= 40.01F && got.g >= 19.99F && got.g <= 40.01F) << x << "," << run.y;
    }
}

TEST(WarpRegion, WhereMarginsOverlapTheRegionsOwnInsideWins) {
  // Two cells of two parts, pushed together: the first one's inside lies under the second one's margin.
  const Image image = coordinate_image(60, 20);
  QuadMesh mesh;
  mesh.cell = 10;
  mesh.vertices = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {40, 0}, {50, 0}, {50, 10}, {40, 10}};
  mesh.cells = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  mesh.coverage = {0.5, 0.5};
  Points pushed = mesh.vertices;
  for (std::size_t k = 4; k < 8; ++k)
    pushed[k].x -= 34;
  std::vector<Mask::Run> runs;
  for (int y = 0; y < 10; ++y)
    runs.insert(runs.end(), {{y, 0, 9}, {y, 43, 50}});
  const Mask region(std::move(runs));
  const Result<WarpedRegion> out = warp_region(image, mesh, pushed, rect_mask({0, 0, 16, 10}), {}, &region);
  ASSERT_TRUE(out.ok());
  EXPECT_NEAR(pixel_at(*out, 5, 5).r, 5.5, 1e-5);
  EXPECT_NEAR(pixel_at(*out, 8, 5).r, 8.5, 1e-5);
  EXPECT_NEAR(pixel_at(*out, 9, 5).r, 43.5, 1e-5);
  const Result<WarpedRegion> plain = warp_region(image, mesh, pushed, rect_mask({0, 0, 16, 10}));
  ASSERT_TRUE(plain.ok());
  EXPECT_NEAR(pixel_at(*plain, 8, 5).r, 42.5, 1e-5);
}

TEST(UnwarpedRegion, RepeatsTheEdge) {
  const Image image = noise_image(5, 4, 9);
  const Result<WarpedRegion> out = unwarped_region(image, rect_mask(image.rect()));
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->rect, (Rect{-1, -1, 7, 6}));
  for (int y = -1; y < 5; ++y)
    for (int x = -1; x < 6; ++x)
      EXPECT_EQ(pixel_at(*out, x, y), image.at(std::clamp(x, 0, 4), std::clamp(y, 0, 3)));
}

} // namespace
} // namespace oversketch
