#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/geometry/curve.h"
#include "core/mesh/quad_mesh.h"

#include <memory>
#include <optional>
#include <vector>

namespace oversketch {

struct CellCopies;

/// Which copies of grid cells a RegionMesh keeps.
enum class MeshKind {
  /// Every copy that the region touches, however little: nothing of the region lies outside the mesh.
  kCovering,
  /// A copy covered by less than half is left out when a neighbour across an edge is covered by at least half and what
  /// stays is still a disc: the boundary follows the outline without bias, and thin limbs stay.
  kTrimmed,
};

/// A quad mesh of a region by virtual nodes (design note "deformation", section 3.1): whole square cells of a regular
/// grid, as many copies of a cell as the region has connected pieces in it, glued only across the parts of cell edges
/// that lie in the region.  Two arms of the region that run through one cell have a copy each and share no vertex.
///
/// The grid is axis-aligned and centred on the outline's bounding box.  The outline is clipped against it exactly:
/// every decision (which side of a grid corner, which of two crossings comes first on a grid line) is the sign of an
/// orientation determinant that never errs by rounding, and a grid line counts as lying an infinitesimal step before
/// its coordinate, so that an outline may run along grid lines and through grid corners.
///
/// The mesh is contractible (connected, vertices − edges + cells = 1) and its boundary is one closed loop.  Where the
/// gap between two arms ends inside a cell, the copies of both arms hang on the same edge of the cell that joins them:
/// such an edge has three or more cells, and the loop passes its ends more than once.
///
/// Immutable; copies share everything.
/// @threads safe to read from several threads.
class RegionMesh {
public:
  const QuadMesh& mesh() const;
  MeshKind kind() const;
  /// The region's outline, with positive signed area: the caller's curve, or the same points in reverse order.
  const ClosedCurve& outline() const;
  /// Vertices of the boundary, each joined to the next (and the last to the first) by an edge, in the outline's
  /// direction. A vertex may occur more than once (see above), never twice in a row.
  const std::vector<int>& boundary() const;

  /// The point outline().at(s), in the copy that holds that part of the outline; s as in outline(), any real number.
  /// u, v lie within 0…1 up to rounding.  In a kTrimmed mesh a part of the outline in a removed copy is given in the
  /// nearest neighbour (across an edge) that stayed, with u, v within −1…2: bilinear extrapolation.
  /// @cost O(log n).
  CellPoint locate_outline(double s) const;

  /// A point of the region, in the copy that holds it; a point outside, at most one cell from the outline, in the copy
  /// that holds the nearest point of the outline (then u, v within −2…3); none further away.
  /// @cost O(log n + outline segments in the cell) inside; that of ClosedCurve::nearest outside.
  std::optional<CellPoint> locate(Point p) const;

  /// How cells, copies and outline lie to each other, and a point of a given copy (in a kTrimmed mesh that lacks the
  /// copy: in the nearest neighbour that stayed); for building what nests in this mesh.
  const CellCopies& copies() const;
  /// @param u, v  in the copy's own cell; what is returned may name a neighbour.
  CellPoint place_in_cell(int copy, double u, double v) const;

  struct Data;
  explicit RegionMesh(std::shared_ptr<const Data> data);

private:
  CellPoint place(int copy, Point p) const;

  std::shared_ptr<const Data> data_;
};

/// Whether cells of that size suit a region.
/// @errors mesh.cell (not finite, or not positive); mesh.cell-too-large (larger than the longer side of the outline's
/// box).
Result<void> check_cell_size(const ClosedCurve& outline, double cell_px);

/// Meshes the inside of `outline`.
///
/// @param outline  simple (as check_closed_curve wants it), either orientation; source pixels.
/// @param cell_px  side of a cell, px; at most the longer side of the outline's bounding box.
/// @returns the mesh; coverage is the exact area of each copy's piece of the region, as a part of the cell's (0 only
/// where
///   the outline runs along a grid line).  Cells and vertices are in row order, independent of where the outline
///   starts.
/// @errors mesh.cell (not finite, or not positive); mesh.cell-too-large; mesh.too-many-vertices (more than 1,000,000,
/// known
///   before they are made; or the outline crosses grid lines more than 4,000,000 times); mesh.not-simple (the outline
///   crosses or touches itself, as far as the mesh depends on it); cancelled.
/// @cost linear in cells and outline points, plus sorting the crossings of outline and grid.
Result<RegionMesh> make_region_mesh(const ClosedCurve& outline, double cell_px, MeshKind kind, const Watch& watch = {});

} // namespace oversketch
