#include "core/warp/warp.h"

#include "core/base/check.h"
#include "core/warp/cell_inverse.h"
#include "core/warp/cell_map.h"
#include "core/warp/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace oversketch {
namespace {

constexpr int kChunk = BilinearSampler::kMostAtOnce;

Mask with_neighbours(const Mask& mask) {
  std::vector<Mask::Run> runs;
  runs.reserve(3 * mask.runs().size());
  for (const Mask::Run& run : mask.runs())
    for (int dy = -1; dy <= 1; ++dy)
      runs.push_back({run.y + dy, run.x0 - 1, run.x1 + 1});
  return Mask(std::move(runs));
}

Result<Rect> region_rect(const Image& source, const Mask& mask) {
  if (mask.empty()) return Error{"warp.empty-mask", "The deformed region covers no pixel: make it larger.", ""};
  if (source.empty()) return Error{"warp.empty-source", "The source picture has no pixels.", ""};
  const Rect rect = grown(mask.bounds(), 1);
  if (static_cast<std::int64_t>(rect.width) * rect.height > kMaxWarpPixels)
    return Error{"warp.too-large", "The deformed region is too large to be drawn: make it smaller.", ""};
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

/// Draws the pixels of the grown mask from a cell map of the region's rect.
class RegionPainter {
public:
  RegionPainter(const Image& source, const QuadMesh& mesh, const Points& deformed, const Raster<int>& cells,
                WarpedRegion& out)
      : sample_(source.pixels()), cells_(cells), out_(out) {
    inverses_.reserve(mesh.cells.size());
    for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
      inverses_.emplace_back(mesh, deformed, cell);
  }

  /// Uncovered pixels get an arbitrary colour; returns whether there were any.
  bool paint_covered(const Mask::Run& run) {
    bool all = true;
    for (int x = run.x0; x < run.x1; x += kChunk)
      all &= paint_chunk(x, std::min(run.x1, x + kChunk), run.y);
    return !all;
  }

  void paint_uncovered(const Mask::Run& run) {
    for (int x = run.x0; x < run.x1; ++x) {
      const Pixel at{x - out_.rect.x, run.y - out_.rect.y};
      if (cells_.at(at.x, at.y) != kNoCell) continue;
      const Pixel near = nearest_covered(at);
      const CellInverse& inverse = inverses_[static_cast<std::size_t>(cells_.at(near.x, near.y))];
      const Point from{out_.rect.x + near.x + 0.5, out_.rect.y + near.y + 0.5};
      const Point source = inverse.continued(from, {at.x - near.x + 0.0, at.y - near.y + 0.0});
      out_.pixels.at(at.x, at.y) = sample_(source.x, source.y);
    }
  }

private:
  /// Within the rect.
  struct Pixel {
    int x = 0;
    int y = 0;
  };

  Pixel nearest_covered(Pixel at) {
    // Nearly always a neighbour: cells reach beyond the outline.
    constexpr std::array<std::pair<int, int>, 8> kSteps = {
        {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    for (const auto& [dx, dy] : kSteps)
      if (cells_.rect().contains(at.x + dx, at.y + dy) && cells_.at(at.x + dx, at.y + dy) != kNoCell)
        return {at.x + dx, at.y + dy};
    if (nearest_.empty()) nearest_ = find_nearest_covered(cells_);
    const int index = nearest_.at(at.x, at.y);
    return {index % out_.rect.width, index / out_.rect.width};
  }

  bool paint_chunk(int x0, int x1, int y) {
    std::array<double, kChunk> source_x, source_y;
    const int* const cells = &cells_.at(x0 - out_.rect.x, y - out_.rect.y);
    const int count = x1 - x0;
    bool all = true;
    for (int i = 0, end = 0; i < count; i = end) {
      while (end < count && cells[end] == cells[i])
        ++end;
      const auto at = static_cast<std::size_t>(i);
      if (cells[i] == kNoCell) {
        all = false;
        std::fill_n(&source_x[at], end - i, 0.0);
        std::fill_n(&source_y[at], end - i, 0.0);
      } else {
        inverses_[static_cast<std::size_t>(cells[i])].map_row(x0 + i, y, end - i, &source_x[at], &source_y[at]);
      }
    }
    sample_.sample_row(count, source_x.data(), source_y.data(), &out_.pixels.at(x0 - out_.rect.x, y - out_.rect.y));
    return all;
  }

  BilinearSampler sample_;
  std::vector<CellInverse> inverses_;
  const Raster<int>& cells_;
  WarpedRegion& out_;
  /// Made when a pixel is found that has no covered neighbour.
  Raster<int> nearest_;
};

} // namespace

Result<WarpedRegion> warp_region(const Image& source, const QuadMesh& mesh, const Points& deformed, const Mask& mask,
                                 const Watch& watch, const Mask* source_region) {
  const StageTimer timer(watch.times, "warp");
  check_mesh(mesh, deformed);
  const Result<Rect> rect = region_rect(source, mask);
  if (!rect) return rect.error();
  if (const Result<void> good = check_vertices(deformed); !good) return good.error();
  if (watch.stopped()) return cancelled();
  const Raster<int> cells = map_cells(mesh, deformed, *rect, source_region);
  if (std::ranges::all_of(cells.values(), [](int cell) { return cell == kNoCell; }))
    return Error{"warp.no-cell", "The deformed mesh does not reach the region that it shall fill.", ""};
  if (watch.stopped()) return cancelled();

  WarpedRegion out{*rect, Raster<Rgba>(rect->width, rect->height, Rgba{0, 0, 0, 0})};
  RegionPainter painter(source, mesh, deformed, cells, out);
  const Mask wanted = with_neighbours(mask);
  std::vector<Mask::Run> unfinished;
  for (const Mask::Run& run : wanted.runs())
    if (painter.paint_covered(run)) unfinished.push_back(run);
  if (watch.stopped()) return cancelled();
  for (const Mask::Run& run : unfinished)
    painter.paint_uncovered(run);
  return out;
}

Result<WarpedRegion> unwarped_region(const Image& source, const Mask& mask) {
  const Result<Rect> rect = region_rect(source, mask);
  if (!rect) return rect.error();
  WarpedRegion out{*rect, Raster<Rgba>(rect->width, rect->height)};
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
