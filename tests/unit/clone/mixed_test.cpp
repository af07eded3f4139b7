// Mixed gradients, screening and export: what is solved on every pixel.

#include "core/clone/correction.h"
#include "core/clone/guidance.h"
#include "core/clone/mixed_rows.h"
#include "core/clone/pixel_solver.h"
#include "tests/unit/clone/clone_calls.h"
#include "tests/unit/clone/grid_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

namespace oversketch {
namespace {

/// 8-bit values, most of them near each other: differences often tie.
void make_levels(Raster<Rgba>& picture) {
  for (Rgba& p : picture.values())
    p = {std::round(40 + 6 * p.r) / 255, std::round(90 + 6 * p.g) / 255, std::round(120 + 6 * p.b) / 255, 1};
}

void make_translucent(Raster<Rgba>& picture, unsigned seed) {
  std::mt19937 random(seed);
  for (Rgba& p : picture.values())
    p.a = static_cast<float>(random() % 3) / 2;
}

/// Smooth, as photographs mostly are.
Raster<Rgba> waves(int width, int height, double phase) {
  Raster<Rgba> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto level = [&](double k) {
        return static_cast<float>(0.5 + 0.3 * std::sin(0.07 * k * x + phase) * std::cos(0.05 * y - k * phase));
      };
      out.at(x, y) = {level(1), level(1.3), level(0.7), 1};
    }
  return out;
}

struct MixedScene {
  Mask mask;
  WarpedRegion source;
  Raster<Rgba> target;
  /// Part of the region hangs out to the right.
  int dx = 0, dy = 0;
};

MixedScene noisy_scene(const Mask& mask) {
  const Rect box = grown(mask.bounds(), 1);
  return {mask, noise_region(box, 1), noise(box.width * 3 / 4 + 2, box.height + 3, 2), 2 - box.x, 1 - box.y};
}

MixedScene smooth_scene(const Mask& mask) {
  const Rect box = grown(mask.bounds(), 1);
  return {mask,
          {box, waves(box.width, box.height, 0.3)},
          waves(box.width * 3 / 4 + 2, box.height + 3, 2.1),
          2 - box.x,
          1 - box.y};
}

/// By the definitions in guidance.h and an exact solver; in the domain's values.
class ExactSolver {
public:
  explicit ExactSolver(const Mask& mask) : solver_(PixelSolver::make(mask).value()) {}

  std::vector<Channels> solve(const MixedScene& scene, const BlendOptions& options) const {
    const PlacedPair pair(scene.target, scene.source, scene.dx, scene.dy, options);
    return solver_.solve(options.mode == BlendMode::kMixed ? mixed_side(pair, solver_.graph())
                                                           : membrane_side(pair, solver_.graph()));
  }

private:
  PixelSolver solver_;
};

double error_of(const Correction& correction, const std::vector<Channels>& exact, const Mask& mask) {
  double worst = 0;
  std::size_t pixel = 0;
  std::vector<Float4> line;
  for (std::size_t run = 0; run < mask.runs().size(); ++run) {
    correction.read(run, mask.runs()[run], line);
    for (const Float4& u : line) {
      for (std::size_t k = 0; k < 3; ++k)
        worst = std::max(worst, std::abs(static_cast<double>(u[k]) - exact[pixel].v[k]));
      ++pixel;
    }
  }
  return worst;
}

Result<Correction> solved(const CloneSystem& system, const MixedScene& scene, const BlendOptions& options,
                          CloneQuality quality) {
  const PlacedPair pair(scene.target, scene.source, scene.dx, scene.dy, options);
  return solve_correction(pair, system, options, quality, 1, {});
}

TEST(Mixed, HasTheSidesOfTheDefinitionOnAnyMask) {
  for (const auto& [name, mask] : all_masks()) {
    if (mask.bounds().width > 10'000) continue;
    const ExactSolver exact(mask);
    const Result<MaskMultigrid> grids = MaskMultigrid::make(mask);
    for (const int kind : {0, 1, 2, 3}) {
      MixedScene scene = noisy_scene(mask);
      BlendOptions options = with_mode(BlendMode::kMixed, kind == 3 ? Domain::kLog : Domain::kEncoded);
      if (kind == 1) make_levels(scene.source.pixels), make_levels(scene.target);
      if (kind >= 2) make_translucent(scene.source.pixels, 5), make_translucent(scene.target, 6);
      MultigridSolve solve(*grids);
      const PlacedPair pair(scene.target, scene.source, scene.dx, scene.dy, options);
      set_mixed_side(read_pair(pair), mask, solve);
      ASSERT_TRUE(solve.solve(0.01 / 255, 1, 60).ok()) << name;
      const Correction correction{nullptr, {}, std::make_shared<MultigridSolve>(std::move(solve)), 0};
      EXPECT_LT(255 * error_of(correction, exact.solve(scene, options), mask), kind == 3 ? 0.1 : 0.02)
          << name << " " << kind;
    }
  }
}

TEST(Mixed, HasTheSameSidesWithAnyThreads) {
  for (const Mask& mask : {rect_mask({3, 5, 500, 300}), ring_mask(300, 300, 420, 200)}) {
    ASSERT_GT(mask.count(), 120'000);
    const MixedScene scene = noisy_scene(mask);
    const PlacedPair pair(scene.target, scene.source, scene.dx, scene.dy, with_mode(BlendMode::kMixed));
    const Result<MaskMultigrid> grids = MaskMultigrid::make(mask);
    const auto values_by = [&](int threads) {
      MultigridSolve solve(*grids);
      solve.use_threads(threads);
      set_mixed_side(read_pair(pair), mask, solve);
      EXPECT_TRUE(solve.solve(1, 1, 1).ok());
      std::vector<std::vector<Float4>> values;
      for (std::size_t run = 0; run < mask.runs().size(); ++run) {
        values.emplace_back(static_cast<std::size_t>(mask.runs()[run].x1 - mask.runs()[run].x0));
        solve.get(run, values.back());
      }
      return values;
    };
    const auto is_same = [](const std::vector<Float4>& a, const std::vector<Float4>& b) {
      return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
    };
    const auto alone = values_by(1);
    for (const int threads : {2, 3, 4})
      EXPECT_TRUE(std::ranges::equal(values_by(threads), alone, is_same)) << threads;
  }
}

TEST(Mixed, SeesWhatIsNotFinite) {
  for (const Mask& mask : {ring_mask(0, 0, 15, 7), rect_mask({0, 0, 1, 1}), rect_mask({0, 0, 20, 1})})
    for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
      for (const bool in_source : {false, true}) {
        const Rect box = grown(mask.bounds(), 1);
        for (int y = box.y; y < box.bottom(); ++y)
          for (int x = box.x; x < box.right(); ++x) {
            MixedScene scene = noisy_scene(mask);
            scene.target = noise(box.width + 4, box.height + 4, 9);
            Rgba& pixel =
                in_source ? scene.source.pixels.at(x - box.x, y - box.y) : scene.target.at(x + scene.dx, y + scene.dy);
            pixel.g = bad;
            // It counts in the mask and on its ring.
            const bool counts = mask.contains(x, y) || mask.contains(x - 1, y) || mask.contains(x + 1, y) ||
                                mask.contains(x, y - 1) || mask.contains(x, y + 1);
            const Result<MaskMultigrid> grids = MaskMultigrid::make(mask);
            MultigridSolve solve(*grids);
            const PlacedPair pair(scene.target, scene.source, scene.dx, scene.dy, with_mode(BlendMode::kMixed));
            set_mixed_side(read_pair(pair), mask, solve);
            const auto solved = solve.solve(1, 1, 1);
            ASSERT_EQ(solved.ok(), !counts) << x << " " << y;
            if (counts) EXPECT_EQ(solved.error().code, "clone.not-finite");
          }
      }
}

TEST(Mixed, TiesGoToTheSource) {
  // Steps of one level in red on one side, in green on the other; as floats they differ in their last bits.
  const Mask mask = rect_mask({1, 1, 60, 1});
  MixedScene scene{mask, {{0, 0, 62, 3}, Raster<Rgba>(62, 3)}, Raster<Rgba>(62, 3), 0, 0};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 62; ++x) {
      scene.source.pixels.at(x, y) = {static_cast<float>(3 * x) / 255, 0.2f, 0.2f, 1};
      scene.target.at(x, y) = {0.7f, static_cast<float>(3 * x + 17) / 255, 0.4f, 1};
    }
  // Then f = g + u with u harmonic: that of gradients imported.
  const Result<CloneSystem> system = CloneSystem::make(mask);
  const Result<Correction> mixed = solved(*system, scene, with_mode(BlendMode::kMixed), CloneQuality::kExport);
  EXPECT_LT(255 * error_of(*mixed, ExactSolver(mask).solve(scene, with_mode(BlendMode::kImport)), mask), 0.01);
}

TEST(Mixed, IsAsNearAsItsQualitySays) {
  struct Case {
    CloneQuality quality;
    double levels;
  };
  std::vector<NamedMask> masks = plain_masks();
  for (auto&& some : {tricky_masks(), small_masks()})
    masks.insert(masks.end(), some.begin(), some.end());
  for (const auto& [name, mask] : masks) {
    if (mask.bounds().width > 10'000) continue;
    const ExactSolver exact(mask);
    const Result<CloneSystem> system = CloneSystem::make(mask);
    for (const bool smooth : {false, true}) {
      const MixedScene scene = smooth ? smooth_scene(mask) : noisy_scene(mask);
      const BlendOptions options = with_mode(BlendMode::kMixed);
      const std::vector<Channels> expected = exact.solve(scene, options);
      for (const Case& c :
           {Case{CloneQuality::kDrag, 1.5}, Case{CloneQuality::kRest, 0.1}, Case{CloneQuality::kExport, 0.03}}) {
        const Result<Correction> correction = solved(*system, scene, options, c.quality);
        ASSERT_TRUE(correction.ok()) << name;
        const double error = error_of(*correction, expected, mask);
        EXPECT_LT(255 * error, c.levels) << name;
        if (255 * error > 0.01) EXPECT_GE(0.7 * correction->error, error) << name;
      }
    }
  }
}

TEST(Export, IsWithinThreeHundredthsOfALevelOnAnyMask) {
  for (const auto& [name, mask] : all_masks()) {
    if (mask.bounds().width > 10'000) continue;
    const ExactSolver exact(mask);
    const Result<CloneSystem> system = CloneSystem::make(mask);
    for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMonochrome})
      for (const Domain domain : {Domain::kEncoded, Domain::kLinear}) {
        const MixedScene scene = noisy_scene(mask);
        const BlendOptions options = with_mode(mode, domain);
        const Result<Correction> correction = solved(*system, scene, options, CloneQuality::kExport);
        ASSERT_TRUE(correction.ok()) << name;
        EXPECT_LT(255 * error_of(*correction, exact.solve(scene, options), mask), 0.03) << name;
      }
  }
}

TEST(Screening, TakesTheCorrectionBackToNothingWithTheDistance) {
  // A long strip, and a difference of 0.5 all along its edge: u = 0.5 cosh(c (y − m)) / cosh(c m), in steps.
  const Mask mask = rect_mask({1, 1, 400, 41});
  MixedScene scene{mask,
                   {{0, 0, 402, 43}, Raster<Rgba>(402, 43, {0.25f, 0.25f, 0.25f, 1})},
                   Raster<Rgba>(402, 43, {0.75f, 0.75f, 0.75f, 1}),
                   0,
                   0};
  const Result<CloneSystem> system = CloneSystem::make(mask);
  for (const double reach : {3.0, 10.0, 40.0})
    for (const CloneQuality quality : {CloneQuality::kDrag, CloneQuality::kExport}) {
      BlendOptions options;
      options.screening = screening_for(reach);
      const Result<Correction> correction = solved(*system, scene, options, quality);
      ASSERT_TRUE(correction.ok());
      const double c = std::acosh(1 + options.screening / 2);
      for (int y = 1; y <= 41; ++y) {
        std::vector<Float4> line;
        correction->read(static_cast<std::size_t>(y - 1), mask.runs()[static_cast<std::size_t>(y - 1)], line);
        EXPECT_NEAR(line[200][1], 0.5 * std::cosh(c * (y - 21)) / std::cosh(c * 21),
                    2e-4 + 1.5 / 255 * (quality == CloneQuality::kDrag));
      }
    }
}

TEST(Screening, WithoutAReachIsNone) {
  EXPECT_EQ(screening_for(0), 0);
  EXPECT_EQ(screening_for(10), 0.01);
}

TEST(Screening, OfIdenticalPicturesChangesNothing) {
  const Raster<Rgba> picture = noise(90, 80, 3);
  const Mask mask = disc_mask(40, 40, 30);
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed, BlendMode::kAverage})
    for (const CloneQuality quality :
         {CloneQuality::kFirst, CloneQuality::kDrag, CloneQuality::kRest, CloneQuality::kExport})
      for (const double screening : {0.0, 0.01, 2.0}) {
        BlendOptions options = with_mode(mode);
        options.screening = screening;
        Raster<Rgba> target = picture;
        const Result<CloneSystem> system = CloneSystem::make(mask);
        ASSERT_TRUE(
            clone_into(target, cut_out(picture, grown(mask.bounds(), 1)), 0, 0, *system, options, quality).ok());
        EXPECT_EQ(target, picture);
      }
}

TEST(CloneSystem, KeepsASolveForTheNextWhoAsks) {
  const Result<CloneSystem> system = CloneSystem::make(disc_mask(0, 0, 40));
  const MultigridSolve* first = nullptr;
  {
    const auto held = system->pixels(0, 1);
    ASSERT_TRUE(held.ok());
    first = held->get();
    // One that is held is not given to another.
    EXPECT_NE(system->pixels(0, 1)->get(), first);
  }
  const auto again = system->pixels(0, 1);
  EXPECT_TRUE(again.ok());
  // Of another λ there is another, and the first may be let go after it.
  const auto other = system->pixels(0.5, 1);
  ASSERT_TRUE(other.ok());
  EXPECT_NE(other->get(), again->get());
}

TEST(OnPixels, MasksWithoutAMembraneAreAsNearAsAnyQualitySays) {
  const Mask holes = mask_where({3, -9, 180, 180}, [](int x, int y) { return x % 5 != 0 || y % 5 != 0; });
  const MixedScene noisy = noisy_scene(holes), smooth = smooth_scene(holes);
  const ExactSolver exact(holes);
  const Result<CloneSystem> system = CloneSystem::make(holes);
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMonochrome, BlendMode::kAverage})
    for (const auto& [quality, levels] : {std::pair{CloneQuality::kFirst, 1.0},
                                          {CloneQuality::kDrag, 1.0},
                                          {CloneQuality::kRest, 0.1},
                                          {CloneQuality::kExport, 0.03}}) {
      if (quality != CloneQuality::kExport) {
        ASSERT_TRUE(system->prepare(with_mode(mode), quality).ok());
        EXPECT_FALSE(system->has_membrane(quality));
        EXPECT_EQ(system->membrane(quality).value(), nullptr);
      }
      for (const MixedScene* scene : {&noisy, &smooth}) {
        const Result<Correction> correction = solved(*system, *scene, with_mode(mode), quality);
        ASSERT_TRUE(correction.ok());
        EXPECT_TRUE(correction->pixels && !correction->membrane);
        const double error = 255 * error_of(*correction, exact.solve(*scene, with_mode(mode)), holes);
        EXPECT_LT(error, levels) << to_string(mode) << " " << static_cast<int>(quality);
        EXPECT_LE(error, 255 * correction->error + 0.01);
      }
    }
}

TEST(OnPixels, RatiosAreExportedAsNearAsSaidWhereResultsAreFarAboveWhite) {
  const Mask mask = disc_mask(70, 70, 66);
  MixedScene scene = noisy_scene(mask);
  for (Raster<Rgba>* picture : {&scene.source.pixels, &scene.target})
    for (Rgba& p : picture->values())
      p = {std::round(255 * p.r) / 255, std::round(255 * p.g) / 255, std::round(255 * p.b) / 255, 1};
  const Result<CloneSystem> system = CloneSystem::make(mask);
  const ExactSolver solver(mask);
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed}) {
    const BlendOptions options = with_mode(mode, Domain::kLog);
    const std::vector<Channels> exact = solver.solve(scene, options);
    Raster<Rgba> out = scene.target;
    const Result<CloneReport> report = clone_into(out, scene.source, scene.dx, scene.dy, *system, options);
    ASSERT_TRUE(report.ok());
    // Mixed gradients reach float's rounding first.
    if (mode == BlendMode::kImport) EXPECT_LE(report->residual_levels, 0.0301);
    const PlacedPair pair(scene.target, scene.source, scene.dx, scene.dy, options);
    double largest = 0, worst = 0;
    std::size_t pixel = 0;
    for (const auto& [x, y] : places(mask)) {
      const Channels u = exact[pixel++];
      if (!out.rect().contains(x + scene.dx, y + scene.dy)) continue;
      const Channels expected = from_domain(pair.source_values(pair.source_pixel(x, y)) + u, Domain::kLog);
      const Rgba& got = out.at(x + scene.dx, y + scene.dy);
      for (const auto& [value, wanted] :
           {std::pair{got.r, expected.v[0]}, {got.g, expected.v[1]}, {got.b, expected.v[2]}}) {
        largest = std::max(largest, wanted);
        worst = std::max(worst, 255 * std::abs(static_cast<double>(value) - wanted));
      }
    }
    EXPECT_GT(largest, 4);
    EXPECT_LE(worst, report->residual_levels + 0.005) << "float's rounding is not counted";
    EXPECT_LE(worst, 0.03);
  }
}

TEST(OnPixels, WhereOnlyACoarseMembranePaysItIsThereToMoveWith) {
  const Mask mask = mask_where({3, -9, 180, 180}, [](int x, int y) { return x % 9 != 0 || y % 9 != 0; });
  const Result<CloneSystem> system = CloneSystem::make(mask);
  for (const CloneQuality quality : {CloneQuality::kFirst, CloneQuality::kDrag, CloneQuality::kRest})
    ASSERT_TRUE(system->prepare({}, quality).ok());
  EXPECT_TRUE(system->has_membrane(CloneQuality::kFirst));
  EXPECT_FALSE(system->has_membrane(CloneQuality::kDrag));
  EXPECT_FALSE(system->has_membrane(CloneQuality::kRest));
}

TEST(OnPixels, ThousandsOfIslandsAreBlendedLikeAnyMask) {
  // Of 1 to 9 pixels each, 3600 of them.
  const Mask mask = mask_where({-40, 7, 240, 240}, [](int x, int y) {
    const int u = (x + 40) % 4, v = (y - 7) % 4, island = (x + 40) / 4 + 3 * ((y - 7) / 4);
    return u < 3 && v < 3 && v * 3 + u <= island % 9;
  });
  const Result<CloneSystem> system = CloneSystem::make(mask);
  const MixedScene scene = noisy_scene(mask);
  const ExactSolver exact(mask);
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed, BlendMode::kAverage})
    for (const auto& [quality, levels] : {std::pair{CloneQuality::kDrag, 1.5}, {CloneQuality::kExport, 0.03}}) {
      const Result<Correction> correction = solved(*system, scene, with_mode(mode), quality);
      ASSERT_TRUE(correction.ok());
      EXPECT_LT(255 * error_of(*correction, exact.solve(scene, with_mode(mode)), mask), levels) << to_string(mode);
    }
}

} // namespace
} // namespace oversketch
