#include "core/clone/live.h"

#include "core/base/check.h"
#include "core/base/processor.h"
#include "core/clone/live_data.h"
#include "tests/unit/clone/clone_calls.h"

#include <gtest/gtest.h>

#include <limits>

namespace oversketch {
namespace {

constexpr BlendMode kModes[] = {BlendMode::kImport, BlendMode::kMixed, BlendMode::kMonochrome, BlendMode::kAverage,
                                BlendMode::kNone};

/// Slopes, waves and a little grain, 8 bits.
Raster<Rgba8> noise_levels(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> grain(-6, 6);
  const float wave = 0.02F + 0.01F * static_cast<float>(seed % 5);
  Raster<Rgba8> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float base = 120 + 60 * std::sin(wave * static_cast<float>(x + 2 * y)) + 0.1F * static_cast<float>(x - y);
      const auto level = [&](float by) {
        return static_cast<std::uint8_t>(std::clamp(by * base + grain(random), 0.0F, 255.0F));
      };
      out.at(x, y) = {level(1), level(0.8F), level(0.9F), 255};
    }
  return out;
}

Raster<Rgba> in_float(const Raster<Rgba8>& picture) {
  Raster<Rgba> out(picture.width(), picture.height());
  std::transform(picture.values().begin(), picture.values().end(), out.values().begin(), from_display);
  return out;
}

/// As a warp leaves it, between the levels; in steps that a packed region keeps, so that mixed gradients choose alike.
WarpedRegion source_for(const Mask& mask, unsigned seed) {
  const Rect rect = grown(mask.bounds(), 1);
  WarpedRegion out{rect, Raster<Rgba>(rect.width, rect.height)};
  const Raster<Rgba8> levels = noise_levels(rect.width, rect.height, seed);
  const auto value = [](int level, int more) { return static_cast<float>(64 * level + more) / (64 * 255); };
  for (std::size_t i = 0; i < levels.values().size(); ++i) {
    const Rgba8& p = levels.values()[i];
    out.pixels.values()[i] = {value(p.r, 19), value(p.g, 0), value(p.b, -13), 1};
  }
  return out;
}

struct Parts {
  CloneSystem system;
  LiveRegion region;
};

Parts parts_for(const Mask& mask, const WarpedRegion& source) {
  const Result<CloneSystem> system = CloneSystem::make(mask);
  EXPECT_TRUE(system.ok());
  const Result<LiveRegion> region = LiveRegion::make(source, *system);
  EXPECT_TRUE(region.ok());
  return {*system, *region};
}

Raster<Rgba8> painted(const Raster<Rgba8>& below, const Parts& parts, int dx, int dy, const BlendOptions& options,
                      CloneQuality quality = CloneQuality::kDrag, int threads = 1) {
  Raster<Rgba8> out = below;
  const Result<CloneReport> done =
      clone_live(below, out, parts.region, parts.system, dx, dy, options, quality, threads);
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : to_string(done.error()));
  return out;
}

int difference(const Raster<Rgba8>& a, const Raster<Rgba8>& b) {
  int worst = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const Rgba8 &p = a.values()[i], &q = b.values()[i];
    worst = std::max({worst, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b), std::abs(p.a - q.a)});
  }
  return worst;
}

TEST(Live, RefusesWhatCannotBePaintedAndLeavesThePictureAlone) {
  const Mask mask = disc_mask(20, 20, 9);
  const WarpedRegion source = source_for(mask, 1);
  const Parts parts = parts_for(mask, source);
  EXPECT_EQ(LiveRegion::make({{12, 11, 18, 19}, Raster<Rgba>(18, 19)}, parts.system).error().code,
            "clone.source-too-small");
  // In the mask; on its ring.
  for (const auto& [x, y] : {std::pair{20, 20}, std::pair{20, 10}}) {
    WarpedRegion broken = source;
    broken.pixels.at(x - source.rect.x, y - source.rect.y).g = std::numeric_limits<float>::infinity();
    EXPECT_EQ(LiveRegion::make(broken, parts.system).error().code, "clone.not-finite");
    EXPECT_EQ(LiveRegion::make(broken, parts.system).error().where,
              "source pixel " + std::to_string(x) + ", " + std::to_string(y));
    broken.pixels.at(x - source.rect.x, y - source.rect.y).g = -1e9F;
    EXPECT_EQ(LiveRegion::make(broken, parts.system).error().code, "clone.out-of-range");
  }
  const Raster<Rgba8> below = noise_levels(40, 40, 2);
  Raster<Rgba8> out = below;
  BlendOptions bad;
  bad.opacity = -1;
  EXPECT_EQ(clone_live(below, out, parts.region, parts.system, 0, 0, bad, CloneQuality::kDrag).error().code,
            "clone.bad-option");
  std::stop_source stop;
  stop.request_stop();
  for (const BlendMode mode : kModes)
    EXPECT_EQ(clone_live(below, out, parts.region, parts.system, 0, 0, with_mode(mode), CloneQuality::kDrag, 1,
                         Watch{stop.get_token(), {}, nullptr})
                  .error(),
              cancelled());
  EXPECT_EQ(out, below);
  Raster<Rgba8> none, small(5, 5);
  EXPECT_EQ(clone_live(none, none, parts.region, parts.system, 0, 0, {}, CloneQuality::kDrag).error().code,
            "clone.empty-target");
  EXPECT_THROW((void)clone_live(below, small, parts.region, parts.system, 0, 0, {}, CloneQuality::kDrag), BugError);
  EXPECT_THROW(
      (void)clone_live(below, out, parts.region, parts_for(mask, source).system, 0, 0, {}, CloneQuality::kDrag),
      BugError);
}

TEST(Live, IsTheBlendOfPicturesRoundedWithAnyOptions) {
  const Raster<Rgba8> below = noise_levels(90, 80, 3);
  Raster<Rgba8> glassy = below;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 90; ++x)
      glassy.at(x, y).a = static_cast<std::uint8_t>(x < 45 ? 255 : 2 * y);
  std::vector<BlendOptions> all;
  for (const BlendMode mode : kModes)
    for (const Domain domain : {Domain::kEncoded, Domain::kLinear, Domain::kLog}) {
      BlendOptions options = with_mode(mode, domain);
      all.push_back(options);
      options.strength = 0.4;
      options.opacity = 0.7;
      all.push_back(options);
      options.feather_px = 6;
      options.average = 0.2;
      all.push_back(options);
      options.strength = 0;
      options.feather_px = 0;
      all.push_back(options);
    }
  for (const Mask& mask : {disc_mask(40, 36, 30), ring_mask(20, 20, 35, 9), rect_mask({10, 9, 60, 1})}) {
    WarpedRegion source = source_for(mask, 4);
    for (const bool translucent : {false, true}) {
      if (translucent)
        for (int y = 0; y < source.rect.height; ++y)
          for (int x = 0; x < source.rect.width; ++x)
            source.pixels.at(x, y).a = x % 7 == 0 ? 0.0F : x % 5 == 0 ? 0.5F : 1.0F;
      const Parts parts = parts_for(mask, source);
      for (const Raster<Rgba8>& target : {below, glassy})
        for (const BlendOptions& options : all) {
          const Raster<Rgba8> got = painted(target, parts, 3, -2, options);
          Raster<Rgba> expected = in_float(target);
          ASSERT_TRUE(clone_into(expected, source, 3, -2, parts.system, options, CloneQuality::kDrag).ok());
          ASSERT_LE(difference(got, to_display(Image(expected))), 1)
              << to_string(options.mode) << " " << to_string(options.domain) << " " << options.strength << " "
              << options.feather_px;
        }
    }
  }
}

TEST(Live, WritesThePixelsOfTheMaskAndNoOthersOverEveryEdge) {
  const Raster<Rgba8> below = noise_levels(50, 44, 5);
  for (const Mask& mask : {disc_mask(20, 20, 17), random_mask({0, 0, 30, 30}, 0.8, 6), rect_mask({0, 0, 50, 44})}) {
    WarpedRegion source = source_for(mask, 7);
    for (Rgba& p : source.pixels.values())
      p.r += 0.5F;
    const Parts parts = parts_for(mask, source);
    for (const BlendMode mode : {BlendMode::kImport, BlendMode::kAverage})
      for (const int dx : {-29, -8, 0, 21, 43})
        for (const int dy : {-33, -5, 0, 19, 38}) {
          const Raster<Rgba8> got = painted(below, parts, dx, dy, with_mode(mode));
          Raster<Rgba> expected = in_float(below);
          ASSERT_TRUE(clone_into(expected, source, dx, dy, parts.system, with_mode(mode), CloneQuality::kDrag).ok());
          ASSERT_LE(difference(got, to_display(Image(expected))), 1) << dx << "," << dy;
          for (int y = 0; y < 44; ++y)
            for (int x = 0; x < 50; ++x)
              if (!mask.contains(x - dx, y - dy)) ASSERT_EQ(got.at(x, y), below.at(x, y));
        }
  }
}

TEST(Live, WhollyOutsideNothingIsPaintedOrPrepared) {
  const Mask mask = rect_mask({0, 0, 3000, 3000});
  const Parts parts = parts_for(mask, {grown(mask.bounds(), 1), Raster<Rgba>(3002, 3002)});
  const Raster<Rgba8> below = noise_levels(10, 10, 8);
  const int far = std::numeric_limits<int>::max(), low = std::numeric_limits<int>::min();
  for (const auto& [dx, dy] : {std::pair{10, 0}, std::pair{-3000, 0}, std::pair{far, far}, std::pair{low, far}})
    for (const BlendMode mode : kModes) {
      Raster<Rgba8> out = below;
      // With a stopped watch whatever costs would be refused.
      std::stop_source stop;
      stop.request_stop();
      const Result<CloneReport> done = clone_live(below, out, parts.region, parts.system, dx, dy, with_mode(mode),
                                                  CloneQuality::kExport, 1, Watch{stop.get_token(), {}, nullptr});
      ASSERT_TRUE(done.ok());
      EXPECT_EQ(done->changed, Rect{});
      EXPECT_EQ(out, below);
    }
}

TEST(Live, OntoItselfIsItselfToTheBit) {
  const Raster<Rgba8> picture = noise_levels(70, 60, 9);
  for (const Mask& mask : {disc_mask(30, 30, 22), rect_mask({0, 0, 70, 60}), random_mask({5, 5, 50, 50}, 0.7, 10)}) {
    const Parts parts = parts_for(mask, cut_out(in_float(picture), grown(mask.bounds(), 1)));
    for (const Domain domain : {Domain::kEncoded, Domain::kLinear, Domain::kLog})
      for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed, BlendMode::kAverage, BlendMode::kNone})
        for (const double strength : {1.0, 0.3}) {
          BlendOptions options = with_mode(mode, domain);
          options.strength = strength;
          EXPECT_EQ(painted(picture, parts, 0, 0, options), picture) << to_string(mode) << to_string(domain);
        }
  }
}

TEST(Live, IsWithinALevelOfTheExactSolution) {
  const Raster<Rgba8> below = noise_levels(330, 330, 11);
  const Mask riddled = mask_where({2, 2, 180, 180}, [](int x, int y) { return x % 5 != 0 || y % 5 != 0; });
  for (const Mask& mask : {disc_mask(150, 150, 140), snake_mask(300, 280, 40), holed_mask(260, 66, 6), riddled}) {
    const WarpedRegion source = source_for(mask, 13);
    const Parts parts = parts_for(mask, source);
    Raster<Rgba> exact = in_float(below);
    ASSERT_TRUE(clone_into(exact, source, 20, 18, parts.system, {}, CloneQuality::kExport).ok());
    EXPECT_LE(difference(painted(below, parts, 20, 18, {}, CloneQuality::kDrag), to_display(Image(exact))), 1);
    EXPECT_LE(difference(painted(below, parts, 20, 18, {}, CloneQuality::kRest), to_display(Image(exact))), 1);
    EXPECT_LE(difference(painted(below, parts, 20, 18, {}, CloneQuality::kFirst), to_display(Image(exact))), 3);
  }
}

TEST(Live, AnyNumberOfThreadsPaintsTheSameBits) {
  const Raster<Rgba8> below = noise_levels(200, 180, 14);
  for (const Mask& mask : {disc_mask(90, 90, 80), rect_mask({3, 3, 1, 1}), ring_mask(10, 10, 121, 60)}) {
    const Parts parts = parts_for(mask, source_for(mask, 15));
    for (const BlendMode mode : kModes) {
      const Raster<Rgba8> one = painted(below, parts, 1, 2, with_mode(mode));
      for (const int threads : {2, 3, 64})
        EXPECT_EQ(painted(below, parts, 1, 2, with_mode(mode), CloneQuality::kDrag, threads), one);
    }
  }
}

TEST(LiveRows, WithAndWithoutAvx2TheBitsAreTheSame) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
  std::mt19937 random(16);
  for (const Mask& mask : {disc_mask(50, 50, 45), random_mask({0, 0, 60, 60}, 0.9, 17), snake_mask(120, 90, 23)}) {
    const Parts parts = parts_for(mask, source_for(mask, 18));
    const PixelGraph& graph = parts.system.graph();
    const auto membrane = parts.system.membrane(CloneQuality::kDrag);
    ASSERT_TRUE(membrane.ok());
    // Beyond black and white, so that clamping is met too.
    std::uniform_real_distribution<float> value(-20'000, 20'000);
    std::vector<Float4> ring;
    for (std::size_t i = 0; i < graph.ring.size(); ++i)
      ring.push_back({Float4::Lanes{value(random), value(random), value(random), 0}});
    const MembraneValues values = (*membrane)->solve(ring);
    const Correction correction{*membrane, values, nullptr, 0};
    const RowPainting painting{correction, parts.region.data().pixels.data()};
    std::vector<Rgba8> plain(static_cast<std::size_t>(graph.count)), fast = plain;
    const auto rows_into = [&](std::vector<Rgba8>& out) {
      std::vector<LiveRow> rows;
      for (std::size_t run = 0; run < mask.runs().size(); ++run) {
        const int length = mask.runs()[run].x1 - mask.runs()[run].x0;
        const int skipped = static_cast<int>(run) % (length + 1), count = (length - skipped + 1) / 2;
        const auto pixel = static_cast<std::size_t>(graph.first[run] + skipped);
        if (count > 0) rows.push_back({run, mask.runs()[run].y, skipped, count, pixel, nullptr, &out[pixel]});
      }
      return rows;
    };
    paint_rows(painting, rows_into(plain));
    paint_rows_avx2(painting, rows_into(fast));
    EXPECT_EQ(plain, fast);
  }
}

/// From any pixel of a run on, beyond black and white too: g + u, rounded and clamped.
TEST(LiveRows, PaintASolutionOnThePixels) {
  std::mt19937 random(19);
  std::uniform_real_distribution<float> value(-1.5F, 1.5F);
  std::uniform_int_distribution<int> level(0, 255);
  std::vector<Mask::Run> runs;
  for (int y = 0; y < 24; ++y)
    runs.push_back({y, 0, y + 1});
  const Mask mask(runs);
  const Result<MaskMultigrid> grids = MaskMultigrid::make(mask);
  ASSERT_TRUE(grids.ok());
  const auto solve = std::make_shared<MultigridSolve>(*grids);
  const Correction correction{nullptr, {}, solve, 0};
  std::vector<LivePixel> source;
  for (int i = 0; i < mask.count(); ++i) {
    const auto units = [&] { return static_cast<std::int16_t>(64 * level(random) + 32); };
    source.push_back({units(), units(), units(), 255 * 64 + 32});
  }
  const RowPainting painting{correction, source.data()};
  std::size_t first = 0;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    std::vector<Float4> u(run + 1);
    // What the fourth number is must not matter.
    for (Float4& pixel : u)
      pixel = {Float4::Lanes{value(random), value(random), value(random), std::nanf("")}};
    solve->set_start(run, u);
    for (std::size_t skipped = 0; skipped <= run; ++skipped)
      for (std::size_t count = 1; count <= run + 1 - skipped; ++count) {
        std::vector<Rgba8> plain(count + 1, Rgba8{1, 2, 3, 4}), fast = plain;
        const auto row_into = [&](std::vector<Rgba8>& out) {
          return LiveRow{run,
                         static_cast<int>(run),
                         static_cast<int>(skipped),
                         static_cast<int>(count),
                         first + skipped,
                         nullptr,
                         out.data()};
        };
        const LiveRow row = row_into(plain);
        paint_rows(painting, std::span(&row, 1));
        if (has_avx2()) {
          const LiveRow same = row_into(fast);
          paint_rows_avx2(painting, std::span(&same, 1));
          ASSERT_EQ(plain, fast) << run << " " << skipped << " " << count;
        }
        EXPECT_EQ(plain.back(), (Rgba8{1, 2, 3, 4}));
        for (std::size_t i = 0; i < count; ++i) {
          const LivePixel& g = source[first + skipped + i];
          const auto expected = [&](std::int16_t from, float more) {
            return std::clamp(static_cast<double>(from + LivePixel::kOpaque * more) / 64, 0.0, 255.0);
          };
          EXPECT_NEAR(plain[i].r, expected(g.r, u[skipped + i][0]), 1);
          EXPECT_NEAR(plain[i].g, expected(g.g, u[skipped + i][1]), 1);
          EXPECT_NEAR(plain[i].b, expected(g.b, u[skipped + i][2]), 1);
          EXPECT_EQ(plain[i].a, 255);
        }
      }
    first += run + 1;
  }
}

} // namespace
} // namespace oversketch
