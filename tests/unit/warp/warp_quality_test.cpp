// What a warp does to pictures: exactness of the kernels, alpha, and what is shrunk.

#include "core/warp/minification.h"
#include "core/warp/warp.h"

#include "tests/unit/warp/warp_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace oversketch {
namespace {

using Function = std::function<double(Point)>;

/// r = g = f, b = 1 − f at the pixels' centres.
Image drawn(int width, int height, const Function& f) {
  Raster<Rgba> pixels(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto value = static_cast<float>(f({x + 0.5, y + 0.5}));
      pixels.at(x, y) = {value, value, 1 - value, 1};
    }
  return Image(std::move(pixels));
}

/// A picture turned and scaled: the region and the map back to the source.
struct Turned {
  WarpedRegion region;
  Mask mask;
  Similarity back;
};

Turned turn(const ImagePyramid& source, double scale, double angle, const WarpOptions& options = {}) {
  const double width = source.image().width(), height = source.image().height();
  const Similarity map{std::polar(scale, angle), {3.3, -4.7}};
  const QuadMesh mesh = grid_mesh({-0.1 * width, -0.1 * height}, width / 20, 24, static_cast<int>(24 * height / width));
  const double x0 = 0.2 * width, x1 = 0.8 * width, y0 = 0.2 * height, y1 = 0.8 * height;
  const Points corners = transformed({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, map);
  Turned out;
  out.mask = rasterize_polygon(corners, {-2000, -2000, 4000, 4000});
  out.back = map.inverse();
  const Result<WarpedRegion> warped =
      warp_region(source, mesh, transformed(mesh.vertices, map), out.mask, {}, nullptr, options);
  EXPECT_TRUE(warped.ok());
  if (warped.ok()) out.region = *warped;
  return out;
}

/// Calls back with each pixel of the mask, the colour there and the source point.
void for_each_pixel(const Turned& turned, const std::function<void(Rgba, Point)>& call) {
  for (const Mask::Run& run : turned.mask.runs())
    for (int x = run.x0; x < run.x1; ++x)
      call(turned.region.pixels.at(x - turned.region.rect.x, run.y - turned.region.rect.y),
           turned.back({x + 0.5, run.y + 0.5}));
}

double greatest_error(const Turned& turned, const Function& f) {
  double worst = 0;
  for_each_pixel(turned, [&](Rgba got, Point from) { worst = std::max(worst, std::abs(got.r - f(from))); });
  return worst;
}

WarpOptions bicubic() {
  WarpOptions options;
  options.sampling = Sampling::kBicubic;
  return options;
}

TEST(WarpQuality, ASmoothPictureKeepsItsValues) {
  const double kx = 0.19, ky = 0.13;
  const Function f = [&](Point p) { return 0.5 + 0.4 * std::sin(kx * p.x + ky * p.y); };
  const Image source = drawn(120, 120, f);
  // A chord misses a curve by at most f″ / 8, on either axis.
  const double chord = 0.4 * (kx * kx + ky * ky) / 8;
  for (const double scale : {0.8, 1.0, 1.7}) {
    const double linear = greatest_error(turn(source, scale, 0.4), f);
    const double cubic = greatest_error(turn(source, scale, 0.4, bicubic()), f);
    EXPECT_LT(linear, chord + 1e-6) << scale;
    EXPECT_GT(linear, 0.7 * chord) << scale;
    EXPECT_LT(cubic, 0.1 * chord) << scale;
  }
}

TEST(WarpQuality, CatmullRomReproducesQuadratics) {
  const auto unit = [](Point p) { return Point{(p.x - 40) / 40, (p.y - 40) / 40}; };
  const std::vector<Function> functions = {
      [](Point) { return 0.3; },
      [&](Point p) { return unit(p).x * unit(p).x - 0.4 * unit(p).x; },
      [&](Point p) { return 0.7 * unit(p).y * unit(p).y + 0.2 * unit(p).x * unit(p).y; },
      [&](Point p) { return std::pow(unit(p).x * unit(p).y, 2); },
  };
  for (const Function& f : functions) {
    const Turned turned = turn(drawn(80, 80, f), 1.1, 0.6, bicubic());
    EXPECT_LT(greatest_error(turned, f), 2e-6);
    for_each_pixel(turned, [&](Rgba got, Point) { ASSERT_EQ(got.a, 1); });
  }
  // And no cubics, which would need more taps: the test can tell.
  const Function cube = [&](Point p) { return 8 * std::pow(unit(p).x, 3); };
  EXPECT_GT(greatest_error(turn(drawn(80, 80, cube), 1.1, 0.6, bicubic()), cube), 1e-5);
}

TEST(WarpQuality, OvershootStaysWithinTheKernelsBound) {
  const Function edge = [](Point p) { return p.x < 40 ? 0.0 : 1.0; };
  const Turned cubic = turn(drawn(80, 80, edge), 1.3, 0.3, bicubic());
  double least = 1, most = 0;
  for_each_pixel(
      cubic, [&](Rgba got, Point) { least = std::min<double>(least, got.r), most = std::max<double>(most, got.r); });
  EXPECT_LT(least, -0.05);
  EXPECT_GT(most, 1.05);
  EXPECT_GE(least, -9.0 / 32);
  EXPECT_LE(most, 1 + 9.0 / 32);
}

TEST(WarpQuality, OneColourStaysItWhateverItsAlphaAndWhatIsHidden) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> value(0, 1);
  Raster<Rgba> pixels(160, 160);
  for (Rgba& p : pixels.values()) {
    const float alpha = value(random);
    p = alpha < 0.4F ? Rgba{value(random), value(random), value(random), 0}
                     : Rgba{0.25F, 0.5F, 0.75F, alpha < 0.7F ? alpha : 1};
  }
  const Image source(std::move(pixels));
  for (const double scale : {1.2, 0.6, 0.45, 0.2})
    for (const WarpOptions& options : {WarpOptions{}, bicubic()}) {
      const Turned turned = turn(source, scale, 0.5, options);
      double alpha = 0;
      for_each_pixel(turned, [&](Rgba got, Point) {
        alpha += got.a;
        ASSERT_TRUE(got.a >= 0 && got.a <= 1) << got.a;
        if (got.a == 0) {
          ASSERT_EQ(got, (Rgba{0, 0, 0, 0}));
          return;
        }
        ASSERT_NEAR(got.r, 0.25, 2e-5);
        ASSERT_NEAR(got.g, 0.5, 2e-5);
        ASSERT_NEAR(got.b, 0.75, 2e-5);
      });
      // 0.6 of the pixels are seen: half of them with 0.55 on average, half with 1.
      EXPECT_NEAR(alpha / static_cast<double>(turned.mask.count()), 0.465, 0.03) << scale;
    }
}

TEST(WarpQuality, UpToOneAndAHalfNothingIsAveraged) {
  const Image source = noise_image(120, 120, 7);
  const Turned turned = turn(source, 1 / 1.499, 0.2);
  for_each_pixel(turned, [&](Rgba got, Point from) {
    const double x = from.x - 0.5, y = from.y - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double tx = x - i, ty = y - j;
    const auto at = [&](int u, int v) { return static_cast<double>(source.at(i + u, j + v).r); };
    const double mixed = (1 - ty) * ((1 - tx) * at(0, 0) + tx * at(1, 0)) + ty * ((1 - tx) * at(0, 1) + tx * at(1, 1));
    ASSERT_NEAR(got.r, mixed, 1e-5);
  });
}

TEST(WarpQuality, WhatIsShrunkStaysInItsPlace) {
  const Image source = coordinate_image(600, 600);
  for (const double shrink : {1.6, 1.9, 2.0, 2.3, 3.0, 4.5, 9.0}) {
    const Turned turned = turn(source, 1 / shrink, 0.8);
    ASSERT_GT(turned.mask.count(), 500);
    for_each_pixel(turned, [&](Rgba got, Point from) {
      ASSERT_NEAR(got.r, from.x, 1e-3) << shrink;
      ASSERT_NEAR(got.g, from.y, 1e-3) << shrink;
    });
  }
}

/// The mean of the picture over the source's part of a pixel.
double area_mean(const Function& f, const Turned& turned, Point from) {
  constexpr int kSide = 12;
  double sum = 0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const std::complex<double> step{(i + 0.5) / kSide - 0.5, (j + 0.5) / kSide - 0.5};
      sum += f(from + to_point(turned.back.factor * step));
    }
  return sum / (kSide * kSide);
}

struct Contrast {
  int count = 0;
  double error = 0, warped = 0, averaged = 0, plain = 0;
};

/// Root mean squares over the pixels that count: of the difference from the area mean, and of what the warp, the area
/// mean and plain samples differ by from grey.
Contrast contrast(const Function& f, const Image& source, double shrink, double angle,
                  const std::function<bool(Point)>& counts) {
  const Turned turned = turn(source, 1 / shrink, angle);
  Contrast sum;
  for_each_pixel(turned, [&](Rgba got, Point from) {
    if (!counts(from)) return;
    const double mean = area_mean(f, turned, from);
    ++sum.count;
    sum.error += std::pow(got.r - mean, 2), sum.warped += std::pow(got.r - 0.5, 2);
    sum.averaged += std::pow(mean - 0.5, 2), sum.plain += std::pow(f(from) - 0.5, 2);
  });
  for (double* square : {&sum.error, &sum.warped, &sum.averaged, &sum.plain})
    *square = std::sqrt(*square / sum.count);
  return sum;
}

TEST(WarpQuality, AFineChessboardBecomesGrey) {
  const Function board = [](Point p) {
    return static_cast<double>((static_cast<int>(std::floor(p.x)) + static_cast<int>(std::floor(p.y))) & 1);
  };
  const Image source = drawn(300, 300, board);
  for (const double shrink : {1.75, 2.0, 2.3, 2.6, 3.0, 3.7, 5.0, 8.0})
    for (const double angle : {0.0, 0.31, 0.785}) {
      const Contrast c = contrast(board, source, shrink, angle, [](Point) { return true; });
      EXPECT_EQ(c.plain, 0.5);
      EXPECT_LT(c.warped, 0.25 * c.plain) << shrink << " " << angle;
      EXPECT_LT(c.error, 0.1) << shrink << " " << angle;
    }
}

TEST(WarpQuality, AZonePlateShowsNoMoire) {
  // Every direction, and r / 800 waves a pixel at r from the middle.
  const Point middle{400, 400};
  const Function plate = [&](Point p) {
    const Point d = p - middle;
    return 0.5 + 0.5 * std::cos(std::numbers::pi * dot(d, d) / 800);
  };
  const Image source = drawn(800, 800, plate);
  for (const double shrink : {1.75, 2.0, 2.5, 3.0, 4.0, 6.0}) {
    const auto waves = [&](Point from) { return shrink * distance(from, middle) / 800; };
    // Of what the smaller picture cannot show no more is left than the area mean leaves.
    const Contrast fine = contrast(plate, source, shrink, 0.2, [&](Point p) { return waves(p) > 0.55; });
    ASSERT_GT(fine.count, 1000);
    EXPECT_GT(fine.plain, 0.3);
    EXPECT_LT(fine.warped, 1.05 * fine.averaged) << shrink;
    // What it shows with four pixels a wave and more is still there.
    const Contrast coarse = contrast(plate, source, shrink, 0.2, [&](Point p) { return waves(p) < 0.25; });
    ASSERT_GT(coarse.count, 50);
    EXPECT_GT(coarse.warped, 0.7 * coarse.averaged) << shrink;
    EXPECT_LT(coarse.error, 0.12) << shrink;
  }
}

TEST(WarpQuality, NothingJumpsWhereTheScaleChanges) {
  const ImagePyramid source(noise_image(240, 240, 9));
  for (const WarpOptions& options : {WarpOptions{}, bicubic()})
    for (const double shrink : {1.5, 1.75, 2.0, 2.5, 4.0, 5.0, 8.0}) {
      constexpr double kStep = 1e-6;
      const Turned a = turn(source, 1 / (shrink - kStep), 0.4, options);
      const Turned b = turn(source, 1 / (shrink + kStep), 0.4, options);
      const Rect common = intersect(a.region.rect, b.region.rect);
      double worst = 0;
      for (int y = common.y; y < common.bottom(); ++y)
        for (int x = common.x; x < common.right(); ++x) {
          const Rgba p = a.region.pixels.at(x - a.region.rect.x, y - a.region.rect.y);
          const Rgba q = b.region.pixels.at(x - b.region.rect.x, y - b.region.rect.y);
          if (p.a == 1 && q.a == 1) worst = std::max<double>(worst, std::abs(p.r - q.r));
        }
      // Points move by 2 kStep · 100 px, and noise may be as steep as 3 a pixel.
      EXPECT_LT(worst, 1e-3) << shrink;
    }
}

TEST(Minification, StagesAreContinuousAndAsDocumented) {
  EXPECT_EQ(minification_stage(0.3), 0);
  EXPECT_EQ(minification_stage(1.5), 0);
  EXPECT_DOUBLE_EQ(minification_stage(1.625), 0.5);
  for (int k = 1; k < 12; ++k) {
    EXPECT_EQ(minification_stage(std::ldexp(1.0, k)), k);
    EXPECT_DOUBLE_EQ(minification_stage(1.125 * std::ldexp(1.0, k)), k + 0.5);
    EXPECT_EQ(minification_stage(1.6 * std::ldexp(1.0, k)), k + 1);
  }
  for (double sigma = 1; sigma < 40; sigma += 0.001) {
    const double rise = minification_stage(sigma + 0.001) - minification_stage(sigma);
    ASSERT_TRUE(rise >= 0 && rise <= 0.0041) << sigma;
  }
  EXPECT_EQ(minification_stage(std::nan("")), 0);
}

TEST(Minification, OneDirectionIsEnoughAndFoldsAreNone) {
  const QuadMesh mesh = grid_mesh({0, 0}, 10, 4, 4);
  const auto stage_in_the_middle = [&](const std::function<Point(Point)>& map) {
    Points deformed;
    for (const Point p : mesh.vertices)
      deformed.push_back(map(p));
    return Minification(mesh, deformed, 10).corners(5)[2].stage;
  };
  EXPECT_EQ(stage_in_the_middle([](Point p) { return p; }), 0);
  EXPECT_DOUBLE_EQ(stage_in_the_middle([](Point p) { return Point{p.x / 4, 2 * p.y}; }), 2);
  EXPECT_DOUBLE_EQ(stage_in_the_middle([](Point p) { return Point{-p.y / 4, p.x}; }), 2);
  EXPECT_EQ(stage_in_the_middle([](Point p) { return Point{std::abs(p.x - 20), p.y}; }), 0);
  EXPECT_EQ(stage_in_the_middle([](Point) { return Point{7, 7}; }), 0);
  EXPECT_EQ(stage_in_the_middle([](Point p) { return Point{1e-9 * p.x, p.y}; }), 11);
}

} // namespace
} // namespace oversketch
