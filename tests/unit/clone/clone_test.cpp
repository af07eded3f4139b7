#include "core/clone/clone.h"

#include "core/base/check.h"
#include "core/clone/pixel_check.h"
#include "core/image/levels.h"
#include "tests/unit/clone/clone_calls.h"

#include <gtest/gtest.h>

#include <limits>

namespace oversketch {
namespace {

constexpr BlendMode kSolved[] = {BlendMode::kImport, BlendMode::kMixed, BlendMode::kMonochrome, BlendMode::kAverage};
constexpr Domain kDomains[] = {Domain::kEncoded, Domain::kLinear, Domain::kLog};

TEST(Clone, RefusesWhatCannotBeBlendedAndLeavesTheTargetAlone) {
  const Mask mask = rect_mask({2, 2, 5, 5});
  const WarpedRegion source = region_for(mask, 1);
  const Raster<Rgba> original = noise(12, 12, 2);
  const Result<CloneSystem> system = CloneSystem::make(mask);
  ASSERT_TRUE(system.ok());
  Raster<Rgba> target = original;
  const auto code = [&](const WarpedRegion& g, const BlendOptions& options) {
    const Result<CloneReport> result = clone_into(target, g, 0, 0, *system, options);
    return result.ok() ? std::string("ok") : result.error().code;
  };
  BlendOptions bad;
  bad.strength = 2;
  EXPECT_EQ(code(source, bad), "clone.bad-option");
  EXPECT_EQ(code(noise_region({2, 2, 5, 5}, 1), {}), "clone.source-too-small");
  EXPECT_EQ(code(noise_region({1, 1, 7, 6}, 1), {}), "clone.source-too-small");
  EXPECT_EQ(code(noise_region({2, 2, 5, 4}, 1), with_mode(BlendMode::kNone)), "clone.source-too-small");
  EXPECT_EQ(code({}, {}), "clone.source-too-small");
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    for (const int at : {1, 3, 5}) {
      WarpedRegion broken = source;
      broken.pixels.at(at, 0).g = wrong;
      EXPECT_EQ(code(broken, {}), "clone.not-finite");
      EXPECT_EQ(clone_into(target, broken, 0, 0, *system).error().where,
                "source pixel " + std::to_string(at + 1) + ", 1");
      broken = source;
      broken.pixels.at(3, at).a = wrong;
      EXPECT_EQ(code(broken, with_mode(BlendMode::kMixed)), "clone.not-finite");
      EXPECT_EQ(code(broken, with_mode(BlendMode::kNone)), "clone.not-finite");
    }
  EXPECT_EQ(target, original);

  target.at(4, 4).b = std::numeric_limits<float>::infinity();
  EXPECT_EQ(code(source, {}), "clone.not-finite");
  EXPECT_EQ(clone_into(target, source, 1, -2, *system).error().where, "target pixel 4, 4");
  target = original;
  // Finite, but beyond what is added up and squared; in the mask and on its ring.
  for (const float wrong : {70'000.0F, -70'000.0F, 3e38F})
    for (const int at : {1, 3, 5})
      for (const BlendMode mode : kSolved)
        for (const Domain domain : kDomains) {
          WarpedRegion broken = source;
          broken.pixels.at(at, 0).g = wrong;
          EXPECT_EQ(code(broken, with_mode(mode, domain)), "clone.out-of-range");
          EXPECT_EQ(clone_into(target, broken, 0, 0, *system, with_mode(mode, domain)).error().where,
                    "source pixel " + std::to_string(at + 1) + ", 1");
          target.at(4, 4).b = wrong;
          EXPECT_EQ(clone_into(target, source, 1, -2, *system, with_mode(mode, domain)).error().where,
                    "target pixel 4, 4");
          target = original;
        }
  // Pasted as it is it does no harm.
  WarpedRegion large = source;
  large.pixels.at(3, 3).r = -3e38F;
  EXPECT_EQ(code(large, with_mode(BlendMode::kNone)), "ok");
  target = original;

  Raster<Rgba> none;
  EXPECT_EQ(clone_into(none, source, 0, 0, *system).error().code, "clone.empty-target");
  std::stop_source stop;
  stop.request_stop();
  target = original;
  EXPECT_EQ(clone_into(target, source, 0, 0, *system, {}, CloneQuality::kExport, Watch{stop.get_token(), {}, nullptr})
                .error(),
            cancelled());
  EXPECT_EQ(target, original);
  EXPECT_THROW((void)clone_into(target, {{1, 1, 7, 8}, source.pixels}, 0, 0, *system), BugError);
}

TEST(Clone, IsPoissonEditingByTheBookInEveryMode) {
  const std::vector<Mask> masks = {rect_mask({3, 4, 9, 7}),
                                   rect_mask({6, 6, 1, 1}),
                                   rect_mask({2, 5, 14, 1}),
                                   ring_mask(3, 3, 11, 5),
                                   random_mask({1, 1, 16, 14}, 0.6, 7),
                                   rect_mask({0, 0, 18, 16}),
                                   random_mask({0, 0, 18, 16}, 0.2, 8)};
  const Raster<Rgba> target = noise(18, 16, 3);
  for (const Mask& mask : masks) {
    // One source rougher than the target, one smoother: mixed takes from both.
    for (const float high : {1.0F, 0.4F}) {
      const WarpedRegion source = noise_region(grown(mask.bounds(), 1), 4, 0, high);
      for (const BlendMode mode : kSolved)
        for (const auto& [dx, dy] : {std::pair{0, 0}, std::pair{5, -4}}) {
          CloneReport report;
          const Raster<Rgba> got = cloned(target, source, mask, dx, dy, with_mode(mode), &report);
          EXPECT_EQ(report.unknowns, mask.count());
          EXPECT_LT(report.residual_levels, 1e-9);
          const BookSolution book(target, source, mask, dx, dy, mode);
          for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 18; ++x) {
              const Rgba p = got.at(x, y);
              if (!mask.contains(x - dx, y - dy)) {
                ASSERT_EQ(p, target.at(x, y));
                continue;
              }
              ASSERT_TRUE(report.changed.contains(x, y));
              const BookSolution::Colour& expected = book.at(x - dx, y - dy);
              ASSERT_NEAR(p.r, expected[0], 1e-6) << to_string(mode) << " " << x << "," << y;
              ASSERT_NEAR(p.g, expected[1], 1e-6);
              ASSERT_NEAR(p.b, expected[2], 1e-6);
              ASSERT_EQ(p.a, 1);
            }
        }
    }
  }
}

TEST(Clone, OntoItselfIsItselfInEveryDomain) {
  const Raster<Rgba> picture = noise(40, 30, 5, -0.2F, 1.4F);
  for (const Mask& mask : {random_mask({2, 3, 30, 20}, 0.8, 9), rect_mask({0, 0, 40, 30}), rect_mask({-5, 7, 60, 9})})
    for (const Domain domain : kDomains)
      for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed, BlendMode::kAverage, BlendMode::kNone})
        for (const double strength : {1.0, 0.3}) {
          BlendOptions options = with_mode(mode, domain);
          options.strength = strength;
          const WarpedRegion source = cut_out(picture, grown(mask.bounds(), 1));
          EXPECT_LT(difference_levels(cloned(picture, source, mask, 0, 0, options), picture), 1e-4);
        }
}

TEST(Clone, AConstantAddedToTheSourceChangesNothing) {
  const Mask mask = random_mask({3, 3, 20, 20}, 0.85, 10);
  const Raster<Rgba> target = noise(26, 26, 6);
  const WarpedRegion source = region_for(mask, 7);
  WarpedRegion brighter = source;
  for (Rgba& p : brighter.pixels.values())
    p.r += 0.5F, p.g -= 0.25F, p.b += 2.0F;
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed, BlendMode::kAverage})
    EXPECT_LT(difference_levels(cloned(target, source, mask, 1, 2, with_mode(mode)),
                                cloned(target, brighter, mask, 1, 2, with_mode(mode))),
              1e-4);
}

TEST(Clone, AFactorOnTheSourceChangesNothingInLog) {
  const Mask mask = ring_mask(3, 3, 20, 6);
  const Raster<Rgba> target = noise(26, 26, 6, 0.1F, 0.9F);
  const WarpedRegion source = noise_region(grown(mask.bounds(), 1), 7, 0.1F, 0.9F);
  WarpedRegion brighter = source;
  const auto scale = [](float x) { return static_cast<float>(3 * (x + 1.0 / 255) - 1.0 / 255); };
  for (Rgba& p : brighter.pixels.values())
    p.r = scale(p.r), p.g = scale(p.g), p.b = scale(p.b);
  const BlendOptions options = with_mode(BlendMode::kImport, Domain::kLog);
  EXPECT_LT(
      difference_levels(cloned(target, source, mask, 0, 0, options), cloned(target, brighter, mask, 0, 0, options)),
      1e-3);
}

TEST(Clone, IsLinearInLinearLight) {
  // Cloning in linear light is cloning of the decoded pictures.
  const Mask mask = rect_mask({4, 4, 12, 10});
  const auto encode = [](const Raster<Rgba>& linear) {
    Raster<Rgba> out = linear;
    const auto curve = [](float x) {
      return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(static_cast<double>(x), 1 / 2.4) - 0.055);
    };
    for (Rgba& p : out.values())
      p = {curve(p.r), curve(p.g), curve(p.b), p.a};
    return out;
  };
  const Raster<Rgba> target = noise(20, 20, 8, 0.4F, 0.6F);
  const WarpedRegion source = noise_region({3, 3, 14, 12}, 9, 0.4F, 0.6F);
  const Raster<Rgba> expected = encode(cloned(target, source, mask, 0, 0, with_mode(BlendMode::kMixed)));
  const Raster<Rgba> got = cloned(encode(target), {source.rect, encode(source.pixels)}, mask, 0, 0,
                                  with_mode(BlendMode::kMixed, Domain::kLinear));
  EXPECT_LT(difference_levels(got, expected), 1e-2);
}

TEST(Clone, MovesWithItsPictures) {
  const Mask mask = random_mask({3, 3, 20, 20}, 0.7, 11);
  const Raster<Rgba> target = noise(30, 30, 10);
  const WarpedRegion source = region_for(mask, 12);
  WarpedRegion moved = source;
  moved.rect = translated(source.rect, -1000, 77);
  for (const BlendMode mode : kSolved)
    EXPECT_EQ(cloned(target, source, mask, 2, -1, with_mode(mode)),
              cloned(target, moved, translated(mask, -1000, 77), 1002, -78, with_mode(mode)));
}

TEST(Clone, OverEveryEdgeAndCornerItIsTheCloneIntoAPaddedTarget) {
  const Mask mask = random_mask({0, 0, 14, 12}, 0.85, 13);
  const WarpedRegion source = region_for(mask, 14);
  const Raster<Rgba> target = noise(20, 18, 15);
  const int pad = 30;
  const Raster<Rgba> padded = cut_out(target, {-pad, -pad, 20 + 2 * pad, 18 + 2 * pad}).pixels;
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed, BlendMode::kNone})
    for (const int dx : {-13, -7, 3, 15, 19})
      for (const int dy : {-11, -6, 3, 10, 17}) {
        const Raster<Rgba> got = cloned(target, source, mask, dx, dy, with_mode(mode));
        const Raster<Rgba> whole = cloned(padded, source, mask, dx + pad, dy + pad, with_mode(mode));
        for (int y = 0; y < 18; ++y)
          for (int x = 0; x < 20; ++x)
            ASSERT_EQ(got.at(x, y), whole.at(x + pad, y + pad)) << dx << "," << dy;
      }
}

TEST(Clone, WhollyOutsideNothingIsPainted) {
  const Mask mask = rect_mask({0, 0, 6, 6});
  const WarpedRegion source = region_for(mask, 16);
  const Raster<Rgba> target = noise(10, 10, 17);
  const int far = std::numeric_limits<int>::max(), low = std::numeric_limits<int>::min();
  for (const auto& [dx, dy] : {std::pair{10, 0}, std::pair{-6, 0}, std::pair{0, 10}, std::pair{3, -6},
                               std::pair{far, far}, std::pair{low, 0}, std::pair{0, low}, std::pair{low, far}}) {
    CloneReport report;
    EXPECT_EQ(cloned(target, source, mask, dx, dy, {}, &report), target);
    EXPECT_EQ(report.changed, Rect{});
    EXPECT_EQ(report.unknowns, 36);
  }
}

TEST(Clone, ThousandsOfIslands) {
  std::vector<Mask::Run> runs;
  for (int y = 0; y < 200; y += 2)
    for (int x = 0; x < 200; x += 2)
      runs.push_back({y, x, x + 1});
  const Mask mask(std::move(runs));
  const Raster<Rgba> target = noise(200, 200, 18);
  const WarpedRegion source = region_for(mask, 19);
  const Raster<Rgba> got = cloned(target, source, mask, 0, 0, {});
  // Each pixel alone: f = g + mean of the four differences.
  const auto f = [&](int x, int y) { return target.at(std::clamp(x, 0, 199), std::clamp(y, 0, 199)).g; };
  const auto g = [&](int x, int y) { return source.pixels.at(x + 1, y + 1).g; };
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      if (x % 2 || y % 2) {
        ASSERT_EQ(got.at(x, y), target.at(x, y));
        continue;
      }
      double sum = 0;
      for (const auto& [u, v] : {std::pair{x - 1, y}, std::pair{x + 1, y}, std::pair{x, y - 1}, std::pair{x, y + 1}})
        sum += f(u, v) - g(u, v);
      ASSERT_NEAR(got.at(x, y).g, g(x, y) + sum / 4, 1e-6);
    }
}

TEST(Clone, MixedWithAFlatSourceIsTheTargetAndWithAFlatTargetImports) {
  const Mask mask = ring_mask(2, 2, 20, 8);
  const Raster<Rgba> target = noise(24, 24, 20);
  WarpedRegion flat = region_for(mask, 21);
  for (Rgba& p : flat.pixels.values())
    p = {0.3F, 0.9F, 0.1F, 1};
  EXPECT_LT(difference_levels(cloned(target, flat, mask, 0, 0, with_mode(BlendMode::kMixed)), target), 1e-4);
  const WarpedRegion source = region_for(mask, 22);
  const Raster<Rgba> grey(24, 24, Rgba{0.5F, 0.5F, 0.5F, 1});
  EXPECT_LT(difference_levels(cloned(grey, source, mask, 0, 0, with_mode(BlendMode::kMixed)),
                              cloned(grey, source, mask, 0, 0, with_mode(BlendMode::kImport))),
            1e-4);
}

TEST(Clone, PlainPasteKeepsTheSourcesBits) {
  const Mask mask = random_mask({1, 1, 12, 12}, 0.6, 23);
  const Raster<Rgba> target = noise(14, 14, 24);
  const WarpedRegion source = region_for(mask, 25);
  Raster<Rgba> pasted = target;
  ASSERT_TRUE(paste_into(pasted, source, mask, 0, 0).ok());
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 14; ++x)
      EXPECT_EQ(pasted.at(x, y),
                mask.contains(x, y) ? source.pixels.at(x - source.rect.x, y - source.rect.y) : target.at(x, y));
  EXPECT_EQ(cloned(target, source, mask, 0, 0, with_mode(BlendMode::kNone)), pasted);
  for (const Domain domain : kDomains)
    for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed}) {
      BlendOptions weak = with_mode(mode, domain);
      weak.strength = 0;
      EXPECT_EQ(cloned(target, source, mask, 0, 0, weak), pasted);
    }
  // No source beyond the mask is needed.
  Raster<Rgba> again = target;
  EXPECT_TRUE(paste_into(again, cut_out(source.pixels, {1, 1, 12, 12}), mask, 0, 0).ok());
}

TEST(Clone, AnyPictureWithinTheRangeGivesNumbers) {
  const Mask mask = disc_mask(20, 20, 15);
  WarpedRegion source = noise_region(grown(mask.bounds(), 1), 1, -65504, 65504);
  Raster<Rgba> target = noise(44, 44, 2, -65504, 65504);
  // The ends themselves, side by side.
  for (int i = 0; i < 30; ++i)
    source.pixels.at(i, i).r = target.at(i, 20).r = i % 2 == 0 ? kLargestBlended : -kLargestBlended;
  for (const BlendMode mode : kSolved)
    for (const Domain domain : kDomains) {
      CloneReport report;
      const Raster<Rgba> out = cloned(target, source, mask, 1, 2, with_mode(mode, domain), &report);
      EXPECT_TRUE(is_finite(out.values())) << to_string(mode) << " " << to_string(domain);
      EXPECT_TRUE(std::isfinite(report.residual_levels));
    }
}

} // namespace
} // namespace oversketch
