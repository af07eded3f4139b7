// DeformSystem's way with the paper's methods.

#include "core/deform/cleanup.h"
#include "core/deform/deformation.h"
#include "core/geometry/curve.h"

#include <algorithm>

namespace oversketch {
namespace {

/// The start of the map by arc length that departs least from the match: its mean offset.  (The match at a single place
/// would carry that place's own error all round.)
double mean_start(const Match& match, double outline_length, const ClosedCurve& sketch) {
  constexpr int kSamples = 256;
  double offset = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = (i + 0.5) / kSamples;
    offset += match.sketch_at(t * outline_length) - t * sketch.length();
  }
  return sketch.wrap(offset / kSamples);
}

} // namespace

Result<DeformSystem> DeformSystem::make_paper(const Points& outline, const DeformOptions& options,
                                              const PaperPart* like, DeformCounts& counts, const Watch& watch) {
  if (like != nullptr) {
    auto system = like->system.with_handle_weight(options.handle_weight, watch);
    if (!system) return system.error();
    ++counts.numeric_factorizations;
    PaperPart part = *like;
    part.system = std::move(*system);
    return DeformSystem(std::move(part));
  }
  auto region = make_region_mesh(ClosedCurve(outline), options.cell_px, MeshKind::kTrimmed, watch);
  if (!region) return region.error();
  ++counts.meshings;
  auto mesh = std::make_shared<const QuadMesh>(region->mesh());
  const MatchSource match(region->outline());
  auto system = PaperSystem::make(std::make_shared<const RegionMesh>(std::move(*region)), options.handle_weight, watch);
  if (!system) return system.error();
  ++counts.symbolic_factorizations;
  ++counts.numeric_factorizations;
  return DeformSystem(PaperPart{std::move(*system), match, std::move(mesh), signed_area(outline) < 0});
}

Result<Deformation> DeformSystem::deform_paper(const PaperPart& part, const Points& given,
                                               std::span<const PinPair> pins, const DeformOptions& options,
                                               const Watch& watch) {
  Deformation result;
  StageTimer timer(watch.times, "match");
  const auto sketch = clean_sketch(given, 1);
  if (!sketch) return sketch.error();
  PaperOptions paper_options;
  paper_options.iterations = options.method == Method::kInitial ? 0 : options.iterations;
  if (pins.empty()) {
    const auto matches = match_curves(part.match, sketch->curve, {}, {}, watch);
    if (!matches) return matches.error();
    const double outline_length = part.match.outline().length();
    paper_options.start = PaperOptions::StartPair{0, mean_start(matches->front(), outline_length, sketch->curve)};
    result.match_cost = matches->front().cost;
  }
  timer.stop();

  auto solution = solve_paper(part.system, sketch->curve, pins, paper_options, watch);
  if (!solution) return solution.error();
  result.mesh = part.mesh;
  result.vertices = static_cast<int>(part.mesh->vertices.size());
  result.positions = std::move(solution->positions);
  result.boundary = std::move(solution->boundary);
  result.outline = std::move(solution->outline);
  const double length = sketch->curve.length();
  for (const double fraction : solution->correspondence)
    result.correspondence.push_back(sketch->to_given(fraction * length) / sketch->given_length);
  if (part.outline_reversed) {
    std::reverse(result.outline.begin(), result.outline.end());
    std::reverse(result.correspondence.begin(), result.correspondence.end());
    for (double& fraction : result.correspondence)
      fraction = fraction == 0 ? 0 : 1 - fraction;
  }
  result.iterations = paper_options.iterations;
  result.energies = std::move(solution->energies);
  result.order_violations = solution->order_violations;
  result.handles = static_cast<int>(solution->handles.size());
  result.handle_points = std::move(solution->handles);
  result.handle_gradients = std::move(solution->gradients);
  return result;
}

} // namespace oversketch
