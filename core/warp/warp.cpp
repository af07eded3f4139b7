#include "core/warp/warp.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/warp/cell_spans.h"
#include "core/warp/nearest_covered.h"
#include "core/warp/region_painter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace oversketch {
namespace {

constexpr int kNowhere = -1;
/// Rows that one thread takes at a time.
constexpr int kBandRows = 64;

Result<Rect> region_rect(const Image& source, const Mask& mask, std::int64_t most_pixels = kMaxWarpPixels) {
  if (mask.empty()) return Error{"warp.empty-mask", "The deformed region covers no pixel: make it larger.", ""};
  if (source.empty()) return Error{"warp.empty-source", "The source picture has no pixels.", ""};
  const Rect rect = grown(mask.bounds(), 1);
  if (static_cast<std::int64_t>(rect.width) * rect.height > std::min(most_pixels, kMaxWarpPixels))
    return Error{"warp.too-large",
                 "The deformed region is " + std::to_string(rect.width) + " by " + std::to_string(rect.height) +
                     " pixels large, more than there may be memory for: make it smaller.",
                 ""};
  return rect;
}

Result<void> check_vertices(const Points& deformed) {
  for (std::size_t i = 0; i < deformed.size(); ++i) {
    const Point p = deformed[i];
    const auto where = [i] { return "mesh vertex " + std::to_string(i); };
    if (!is_finite(p)) return Error{"warp.not-finite", "The deformation gave a point that is not a number.", where()};
    if (std::abs(p.x) >= kMaskCoordinateLimit || std::abs(p.y) >= kMaskCoordinateLimit)
      return Error{"warp.too-far", "The deformed mesh reaches too far from the picture.", where()};
  }
  return {};
}

void check_mesh(const QuadMesh& mesh, const Points& deformed) {
  CHECK(mesh.vertices.size() == deformed.size(), "one deformed point for each vertex");
  for (const auto& cell : mesh.cells)
    for (const int vertex : cell)
      CHECK(vertex >= 0 && static_cast<std::size_t>(vertex) < deformed.size(), "cell names a vertex that is not there");
}

/// Draws the pixels of the grown mask, band by band, and what no cell covers at the end.
class BandedWarp {
public:
  BandedWarp(const RegionPainter& painter, const CellRaster& raster, const Mask& wanted, WarpedRegion& out)
      : painter_(painter),
        raster_(raster),
        wanted_(wanted),
        out_(out),
        bands_(static_cast<std::size_t>((out.rect.height + kBandRows - 1) / kBandRows)) {}

  int count() const { return static_cast<int>(bands_.size()); }

  /// Bands may be drawn in any order, by any thread.
  void draw(int index) {
    Band& band = bands_[static_cast<std::size_t>(index)];
    const int y0 = out_.rect.y + index * kBandRows, y1 = std::min(y0 + kBandRows, out_.rect.bottom());
    band.spans = raster_.rows(y0, y1);
    const auto row_is_before = [](int y) { return [y](const Mask::Run& run) { return run.y < y; }; };
    const auto first = std::ranges::partition_point(wanted_.runs(), row_is_before(y0));
    const auto end = std::ranges::partition_point(wanted_.runs(), row_is_before(y1));
    band.uncovered = painter_.paint(std::span(first, end), band.spans, out_);
    clear_between(std::span(first, end), y0, y1);
  }

  bool has_cells() const {
    return std::ranges::any_of(bands_, [](const Band& band) { return !band.spans.empty(); });
  }

  /// After all bands.
  void draw_uncovered() {
    for (const Band& band : bands_)
      for (const Mask::Run& run : band.uncovered)
        for (int x = run.x0; x < run.x1; ++x) {
          const Pixel near = nearest_covered({x, run.y});
          pixel(x, run.y) = painter_.paint_continued(cell_at(near), {near.x + 0.5, near.y + 0.5},
                                                     {x - near.x + 0.0, run.y - near.y + 0.0});
        }
  }

private:
  struct Band {
    CellSpans spans;
    std::vector<Mask::Run> uncovered;
  };
  struct Pixel {
    int x = 0;
    int y = 0;
  };

  /// Rows y0 ≤ y < y1 where none of the runs, which are theirs, lies.
  void clear_between(std::span<const Mask::Run> runs, int y0, int y1) {
    auto run = runs.begin();
    for (int y = y0; y < y1; ++y) {
      const std::span<Rgba> row = out_.pixels.row(y - out_.rect.y);
      auto from = row.begin();
      for (; run != runs.end() && run->y == y; ++run) {
        std::fill(from, row.begin() + (run->x0 - out_.rect.x), Rgba{0, 0, 0, 0});
        from = row.begin() + (run->x1 - out_.rect.x);
      }
      std::fill(from, row.end(), Rgba{0, 0, 0, 0});
    }
  }

  Rgba& pixel(int x, int y) { return out_.pixels.at(x - out_.rect.x, y - out_.rect.y); }

  int cell_at(Pixel p) const {
    if (!out_.rect.contains(p.x, p.y)) return kNowhere;
    const auto row = bands_[static_cast<std::size_t>((p.y - out_.rect.y) / kBandRows)].spans.row(p.y);
    const auto span = std::ranges::partition_point(row, [&](const CellSpan& s) { return s.x1 <= p.x; });
    return span != row.end() && span->x0 <= p.x ? span->cell : kNowhere;
  }

  Pixel nearest_covered(Pixel at) {
    // Nearly always a neighbour: cells reach beyond the outline.
    for (const auto& [dx, dy] : kSteps)
      if (const Pixel near{at.x + dx, at.y + dy}; cell_at(near) != kNowhere) return near;
    if (nearest_.empty()) nearest_ = find_nearest_covered(covered());
    const int index = nearest_.at(at.x - out_.rect.x, at.y - out_.rect.y);
    return {out_.rect.x + index % out_.rect.width, out_.rect.y + index / out_.rect.width};
  }

  Raster<char> covered() const {
    Raster<char> covered(out_.rect.width, out_.rect.height, 0);
    for (int y = 0; y < out_.rect.height; ++y)
      for (const CellSpan& span : bands_[static_cast<std::size_t>(y / kBandRows)].spans.row(out_.rect.y + y))
        std::fill(&covered.at(span.x0 - out_.rect.x, y), &covered.at(span.x0 - out_.rect.x, y) + (span.x1 - span.x0),
                  1);
    return covered;
  }

  const RegionPainter& painter_;
  const CellRaster& raster_;
  const Mask& wanted_;
  WarpedRegion& out_;
  std::vector<Band> bands_;
  /// Made when a pixel is found that has no covered neighbour.
  Raster<int> nearest_;
};

} // namespace

Result<WarpedRegion> warp_region(const ImagePyramid& source, const QuadMesh& mesh, const Points& deformed,
                                 const Mask& mask, const Watch& watch, const Mask* source_region,
                                 const WarpOptions& options, Raster<Rgba> spare) {
  const StageTimer timer(watch.times, "warp");
  check_mesh(mesh, deformed);
  const Result<Rect> rect = region_rect(source.image(), mask, options.most_pixels);
  if (!rect) return rect.error();
  if (const Result<void> good = check_vertices(deformed); !good) return good.error();
  if (watch.stopped()) return cancelled();

  const RegionPainter painter(source, mesh, deformed, options);
  const CellRaster raster(mesh, deformed, painter.inverses(), *rect, source_region);
  const Mask wanted = grown(mask);
  WarpedRegion out{*rect, Raster<Rgba>(rect->width, rect->height, Unset{}, std::move(spare))};
  BandedWarp warp(painter, raster, wanted, out);
  run_parallel(warp.count(), options.threads, [&](int band) {
    if (!watch.stopped()) warp.draw(band);
  });
  if (watch.stopped()) return cancelled();
  if (!warp.has_cells())
    return Error{"warp.no-cell", "The deformed mesh does not reach the region that it shall fill.", ""};
  warp.draw_uncovered();
  return out;
}

Result<WarpedRegion> unwarped_region(const Image& source, const Mask& mask) {
  const Result<Rect> rect = region_rect(source, mask);
  if (!rect) return rect.error();
  WarpedRegion out{*rect, Raster<Rgba>(rect->width, rect->height, Unset{})};
  for (int y = 0; y < rect->height; ++y) {
    const std::span<const Rgba> from = source.pixels().row(std::clamp(rect->y + y, 0, source.height() - 1));
    const std::span<Rgba> to = out.pixels.row(y);
    for (int x = 0; x < rect->width; ++x)
      to[static_cast<std::size_t>(x)] = from[static_cast<std::size_t>(std::clamp(rect->x + x, 0, source.width() - 1))];
  }
  return out;
}

Mask opaque_part(const WarpedRegion& region, const Mask& mask) {
  CHECK(region.rect.width == region.pixels.width() && region.rect.height == region.pixels.height(),
        "a region's rect and pixels have one size");
  std::vector<Mask::Run> runs;
  for (const Mask::Run& run : mask.runs()) {
    if (run.y < region.rect.y || run.y >= region.rect.bottom()) continue;
    const int end = std::min(run.x1, region.rect.right());
    for (int x = std::max(run.x0, region.rect.x); x < end; ++x) {
      if (!(region.pixels.at(x - region.rect.x, run.y - region.rect.y).a > 0)) continue;
      const int first = x;
      while (x < end && region.pixels.at(x - region.rect.x, run.y - region.rect.y).a > 0)
        ++x;
      runs.push_back({run.y, first, x});
    }
  }
  return Mask(std::move(runs));
}

} // namespace oversketch
