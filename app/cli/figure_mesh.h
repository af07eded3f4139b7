#pragma once

#include "app/cli/figure_canvas.h"

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/mesh/quad_mesh.h"

#include <vector>

namespace oversketch::cli {

/// From the pixels of curves and photographs to those of a figure.
struct View {
  double scale = 1;
  Point offset;
  /// y is turned upwards, as curves are plotted.
  bool upwards = false;

  Point operator()(Point p) const { return scale * Point{p.x, upwards ? -p.y : p.y} + offset; }
  Points operator()(const Points& points) const;
};

/// The view at that scale with the middle of `content` at `centre`.
View centred(const Box& content, double scale, Point centre, bool upwards = false);

/// A region, deformed or not.
struct RegionPicture {
  const QuadMesh* mesh = nullptr;
  /// Where the mesh's vertices are.
  Points positions;
  /// The closed polygon whose inside is shown.
  Points boundary;
  /// The region's outline in the source.
  Points outline;
};

/// Draws the region's inside with a chessboard of squares of `square` source px, centred on the outline's box, and
/// lines halfway between; deformed cells that are flipped in red.
/// @errors those of warp_region().
Result<void> draw_checked(Canvas& canvas, const RegionPicture& region, const View& view, double square,
                          const Watch& watch);

/// The same with the photograph that the mesh lies in, and no mark of flipped cells.  Not upwards (CHECK).
Result<void> draw_photographed(Canvas& canvas, const RegionPicture& region, const View& view, const Image& photograph,
                               const Watch& watch);

/// The mesh's edges; flipped cells in red where `flips`.
void draw_wires(Canvas& canvas, const QuadMesh& mesh, const Points& positions, const View& view, double width,
                Rgba color, bool flips);

/// Cells with det J ≤ 0 at a corner, as measure_distortion() counts them.
std::vector<int> find_flipped(const QuadMesh& mesh, const Points& positions);

} // namespace oversketch::cli
