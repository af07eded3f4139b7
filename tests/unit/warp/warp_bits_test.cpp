// What must not change a bit: identities, instructions, threads.  And how near the quick row is to the exact one.

#include "core/warp/cell_inverse.h"
#include "core/warp/row_kernels.h"
#include "core/warp/warp.h"

#include "tests/unit/warp/warp_support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oversketch {
namespace {

/// Scales from 0.2 to 1.3, bends, a fold, a concave cell, and the picture's edges.
Points bent(const QuadMesh& mesh) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-2, 2);
  Points out;
  for (const Point p : mesh.vertices)
    out.push_back(Point{0.3 * p.x + 0.0025 * p.x * p.x + 8 * std::sin(0.03 * p.y), 0.9 * p.y + 0.1 * p.x} +
                  Point{step(random), step(random)});
  std::swap(out[230], out[231]);
  return out;
}

WarpedRegion drawn(const ImagePyramid& source, const WarpOptions& options, Raster<Rgba> spare = {}) {
  const QuadMesh mesh = grid_mesh({-10, -10}, 11, 20, 20);
  Result<WarpedRegion> out =
      warp_region(source, mesh, bent(mesh), rect_mask({5, 3, 130, 185}), {}, nullptr, options, std::move(spare));
  EXPECT_TRUE(out.ok());
  return out.ok() ? std::move(*out) : WarpedRegion{};
}

TEST(WarpBits, InstructionsAndThreadsChangeNone) {
  for (const float alpha : {1.0F, 0.0F}) {
    const Image image = noise_image(200, 190, 5, alpha);
    for (const Sampling sampling : {Sampling::kBilinear, Sampling::kBicubic}) {
      const WarpedRegion plain = drawn(image, {sampling, 1, Simd::kBaseline});
      ASSERT_EQ(plain.rect.height, 187);
      for (const int threads : {1, 2, 5}) {
        const WarpedRegion other = drawn(image, {sampling, threads, Simd::kBest});
        EXPECT_EQ(plain.rect, other.rect);
        EXPECT_EQ(plain.pixels, other.pixels) << threads;
      }
    }
    EXPECT_NE(drawn(image, {Sampling::kBicubic}).pixels, drawn(image, {}).pixels);
  }
}

TEST(WarpBits, NothingIsLeftOfWhatTheMemoryHeld) {
  const Image image = noise_image(200, 190, 5, 0.0F);
  const WarpedRegion fresh = drawn(image, {});
  for (const int height : {1, 150, 187, 300, 1000}) {
    Raster<Rgba> spare(132, height, Rgba{9, 9, 9, 9});
    const Rgba* const memory = &spare.at(0, 0);
    const WarpedRegion again = drawn(image, {}, std::move(spare));
    EXPECT_EQ(again.pixels, fresh.pixels) << height;
    EXPECT_EQ(&again.pixels.at(0, 0) == memory, height == 187 || height == 300) << height;
  }
}

TEST(WarpBits, BicubicIdentityIsExactToo) {
  const Image image = noise_image(60, 50, 2, 0.0F);
  const QuadMesh mesh = grid_mesh({-3.71, -2.13}, 7.3, 10, 9);
  const Mask mask = rect_mask({0, 0, 60, 50});
  const Result<WarpedRegion> out =
      warp_region(image, mesh, mesh.vertices, mask, {}, nullptr, {Sampling::kBicubic, 2, Simd::kBest});
  ASSERT_TRUE(out.ok());
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x)
      ASSERT_EQ(out->pixels.at(x + 1, y + 1), image.at(x, y)) << x << "," << y;
}

TEST(WarpBits, AGentleRowIsTheExactOneToAMillionthOfItsCell) {
  std::mt19937 random(6);
  int gentle = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double side = trial % 3 == 0 ? 300 : 16;
    const QuadMesh mesh = grid_mesh({1000, -700}, side, 1, 1);
    std::uniform_real_distribution<double> step(-0.3 * side, 0.3 * side);
    Points deformed = mesh.vertices;
    for (Point& p : deformed)
      p = (trial % 2 ? Point{-p.x, p.y} : Point{p.y, p.x}) + Point{step(random), step(random)};
    const CellInverse inverse(mesh, deformed, 0);
    if (!inverse.is_gentle()) continue;
    ++gentle;
    const Box box = bounds(deformed);
    const int y = static_cast<int>(box.centre().y), first = static_cast<int>(box.low.x);
    const int count = std::min(RowKernels::kMost, static_cast<int>(box.size().x));
    for (const Simd simd : {Simd::kBaseline, Simd::kBest}) {
      RowKernels::Values at_x{}, at_y{};
      row_kernels(simd).map_gently(inverse.gentle_row(first, y), count, at_x.data(), at_y.data());
      for (int i = 0; i < count; ++i) {
        const CellInverse::Place place = inverse.locate({first + i + 0.5, y + 0.5});
        if (!(place.u >= 0 && place.u <= 1 && place.v >= 0 && place.v <= 1)) continue;
        const Point exact = inverse.source(0)(place.u, place.v);
        ASSERT_LT(distance(exact, {at_x[static_cast<std::size_t>(i)], at_y[static_cast<std::size_t>(i)]}),
                  0x1p-20 * side)
            << trial << ": " << i;
      }
    }
  }
  EXPECT_GT(gentle, 1000);
}

} // namespace
} // namespace oversketch
