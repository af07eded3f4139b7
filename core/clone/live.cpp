#include "core/clone/live.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/base/processor.h"
#include "core/clone/correction.h"
#include "core/clone/live_blend.h"
#include "core/clone/live_data.h"
#include "core/clone/live_read.h"
#include "core/clone/paint.h"
#include "core/clone/placed_pair.h"
#include "core/clone/row_parts.h"

#include <algorithm>
#include <array>

namespace oversketch {
namespace {

using Data = LiveRegion::Data;

struct Place {
  int dx = 0;
  int dy = 0;
};

int clamp_to(int x, int shift, int size) {
  return static_cast<int>(std::clamp<std::int64_t>(static_cast<std::int64_t>(x) + shift, 0, size - 1));
}

std::vector<LiveRow> list_rows(const Raster<Rgba8>& below, Raster<Rgba8>& out, const PixelGraph& graph, Place at) {
  std::vector<LiveRow> rows;
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const TargetRun t = clip_run(below.rect(), runs[run], graph.first[run], at.dx, at.dy);
    if (t.x0 >= t.x1) continue;
    const int skipped = t.pixel - graph.first[run];
    rows.push_back({run, runs[run].y, skipped, t.length(), static_cast<std::size_t>(t.pixel), &below.at(t.x0, t.y),
                    &out.at(t.x0, t.y)});
  }
  return rows;
}

/// d on the ring, times `scale`, and the widest range of a channel.
struct RingValues {
  std::vector<Float4> values;
  double range = 0;
};

Float4 to_float(const Channels& c) {
  return {Float4::Lanes{static_cast<float>(c.v[0]), static_cast<float>(c.v[1]), static_cast<float>(c.v[2]), 0}};
}

/// As PlacedPair::difference.
Float4 difference(const Rgba& source, const Rgba8& target, const BlendOptions& options) {
  const bool monochrome = options.mode == BlendMode::kMonochrome;
  const float weight = source.a * static_cast<float>(target.a) / 255;
  if (options.domain == Domain::kEncoded && !monochrome) {
    const Float4::Lanes levels{static_cast<float>(target.r), static_cast<float>(target.g), static_cast<float>(target.b),
                               0};
    return {weight * (levels / 255 - Float4::Lanes{source.r, source.g, source.b, 0})};
  }
  const Channels values = to_domain(from_display(target), options.domain);
  return weight * to_float(values - PlacedPair::values_of(source, options.domain, monochrome));
}

RingValues ring_values(const Raster<Rgba8>& below, const Data& region, Place at, const BlendOptions& options,
                       float scale) {
  const PixelGraph& graph = region.system.graph();
  RingValues out;
  out.values.resize(graph.ring.size());
  std::array<float, 3> low{}, high{};
  const auto below_edge = [&](std::size_t i) -> const Rgba8& {
    const PixelGraph::RingEdge& edge = graph.ring[i];
    return below.at(clamp_to(edge.x, at.dx, below.width()), clamp_to(edge.y, at.dy, below.height()));
  };
  for (std::size_t i = 0; i < graph.ring.size(); ++i) {
    // Nearly every one lies in another row, and so in memory that was not read lately.
    constexpr std::size_t kFetchAhead = 24;
    if (i + kFetchAhead < graph.ring.size()) __builtin_prefetch(&below_edge(i + kFetchAhead));
    const Float4 d = difference(region.ring[i], below_edge(i), options);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = i == 0 ? d[k] : std::min(low[k], d[k]);
      high[k] = i == 0 ? d[k] : std::max(high[k], d[k]);
    }
    out.values[i] = scale * d;
  }
  for (std::size_t k = 0; k < 3; ++k)
    out.range = std::max<double>(out.range, high[k] - low[k]);
  return out;
}

/// Calls paint(part) for parts with about as many pixels each, one a thread.
template <class Paint>
void in_parts(const std::vector<LiveRow>& rows, int threads, Paint paint) {
  const auto parts = cut_rows(std::span(rows), threads, [](const LiveRow& row) { return row.count; });
  run_parallel(static_cast<int>(parts.size()), threads, [&](int i) { paint(parts[static_cast<std::size_t>(i)]); });
}

bool needs_solution(const BlendOptions& options) {
  return options.mode != BlendMode::kNone && (options.strength > 0 || options.feather_px > 0);
}

/// Whether f = g + u and nothing else.
bool is_plain(const Data& region, const BlendOptions& options) {
  return region.is_opaque && (options.mode == BlendMode::kImport || options.mode == BlendMode::kMixed) &&
         options.domain == Domain::kEncoded && options.strength == 1 && options.opacity == 1;
}

/// @returns the bound on the error, in the domain's values.
Result<double> paint_layer(const Raster<Rgba8>& below, Raster<Rgba8>& out, const Data& region, Place at,
                           const BlendOptions& options, CloneQuality quality, int threads, const Watch& watch) {
  Correction correction;
  const bool plain = is_plain(region, options);
  if (needs_solution(options)) {
    const Result<SolveWay> way = choose_way(region.system, options, quality, watch);
    if (!way) return way.error();
    if (way->on_pixels) {
      // What is mixed reads every pixel by itself.
      std::vector<Float4> ring;
      if (options.mode != BlendMode::kMixed) ring = ring_values(below, region, at, options, 1).values;
      auto solved = solve_on_pixels(ring, read_live(below, region, at.dx, at.dy, options), region.system, options, *way,
                                    threads, watch);
      if (!solved) return solved.error();
      correction = std::move(*solved);
    } else {
      const StageTimer timer(watch.times, "clone.solve");
      const RingValues ring = ring_values(below, region, at, options, plain ? LivePixel::kOpaque : 1.0F);
      correction.membrane = way->membrane;
      correction.values = correction.membrane->solve(ring.values);
      correction.error = correction.membrane->error_share() * ring.range;
    }
  }
  if (watch.stopped()) return cancelled();

  const StageTimer timer(watch.times, "clone.paint");
  const std::vector<LiveRow> rows = list_rows(below, out, region.system.graph(), at);
  if (plain) {
    const RowPainting plain_painting{correction, region.pixels.data()};
    const auto paint = has_avx2() ? paint_rows_avx2 : paint_rows;
    in_parts(rows, threads, [&](std::span<const LiveRow> part) { paint(plain_painting, part); });
    return correction.error;
  }
  const auto tables = region.tables_of(options.domain);
  BlendPainting painting{region, options, correction};
  painting.tables = tables.get();
  std::shared_ptr<const std::vector<float>> depths;
  if (options.feather_px > 0 && (options.strength < 1 || options.mode == BlendMode::kNone))
    depths = region.system.depths();
  painting.depths = depths.get();
  in_parts(rows, threads, [&](std::span<const LiveRow> part) { paint_blended(painting, part); });
  return correction.error;
}

} // namespace

Result<CloneReport> clone_live(const Raster<Rgba8>& below, Raster<Rgba8>& out, const LiveRegion& region,
                               const CloneSystem& system, int dx, int dy, const BlendOptions& options,
                               CloneQuality quality, int threads, const Watch& watch) {
  const Data& data = region.data();
  CHECK(below.rect() == out.rect(), "the layer is painted into a picture of the same size");
  CHECK(&data.system.graph() == &system.graph(), "the region was made with the system");
  CHECK(threads >= 1 && threads <= 64, "threads that paint");
  if (const Result<void> good = check_options(options); !good) return good.error();
  if (below.empty()) return Error{"clone.empty-target", "The target picture has no pixels.", ""};
  CloneReport report{system.mask().count(), 0, painted_rect(below.rect(), system.mask(), dx, dy)};
  if (report.changed.empty()) return report;
  const Result<double> error = paint_layer(below, out, data, {dx, dy}, options, quality, threads, watch);
  if (!error) return error.error();
  report.residual_levels = 255 * *error * largest_slope(options.domain, 1);
  return report;
}

} // namespace oversketch
