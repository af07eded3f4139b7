#pragma once

#include "core/base/rect.h"
#include "core/geometry/mask.h"
#include "core/mesh/quad_mesh.h"
#include "core/warp/cell_inverse.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace oversketch {

/// Pixels x0 ≤ x < x1 of a row that one cell draws.
struct CellSpan {
  int x0 = 0;
  int x1 = 0;
  int cell = 0;
};

/// Which cell is drawn at each pixel of some rows: for each row its spans from left to right, none overlapping.
class CellSpans {
public:
  std::span<const CellSpan> row(int y) const {
    const auto at = static_cast<std::size_t>(y - first_row_);
    return std::span(spans_).subspan(ends_[at], ends_[at + 1] - ends_[at]);
  }
  /// No cell covers any pixel.
  bool empty() const { return spans_.empty(); }

private:
  friend class CellRaster;
  int first_row_ = 0;
  /// Row i's spans are [ends_[i], ends_[i + 1]).
  std::vector<std::size_t> ends_;
  std::vector<CellSpan> spans_;
};

/// Finds the spans of a deformed mesh.
///
/// A pixel belongs to a cell when its centre lies inside the cell's four straight sides by the even-odd rule, in
/// integers on vertices rounded to 2⁻¹⁰ px; a centre on a side belongs to the cell on its right (below, on a horizontal
/// side). Cells that share a side therefore share no pixel and leave none out, whichever way they are turned.
///
/// Where cells overlap: one whose source point lies in `source_region` (if not null) before one whose does not, then
/// the later one.
///
/// @threads const after making.
class CellRaster {
public:
  /// The arguments must outlive this.
  /// @param deformed  finite and |coordinates| < kMaskCoordinateLimit (CHECK).
  /// @param inverses  one a cell.
  CellRaster(const QuadMesh& mesh, const Points& deformed, const std::vector<CellInverse>& inverses, const Rect& rect,
             const Mask* source_region);

  /// Rows y0 ≤ y < y1 of the rect.  Rows depend on nothing but themselves: however they are put together, they are the
  /// same.
  /// @cost about 5 ns a span and 1 ns a cell of the mesh.
  CellSpans rows(int y0, int y1) const;

private:
  struct FixedPoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
  };
  /// Rows first ≤ y < end that a cell reaches.
  struct Reach {
    int cell = 0;
    int first = 0;
    int end = 0;
  };
  struct Crossings;

  void sort_cells(const QuadMesh& mesh);
  void cross_rows(const Reach& reach, int y0, int y1, Crossings& crossings) const;
  /// Puts rows in order: row i's spans are [ends[i], ends[i + 1]).
  CellSpans settled(int y0, std::vector<CellSpan> spans, std::vector<std::size_t> ends) const;
  void settle_overlaps(int y, std::vector<CellSpan>& spans) const;
  bool wins(int later, int earlier, Point p) const;
  bool is_in_region(Point source) const;

  const QuadMesh& mesh_;
  const std::vector<CellInverse>& inverses_;
  const Rect rect_;
  const Mask* region_;
  std::vector<FixedPoint> vertices_;
  /// From left to right, so that the spans of a row come nearly in order.
  std::vector<Reach> reaches_;
};

} // namespace oversketch
