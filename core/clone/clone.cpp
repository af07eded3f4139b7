#include "core/clone/clone.h"

#include "core/base/check.h"
#include "core/clone/correction.h"
#include "core/clone/paint.h"
#include "core/clone/pixel_check.h"
#include "core/clone/placed_pair.h"

#include <string>

namespace oversketch {
namespace {

/// Of a solution on the pixels; more hardly pays beside the memory's speed.
constexpr int kMostThreads = 2;

/// @param is_good  of a pixel: is_blendable or is_number.
template <class IsGood>
Result<void> check_pixel(const PlacedPair& pair, int x, int y, IsGood is_good) {
  if (const Rgba& pixel = pair.source_pixel(x, y); !is_good(pixel)) return refuse_pixel("source", pixel, x, y);
  if (const Rgba& pixel = pair.target_pixel(x, y); !is_good(pixel))
    return refuse_pixel("target", pixel, pair.target_x(x), pair.target_y(y));
  return {};
}

template <class IsGood>
Result<void> check_inside(const PlacedPair& pair, const Mask& mask, IsGood is_good) {
  for (const Mask::Run& run : mask.runs()) {
    bool good = true;
    for (int x = run.x0; x < run.x1; ++x)
      good &= is_good(pair.source_pixel(x, run.y)) && is_good(pair.target_pixel(x, run.y));
    if (good) continue;
    for (int x = run.x0; x < run.x1; ++x)
      if (const Result<void> one = check_pixel(pair, x, run.y, is_good); !one) return one.error();
  }
  return {};
}

Result<void> check_ring(const PlacedPair& pair, const PixelGraph& graph) {
  for (const PixelGraph::RingEdge& edge : graph.ring)
    if (const auto good = check_pixel(pair, edge.x, edge.y, [](const Rgba& p) { return is_blendable(p); }); !good)
      return good.error();
  return {};
}

/// Everything that can be said before a pixel is read.  @param margin  pixels of source wanted round the mask.
Result<void> check_call(const Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask,
                        const BlendOptions& options, int margin) {
  CHECK(source.rect.width == source.pixels.width() && source.rect.height == source.pixels.height(),
        "a region's rect and pixels have one size");
  if (const Result<void> good = check_options(options); !good) return good.error();
  if (target.empty()) return Error{"clone.empty-target", "The target picture has no pixels.", ""};
  const Rect needed = grown(mask.bounds(), margin);
  if (!mask.empty() && intersect(needed, source.rect) != needed)
    return Error{"clone.source-too-small",
                 "The source picture must cover the whole mask and " + std::to_string(margin) + " pixel round it.", ""};
  return {};
}

bool needs_solution(const BlendOptions& options) {
  return options.mode != BlendMode::kNone && (options.strength > 0 || options.feather_px > 0);
}

/// Import and mixed without any of the correction are the source as it is: its bits need not pass through a domain.
BlendOptions without_detours(BlendOptions options) {
  const bool plain = options.mode == BlendMode::kImport || options.mode == BlendMode::kMixed;
  if (plain && !needs_solution(options)) options.mode = BlendMode::kNone;
  return options;
}

} // namespace

Result<CloneReport> clone_into(Raster<Rgba>& target, const WarpedRegion& source, int dx, int dy,
                               const CloneSystem& system, const BlendOptions& given, CloneQuality quality,
                               const Watch& watch) {
  const Mask& mask = system.mask();
  if (given.mode == BlendMode::kNone) return paste_into(target, source, mask, dx, dy, given, watch);
  if (const Result<void> good = check_call(target, source, mask, given, 1); !good) return good.error();
  const BlendOptions options = without_detours(given);
  const PlacedPair pair(target, source, dx, dy, options);
  CloneReport report{mask.count(), 0, painted_rect(target.rect(), mask, dx, dy)};
  if (report.changed.empty()) return report;
  if (const auto good = check_inside(pair, mask, [](const Rgba& p) { return is_blendable(p); }); !good)
    return good.error();
  if (const Result<void> good = check_ring(pair, system.graph()); !good) return good.error();

  Correction correction;
  if (needs_solution(options)) {
    Result<Correction> solved =
        solve_correction(pair, system, options, quality, watch.threads_up_to(kMostThreads), watch);
    if (!solved) return solved.error();
    correction = std::move(*solved);
  }
  const StageTimer timer(watch.times, "clone.paint");
  const Painting painting{pair, system.graph(), options, &correction};
  // Where errors grow with the values, results above white ask for more than could be known before they were there.
  const Refine refine = [&](double largest) -> Result<bool> {
    const double slope = largest_slope(options.domain, largest);
    if (quality != CloneQuality::kExport || !correction.pixels || slope <= largest_slope(options.domain, 1))
      return false;
    const double error = kExportLevels / 255 / slope;
    if (correction.error <= error) return false;
    if (const auto done = correction.refine(error, watch); !done) return done.error();
    return true;
  };
  const Result<double> largest = paint(target, painting, dx, dy, watch, refine);
  if (!largest) return largest.error();
  report.residual_levels = 255 * correction.error * largest_slope(options.domain, *largest);
  return report;
}

Result<CloneReport> paste_into(Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask, int dx, int dy,
                               const BlendOptions& given, const Watch& watch) {
  BlendOptions options = given;
  options.mode = BlendMode::kNone;
  if (const Result<void> good = check_call(target, source, mask, options, 0); !good) return good.error();
  const PlacedPair pair(target, source, dx, dy, options);
  const CloneReport report{mask.count(), 0, painted_rect(target.rect(), mask, dx, dy)};
  if (report.changed.empty()) return report;
  if (const auto good = check_inside(pair, mask, [](const Rgba& p) { return is_number(p); }); !good)
    return good.error();
  const StageTimer timer(watch.times, "clone.paint");
  const PixelGraph graph(mask);
  const Result<double> largest = paint(target, {pair, graph, options, nullptr}, dx, dy, watch);
  if (!largest) return largest.error();
  return report;
}

} // namespace oversketch
