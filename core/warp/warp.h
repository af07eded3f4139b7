#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/geometry/mask.h"
#include "core/geometry/point.h"
#include "core/image/image.h"
#include "core/image/pyramid.h"
#include "core/image/warped_region.h"
#include "core/mesh/quad_mesh.h"
#include "core/warp/row_kernels.h"

namespace oversketch {

/// How a warp reads the source.
enum class Sampling {
  /// From the nearest 2 × 2 pixels.
  kBilinear,
  /// From the nearest 4 × 4 pixels (Catmull–Rom): sharper; overshoots beside steep edges, see BicubicTaps.
  kBicubic,
};

/// None of them but `sampling` changes the result by a bit.
/// Largest rect that is drawn, pixels (16 bytes each).
inline constexpr std::int64_t kMaxWarpPixels = 200'000'000;

struct WarpOptions {
  Sampling sampling = Sampling::kBilinear;
  /// How many threads may draw; 1 or less: the calling one alone.
  int threads = 1;
  Simd simd = Simd::kBest;
  /// Largest rect that is drawn; never more than kMaxWarpPixels.
  std::int64_t most_pixels = kMaxWarpPixels;
};

/// Draws a deformed mesh: texture mapping of `source` into the pixels of `mask`, each of them once.
///
/// A pixel that a cell covers takes the source point whose bilinear image in that cell is the pixel's centre (the
/// inverse bilinear map, continuous across cells; a cell that is not convex is two triangles with affine maps).  Cells
/// are filled by a top-left rule on vertices rounded to 2⁻¹⁰ px, in integers: cells that share an edge share no pixel
/// and leave none out.  Where cells overlap, the one whose source point lies in `source_region` wins, and among equals
/// the later cell. A pixel that no cell covers takes the coordinate that the nearest covered pixel's cell gives when it
/// is continued linearly.
///
/// Source points are rounded to 2⁻²⁰ px (so that an identity is exact to the bit) and the source is sampled there,
/// once: pixel centres at (0.5, 0.5), edge pixels repeated outside, colours weighed by alpha, so that what is hidden
/// under alpha 0 does not bleed.  Where the mesh shrinks the source by more than 1.5, averages over a pixel's reach
/// take the place of the sample, gradually, and nothing aliases: see Minification.  Elsewhere the pyramid is not
/// touched.
///
/// @param source         picture that the mesh's own vertices refer to, source pixels.  Keep the pyramid where one
///   picture is warped again and again: levels that are made stay.
/// @param mesh           cells; `mesh.vertices` in source pixels.
/// @param deformed       where each vertex went, pixels of the mask; as many as `mesh.vertices` (CHECK).
/// @param mask           pixels wanted.
/// @param source_region  the region in the source, or null: settles overlaps of a mesh whose parts come near each
/// other, where one part's margin would hide another part's inside.
/// @param spare          a raster that is not needed any more: the result is drawn into its memory where it fits.
/// @returns rect = mask.bounds() grown by 1; the mask's pixels and their eight neighbours are drawn, all others are
///   {0, 0, 0, 0}.
/// @errors warp.empty-mask; warp.empty-source; warp.too-large (more than options.most_pixels in the rect);
///   warp.not-finite and warp.too-far (a vertex that is not a number, or at kMaskCoordinateLimit or beyond);
///   warp.no-cell (no cell covers any pixel of the rect); cancelled.
/// @cost on one busy core at 16-px quads, into the memory of `spare` (without it 2 to 4 ns more), ns a pixel: bilinear
/// 8 with AVX2 and 11 without, bicubic 13 and 19, shrunk to a third 45; 10, 14, 14, 19 and 45 where source and region
/// do not fit the second cache.  A source with alpha throughout: bilinear 26 to 30, bicubic 95.  16 bytes a pixel of
/// the rect, and 12 bytes a row of each cell.
/// @threads safe: reads its arguments, keeps nothing.
Result<WarpedRegion> warp_region(const ImagePyramid& source, const QuadMesh& mesh, const Points& deformed,
                                 const Mask& mask, const Watch& watch = {}, const Mask* source_region = nullptr,
                                 const WarpOptions& options = {}, Raster<Rgba> spare = {});

/// The picture as it stands under a mask, with the same rect as warp_region's: edge pixels repeated outside.
/// @errors warp.empty-mask, warp.empty-source, warp.too-large.
Result<WarpedRegion> unwarped_region(const Image& source, const Mask& mask);

/// The mask's pixels where the region has alpha above 0.  Pixels outside the region's rect have none.
Mask opaque_part(const WarpedRegion& region, const Mask& mask);

} // namespace oversketch
