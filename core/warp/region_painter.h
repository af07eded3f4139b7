#pragma once

#include "core/geometry/mask.h"
#include "core/image/pyramid.h"
#include "core/image/warped_region.h"
#include "core/mesh/quad_mesh.h"
#include "core/warp/cell_inverse.h"
#include "core/warp/cell_spans.h"
#include "core/warp/minification.h"
#include "core/warp/row_kernels.h"
#include "core/warp/warp.h"

#include <vector>

namespace oversketch {

/// Colours for pixels whose cell is known: inverse maps along the rows, samples, and averages where the region is
/// shrunk.
/// @threads const after making: several threads may paint, each its own pixels.
class RegionPainter {
public:
  /// The arguments must outlive this.
  RegionPainter(const ImagePyramid& source, const QuadMesh& mesh, const Points& deformed, const WarpOptions& options);

  const std::vector<CellInverse>& inverses() const { return inverses_; }

  /// Paints runs of pixels, which lie in `out` and whose rows `spans` has; those that no span covers get an arbitrary
  /// colour.
  /// @returns those pixels.
  std::vector<Mask::Run> paint(std::span<const Mask::Run> runs, const CellSpans& spans, WarpedRegion& out) const;

  /// The colour at p + step where `cell`'s map at p is continued linearly.
  Rgba paint_continued(int cell, Point p, Point step) const;

private:
  struct Places;
  /// r, g, b, a in one register.
  using Lanes = float __attribute__((vector_size(16)));

  void paint_run(const Mask::Run& run, std::span<const CellSpan> spans, Rgba* out, Places& places,
                 std::vector<Mask::Run>& uncovered) const;
  /// Fills places [at, at + count) with those of the pixels from (x, y).
  void place(int cell, int x, int y, int at, int count, Places& places) const;
  void place_one(const CellInverse& inverse, int cell, const CellInverse::Place& place, Point source, int at,
                 Places& places) const;
  /// Pixels of stage 0.
  void clear_shrinking(int at, int count, Places& places) const;
  void sample(int count, Places& places, Rgba* out) const;
  void sample_shrunk(int count, Places& places, Rgba* out) const;
  /// Colours times alpha, and alpha.
  void sample_stage(int stage, int count, const Places& places, Lanes* out) const;

  const ImagePyramid& source_;
  const WarpOptions options_;
  const RowKernels kernels_;
  const Texture texture_;
  const Minification minification_;
  std::vector<CellInverse> inverses_;
};

} // namespace oversketch
