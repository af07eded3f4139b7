// Masks, pictures and blend options into cloning.

#include "core/clone/clone.h"
#include "core/clone/live.h"

#include "tests/fuzz/fuzz.h"

#include <cmath>
#include <vector>

namespace oversketch::fuzz {
namespace {

constexpr int kSide = 40;

/// Runs, a polygon, or both.
Mask read_mask(Input& in) {
  std::vector<Mask::Run> runs;
  const int kind = in.below(3);
  if (kind != 0)
    for (int i = 1 + in.below(40); i > 0; --i) {
      const int y = in.below(kSide), x = in.below(kSide);
      runs.push_back({y, x, x + 1 + in.below(12)});
    }
  if (kind != 1) {
    Points polygon;
    for (int i = 3 + in.below(12); i > 0; --i)
      polygon.push_back({in.fine(0, kSide), in.fine(0, kSide)});
    const Mask inside = rasterize_polygon(polygon, {0, 0, kSide, kSide});
    runs.insert(runs.end(), inside.runs().begin(), inside.runs().end());
  }
  return Mask(std::move(runs));
}

/// Smooth, noisy, plain, or with values and alpha beyond what files hold.
Raster<Rgba> read_pixels(Input& in, int width, int height) {
  const int kind = in.below(4), seed = in.byte();
  const Rgba plain{static_cast<float>(in.real(-1, 2)), static_cast<float>(in.real(0, 1)), 0.5f, 1};
  const float alpha = static_cast<float>(in.real(0, 1));
  Raster<Rgba> pixels = striped_image(width, height, seed % 3).pixels();
  std::uint32_t noise = static_cast<std::uint32_t>(seed) + 1;
  for (Rgba& p : pixels.values()) {
    noise = noise * 1664525u + 1013904223u;
    if (kind == 1) p.r = static_cast<float>(noise >> 24) / 255.0f;
    if (kind == 2) p = plain;
    if (kind == 3) p.g = static_cast<float>(noise >> 20) / 1000.0f - 1, p.a = alpha;
  }
  return pixels;
}

BlendOptions read_options(Input& in) {
  BlendOptions options;
  options.mode = static_cast<BlendMode>(in.below(5));
  options.domain = static_cast<Domain>(in.below(3));
  if (in.chance()) options.strength = in.real(0, 1);
  if (in.chance()) options.feather_px = in.real(0, 30);
  if (in.chance()) options.opacity = in.real(0, 1);
  if (in.chance()) options.screening = screening_for(in.real(0, 50));
  if (in.chance()) options.average = in.real(0, 1);
  return options;
}

bool is_number(const Rgba& p) {
  return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.a);
}

void blend_live(const Raster<Rgba>& target, const WarpedRegion& source, int dx, int dy, const CloneSystem& system,
                const BlendOptions& options, CloneQuality quality) {
  Raster<Rgba8> below(target.width(), target.height());
  for (int y = 0; y < target.height(); ++y)
    for (int x = 0; x < target.width(); ++x)
      below.at(x, y) = {static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(3 * y), 90, 255};
  const auto region = LiveRegion::make(source, system);
  if (!region) return;
  Raster<Rgba8> one = below, two = below;
  const auto done = clone_live(below, one, *region, system, dx, dy, options, quality, 1);
  const auto again = clone_live(below, two, *region, system, dx, dy, options, quality, 3);
  MUST_HOLD(done.ok() == again.ok(), "the same answer with any number of threads");
  const Mask placed = translated(system.mask(), dx, dy);
  for (int y = 0; y < one.height(); ++y)
    for (int x = 0; x < one.width(); ++x) {
      MUST_HOLD(one.at(x, y) == two.at(x, y), "the same bits with any number of threads");
      MUST_HOLD(placed.contains(x, y) || one.at(x, y) == below.at(x, y), "outside the mask nothing changes");
    }
}

void run(Input in) {
  const Mask mask = read_mask(in);
  const auto system = CloneSystem::make(mask);
  if (!system) {
    MUST_HOLD(mask.empty(), "only an empty mask is refused");
    return;
  }
  const Rect bounds = mask.bounds();
  WarpedRegion source;
  source.rect = {bounds.x - 1, bounds.y - 1, bounds.width + 2, bounds.height + 2};
  source.pixels = read_pixels(in, source.rect.width, source.rect.height);
  Raster<Rgba> target = read_pixels(in, 1 + in.below(48), 1 + in.below(48));
  const BlendOptions options = read_options(in);
  const int dx = in.below(61) - 30, dy = in.below(61) - 30;
  const auto quality = static_cast<CloneQuality>(in.below(4));

  const Raster<Rgba> before = target;
  const auto done = clone_into(target, source, dx, dy, *system, options, quality);
  MUST_HOLD(done.ok() || target == before, "after an error the target is as before");
  const Mask placed = translated(mask, dx, dy);
  for (int y = 0; y < target.height(); ++y)
    for (int x = 0; x < target.width(); ++x) {
      MUST_HOLD(placed.contains(x, y) || target.at(x, y) == before.at(x, y), "outside the mask nothing changes");
      MUST_HOLD(is_number(target.at(x, y)), "results are numbers");
    }
  if (done) MUST_HOLD(done->unknowns == mask.count(), "as many unknowns as pixels");
  if (in.chance()) blend_live(before, source, dx, dy, *system, options, quality);
}

} // namespace
} // namespace oversketch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  oversketch::fuzz::run({data, size});
  return 0;
}
