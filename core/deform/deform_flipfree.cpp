// DeformSystem's way with method flipfree.

#include "core/deform/deformation.h"
#include "core/geometry/curve.h"

#include <cmath>

namespace oversketch {
namespace {

/// Distance of the points between which the shown boundary is straight, in control cells: inside a cell a straight
/// piece of the outline goes to a parabola, which this follows to a hundredth of a cell.
constexpr double kBoundaryStep = 0.25;

std::vector<double> boundary_places(const ClosedCurve& outline, double cell) {
  std::vector<double> places;
  for (int i = 0; i < outline.size(); ++i) {
    const double from = outline.s_at(i), to = i + 1 < outline.size() ? outline.s_at(i + 1) : outline.length();
    const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / (kBoundaryStep * cell))));
    for (int k = 0; k < pieces; ++k)
      places.push_back(from + (to - from) * k / pieces);
  }
  return places;
}

} // namespace

Result<DeformSystem> DeformSystem::make_flipfree(const Points& outline, const DeformOptions& options,
                                                 const FlipfreePart* like, DeformCounts& counts, const Watch& watch) {
  if (auto sound = check_cell_size(ClosedCurve(outline), options.cell_px); !sound) return sound.error();
  auto system =
      like == nullptr ? FlipfreeSystem::make(ClosedCurve(outline), watch) : Result<FlipfreeSystem>(like->system);
  if (!system) return system.error();
  if (like == nullptr) {
    ++counts.meshings;
    ++counts.symbolic_factorizations;
    ++counts.numeric_factorizations;
  }
  auto display = make_display_mesh(system->region(), options.cell_px, watch);
  if (!display) return display.error();
  auto control = std::make_shared<const QuadMesh>(system->region().mesh());
  FlipfreePart part{
      std::move(*system), std::move(control), std::make_shared<const DisplayMesh>(std::move(*display)), nullptr, {}};
  part.mesh = std::shared_ptr<const QuadMesh>(part.display, &part.display->mesh);
  part.boundary_s = like == nullptr ? boundary_places(part.system.region().outline(), part.system.region().mesh().cell)
                                    : like->boundary_s;
  return DeformSystem(std::move(part));
}

Deformation DeformSystem::show_flipfree(const FlipfreePart& part, std::shared_ptr<const FlipfreeSolution> solution) {
  const RegionMesh& region = part.system.region();
  Deformation result;
  result.mesh = part.mesh;
  result.positions = prolong(region.mesh(), solution->positions, *part.display);
  result.boundary.reserve(part.boundary_s.size());
  for (const double s : part.boundary_s)
    result.boundary.push_back(locate(region.mesh(), solution->positions, region.locate_outline(s)));
  result.outline = solution->outline;
  result.correspondence = solution->correspondence;
  result.energies = solution->energies;
  result.flipped_control_cells = solution->flipped;
  result.order_violations = solution->order_violations;
  result.iterations = solution->iterations;
  result.handles = static_cast<int>(solution->handles.size());
  result.handle_points = solution->handles;
  result.control_mesh = part.control;
  result.control_positions = std::shared_ptr<const Points>(solution, &solution->positions);
  result.vertices = static_cast<int>(solution->positions.size());
  result.match_cost = solution->match_cost;
  result.flipfree = std::move(solution);
  return result;
}

} // namespace oversketch
