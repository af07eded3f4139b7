#include "core/mesh/region_mesh.h"

#include "core/base/check.h"
#include "core/mesh/assemble.h"
#include "core/mesh/cell_copies.h"

#include <algorithm>
#include <string>
#include <utility>

namespace oversketch {

struct RegionMesh::Data {
  CellCopies copies;
  MeshKind kind = MeshKind::kCovering;
  std::vector<bool> kept;
  std::vector<int> cell_of_copy;
  QuadMesh mesh;
  std::vector<int> boundary;
};

namespace {

Error error(const char* code, const char* sentence) {
  return {code, sentence, "cell size"};
}

ClosedCurve oriented(const ClosedCurve& outline) {
  if (outline.signed_area() > 0) return outline;
  return ClosedCurve(Points(outline.points().rbegin(), outline.points().rend()));
}

/// How far outside the unit square; inside negative.
double signed_overshoot(const CellPoint& at) {
  return std::max({-at.u, at.u - 1, -at.v, at.v - 1});
}

} // namespace

RegionMesh::RegionMesh(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

const QuadMesh& RegionMesh::mesh() const {
  return data_->mesh;
}
MeshKind RegionMesh::kind() const {
  return data_->kind;
}
const ClosedCurve& RegionMesh::outline() const {
  return data_->copies.outline;
}
const std::vector<int>& RegionMesh::boundary() const {
  return data_->boundary;
}
const CellCopies& RegionMesh::copies() const {
  return data_->copies;
}

CellPoint RegionMesh::place_in_cell(int copy, double u, double v) const {
  if (data_->kept[copy]) return {data_->cell_of_copy[copy], u, v};
  const CellCopies& c = data_->copies;
  CellPoint best{-1, 0, 0};
  for (int port = c.copies[copy].first_port; port < c.copies[copy + 1].first_port; ++port) {
    const int neighbour = c.ports[c.ports[port].twin].copy;
    if (!data_->kept[neighbour]) continue;
    const int columns = c.copies[copy].column - c.copies[neighbour].column,
              rows = c.copies[copy].row - c.copies[neighbour].row;
    const CellPoint at{data_->cell_of_copy[neighbour], u + columns, v + rows};
    if (best.cell < 0 || signed_overshoot(at) < signed_overshoot(best)) best = at;
  }
  CHECK(best.cell >= 0, "a copy that was left out has a neighbour that stayed");
  return best;
}

CellPoint RegionMesh::place(int copy, Point p) const {
  const CellCopies& c = data_->copies;
  const Point uv = (p - c.corner_of(copy)) / c.grid.cell();
  return place_in_cell(copy, uv.x, uv.y);
}

CellPoint RegionMesh::locate_outline(double s) const {
  const CellCopies& c = data_->copies;
  const double at = c.outline.wrap(s);
  return place(c.chains[c.chain_at(at)].copy, c.outline.at(at));
}

std::optional<CellPoint> RegionMesh::locate(Point p) const {
  if (!is_finite(p)) return std::nullopt;
  const CellCopies& c = data_->copies;
  if (const auto copy = c.copy_at(p)) return place(*copy, p);
  const CurvePosition nearest = c.outline.nearest(p);
  if (nearest.distance > c.grid.cell()) return std::nullopt;
  return place(c.chains[c.chain_at(nearest.s)].copy, p);
}

Result<void> check_cell_size(const ClosedCurve& outline, double cell_px) {
  if (!std::isfinite(cell_px) || cell_px <= 0)
    return error("mesh.cell", "The cell size must be a positive number of pixels.");
  const Point size = bounds(outline.points()).size();
  if (cell_px > std::max(size.x, size.y))
    return error("mesh.cell-too-large", "The cells are larger than the region; choose smaller ones.");
  return {};
}

Result<RegionMesh> make_region_mesh(const ClosedCurve& outline, double cell_px, MeshKind kind, const Watch& watch) {
  if (auto sound = check_cell_size(outline, cell_px); !sound) return sound.error();
  const Box box = bounds(outline.points());
  if (outline.signed_area() == 0)
    return Error{"mesh.not-simple", "The outline holds no area; draw it without a crossing.", "outline"};
  StageTimer timer(watch.times, "mesh");
  auto copies = cut_into_copies(oriented(outline), centred_grid(box, cell_px), watch);
  if (!copies) return copies.error();
  std::vector<bool> kept = kind == MeshKind::kTrimmed
                               ? trim(*copies)
                               : std::vector<bool>(static_cast<std::size_t>(copies->copy_count()), true);
  if (watch.stopped()) return cancelled();
  QuadMesh mesh = assemble_mesh(*copies, kept);
  if (watch.stopped()) return cancelled();
  std::vector<int> boundary = boundary_loop(*copies, kept, mesh);
  std::vector<int> cell_of_copy = number_kept(kept);
  return RegionMesh(std::make_shared<const RegionMesh::Data>(RegionMesh::Data{
      std::move(*copies), kind, std::move(kept), std::move(cell_of_copy), std::move(mesh), std::move(boundary)}));
}

} // namespace oversketch
