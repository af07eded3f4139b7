#include "core/deform/flipfree_system.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

constexpr double kVertices = 700;
/// Spacing of handles, cells.
constexpr double kHandleSpacing = 0.7;
constexpr int kFewestHandles = 12;

std::vector<Handle> sample_outline(const RegionMesh& region) {
  const double length = region.outline().length(), cell = region.mesh().cell;
  const int count = std::max(kFewestHandles, static_cast<int>(std::ceil(length / (kHandleSpacing * cell))));
  std::vector<Handle> handles;
  for (int i = 0; i < count; ++i) {
    const double s = length * i / count;
    handles.push_back({s, make_tie(region.locate_outline(s)), length / count / cell, false});
  }
  return handles;
}

} // namespace

MeshTie make_tie(const CellPoint& at) {
  const double u = at.u, v = at.v;
  return {at.cell, {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}};
}

double choose_control_cell(const ClosedCurve& outline) {
  // Cells of side h cover about area/h² + length/h·½·… : vertices n ≈ A/h² + 0.75 L/h + 1, solved for h.
  const double area = std::abs(outline.signed_area()), along = 0.75 * outline.length();
  const double side = (along + std::sqrt(along * along + 4 * kVertices * area)) / (2 * kVertices);
  const Point size = bounds(outline.points()).size();
  return std::min(side, std::max(size.x, size.y));
}

Result<FlipfreeSystem> FlipfreeSystem::make(const ClosedCurve& outline, const Watch& watch) {
  const auto mesh = make_region_mesh(outline, choose_control_cell(outline), MeshKind::kCovering, watch);
  if (!mesh) return mesh.error();
  return make(outline, *mesh, watch);
}

Result<FlipfreeSystem> FlipfreeSystem::make(const ClosedCurve& outline, const RegionMesh& mesh, const Watch& watch) {
  CHECK(mesh.kind() == MeshKind::kCovering, "the flip-free solver wants every touched cell");
  CHECK(mesh.outline().size() == outline.size(), "the mesh must be of this outline");
  std::vector<Handle> handles = sample_outline(mesh);
  std::vector<MeshTie> ties;
  for (const Handle& handle : handles)
    ties.push_back(handle.tie);
  auto start = LinearStart::make(mesh.mesh(), std::move(ties), watch);
  if (!start) return start.error();
  Data data{mesh,
            outline,
            outline.signed_area() < 0,
            MatchSource(mesh.outline()),
            DistortionEnergy(mesh.mesh()),
            std::move(handles),
            std::move(*start),
            {},
            {}};
  for (int i = 0; i < outline.size(); ++i) {
    data.outline_s.push_back(mesh.outline().s_at(data.reversed ? outline.size() - 1 - i : i));
    data.outline_ties.push_back(make_tie(mesh.locate_outline(data.outline_s.back())));
  }
  return FlipfreeSystem(std::make_shared<const Data>(std::move(data)));
}

const RegionMesh& FlipfreeSystem::region() const {
  return data_->region;
}
const ClosedCurve& FlipfreeSystem::outline() const {
  return data_->outline;
}

} // namespace oversketch
