#pragma once

#include "core/base/rect.h"
#include "core/geometry/mask.h"
#include "core/geometry/point.h"
#include "core/image/raster.h"
#include "core/mesh/quad_mesh.h"

namespace oversketch {

/// In a cell map: no cell covers the pixel.
inline constexpr int kNoCell = -1;

/// Which cell is drawn at each pixel of `rect`.
///
/// A pixel belongs to a cell when its centre lies inside the cell's four straight sides by the even-odd rule, in
/// integers on vertices rounded to 2⁻¹⁰ px; a centre on a side belongs to the cell on its right (below, on a horizontal
/// side). Cells that share a side therefore share no pixel and leave none out, whichever way they are turned.
///
/// Where cells overlap: one whose source point lies in `source_region` (if not null) before one whose does not, then
/// the later one.
/// @param deformed  finite and |coordinates| < kMaskCoordinateLimit (CHECK).
Raster<int> map_cells(const QuadMesh& mesh, const Points& deformed, const Rect& rect,
                      const Mask* source_region = nullptr);

/// For every pixel the index (y · width + x) of a covered pixel near it: itself when it is covered, else one reached in
/// the fewest steps to neighbours (eight, straight ones first).  All kNoCell when no pixel is covered.
/// @cost O(pixels), about 30 ns each that is not covered.
Raster<int> find_nearest_covered(const Raster<int>& cells);

} // namespace oversketch
