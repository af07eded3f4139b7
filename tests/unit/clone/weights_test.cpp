#include "core/clone/clone.h"

#include "tests/unit/clone/clone_calls.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

TEST(CloneWeights, StrengthScalesTheCorrectionAndFeatherKeepsTheEdge) {
  const Mask mask = rect_mask({2, 2, 41, 41});
  const Raster<Rgba> target = noise(45, 45, 26, 0.6F, 0.9F);
  const WarpedRegion source = noise_region({1, 1, 43, 43}, 27, 0, 0.2F);
  const Raster<Rgba> full = cloned(target, source, mask, 0, 0, {});
  BlendOptions options;
  options.strength = 0.25;
  const Raster<Rgba> partly = cloned(target, source, mask, 0, 0, options);
  options.feather_px = 8;
  const Raster<Rgba> soft = cloned(target, source, mask, 0, 0, options);
  for (int y = 2; y < 43; ++y)
    for (int x = 2; x < 43; ++x) {
      const float g = source.pixels.at(x - 1, y - 1).r;
      const double u = full.at(x, y).r - g;
      ASSERT_NEAR(partly.at(x, y).r, g + 0.25 * u, 1e-6);
      const double t = std::min(1.0, std::min({x - 1, y - 1, 43 - x, 43 - y}) / 9.0);
      ASSERT_NEAR(soft.at(x, y).r, g + (1 - 0.75 * t * t * (3 - 2 * t)) * u, 1e-6);
    }
  options.strength = 1;
  EXPECT_EQ(cloned(target, source, mask, 0, 0, options), full);
  // A plain paste fades in.
  BlendOptions paste = with_mode(BlendMode::kNone);
  paste.feather_px = 8;
  const Raster<Rgba> faded = cloned(target, source, mask, 0, 0, paste);
  for (int x = 2; x < 43; ++x) {
    const double t = std::min(1.0, std::min(x - 1, 43 - x) / 9.0), w = t * t * (3 - 2 * t);
    EXPECT_NEAR(faded.at(x, 22).g, w * source.pixels.at(x - 1, 21).g + (1 - w) * target.at(x, 22).g, 1e-6);
  }
}

TEST(CloneWeights, OpacityWeighsAgainstTheTarget) {
  const Mask mask = random_mask({2, 2, 15, 15}, 0.8, 28);
  const Raster<Rgba> target = noise(20, 20, 29);
  const WarpedRegion source = region_for(mask, 30);
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed, BlendMode::kNone}) {
    BlendOptions options = with_mode(mode);
    const Raster<Rgba> full = cloned(target, source, mask, 0, 0, options);
    options.opacity = 0.3;
    const Raster<Rgba> partly = cloned(target, source, mask, 0, 0, options);
    for (std::size_t i = 0; i < full.values().size(); ++i)
      ASSERT_NEAR(partly.values()[i].r, 0.3 * full.values()[i].r + 0.7 * target.values()[i].r, 1e-6);
    options.opacity = 0;
    EXPECT_EQ(cloned(target, source, mask, 0, 0, options), target);
  }
}

TEST(CloneWeights, SourceAlphaWeighsThePaste) {
  const Mask mask = rect_mask({2, 2, 10, 10});
  const Raster<Rgba> target = noise(14, 14, 31);
  const WarpedRegion opaque = region_for(mask, 32);
  const Raster<Rgba> full = cloned(target, opaque, mask, 0, 0, {});
  // Translucent inside only: the membrane sees the ring alone.
  WarpedRegion source = opaque;
  for (int y = 1; y < 11; ++y)
    for (int x = 1; x < 11; ++x)
      source.pixels.at(x, y).a = x < 6 ? 0.0F : 0.75F;
  const Raster<Rgba> got = cloned(target, source, mask, 0, 0, {});
  for (int y = 2; y < 12; ++y)
    for (int x = 2; x < 12; ++x) {
      const double a = x < 7 ? 0 : 0.75;
      ASSERT_NEAR(got.at(x, y).r, a * full.at(x, y).r + (1 - a) * target.at(x, y).r, 1e-6);
      ASSERT_EQ(got.at(x, y).a, 1);
    }
  // In mixed the inside has a say too, but not what is hidden there.
  WarpedRegion repainted = source;
  for (Rgba& p : repainted.pixels.values())
    if (p.a == 0) p = {9, -9, 9, 0};
  const BlendOptions mixed = with_mode(BlendMode::kMixed);
  EXPECT_LT(difference_levels(cloned(target, source, mask, 0, 0, mixed), cloned(target, repainted, mask, 0, 0, mixed)),
            1e-4);
  // A cut-out has nothing round it to match: it is pasted as it is, whatever its hidden colours are.
  for (int i = 0; i < 12; ++i)
    for (Rgba* p :
         {&source.pixels.at(i, 0), &source.pixels.at(i, 11), &source.pixels.at(0, i), &source.pixels.at(11, i)})
      *p = {100, -100, 5, 0};
  Raster<Rgba> pasted = target;
  ASSERT_TRUE(paste_into(pasted, source, mask, 0, 0).ok());
  EXPECT_LT(difference_levels(cloned(target, source, mask, 0, 0, {}), pasted), 1e-4);
}

TEST(CloneWeights, ATranslucentTargetIsLaidOver) {
  const Mask mask = rect_mask({2, 2, 8, 8});
  const WarpedRegion source = region_for(mask, 33);
  Raster<Rgba> target = noise(12, 12, 34);
  for (Rgba& p : target.values())
    p.a = 0;
  // Nothing there: nothing to match, the source's own colours, opaque.
  const Raster<Rgba> empty = cloned(target, source, mask, 0, 0, {});
  for (int y = 2; y < 10; ++y)
    for (int x = 2; x < 10; ++x) {
      ASSERT_EQ(empty.at(x, y).a, 1);
      ASSERT_NEAR(empty.at(x, y).r, source.pixels.at(x - 1, y - 1).r, 1e-6);
    }
  for (Rgba& p : target.values())
    p.a = 0.5F;
  BlendOptions options = with_mode(BlendMode::kNone);
  options.opacity = 0.5;
  const Raster<Rgba> half = cloned(target, source, mask, 0, 0, options);
  const float top = source.pixels.at(4, 4).g, bottom = target.at(5, 5).g;
  EXPECT_NEAR(half.at(5, 5).a, 0.75, 1e-6);
  EXPECT_NEAR(half.at(5, 5).g, (0.5 * top + 0.25 * bottom) / 0.75, 1e-6);
}

TEST(CloneWeights, ResultsAreNotClamped) {
  const Mask mask = rect_mask({1, 1, 1, 1});
  WarpedRegion source{{0, 0, 3, 3}, Raster<Rgba>(3, 3, Rgba{0, 0, 0, 1})};
  source.pixels.at(1, 1) = {1, -1, 1, 1};
  const Raster<Rgba> target(3, 3, Rgba{0.75F, -0.5F, 0, 1});
  EXPECT_EQ(cloned(target, source, mask, 0, 0, {}).at(1, 1), (Rgba{1.75F, -1.5F, 1, 1}));
}

} // namespace
} // namespace oversketch
