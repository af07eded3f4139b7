#include "core/deform/deformation.h"

#include "core/deform/cleanup.h"
#include "core/geometry/curve.h"

#include <algorithm>
#include <ctime>

namespace oversketch {
namespace {

/// The mesh's region has positive area; the caller's outline may run the other way.
bool runs_backwards(const Points& outline) {
  return signed_area(outline) < 0;
}

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

/// Collects the stages and the processor time of one piece of work, and hands the stages on to the caller's times.
class Account {
public:
  Account(const Watch& outer, StageTimes& times, double& cpu_ms)
      : watch_(outer), outer_(outer.times), times_(times), cpu_ms_(cpu_ms) {
    watch_.times = &own_;
  }
  ~Account() {
    for (const auto& [stage, ms] : own_.stages_ms) {
      times_.add(stage, ms);
      if (outer_ != nullptr) outer_->add(stage, ms);
    }
    cpu_ms_ += 1e3 * static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }
  Account(const Account&) = delete;
  Account& operator=(const Account&) = delete;
  const Watch& watch() const { return watch_; }

private:
  Watch watch_;
  StageTimes own_;
  StageTimes* outer_;
  StageTimes& times_;
  double& cpu_ms_;
  std::clock_t start_ = std::clock();
};

} // namespace

DeformSystem::DeformSystem(PaperSystem paper, bool outline_reversed)
    : paper_(std::move(paper)),
      match_source_(paper_.region().outline()),
      mesh_(std::make_shared<const QuadMesh>(paper_.region().mesh())),
      outline_reversed_(outline_reversed) {}

Result<DeformSystem> DeformSystem::make(const Points& outline, const DeformOptions& options, const DeformSystem* like,
                                        DeformCounts& counts, const Watch& outer) {
  StageTimes times;
  double cpu_ms = 0;
  auto system = [&]() -> Result<DeformSystem> {
    const Account account(outer, times, cpu_ms);
    return like == nullptr ? make_anew(outline, options, counts, account.watch())
                           : make_reweighted(*like, options.handle_weight, counts, account.watch());
  }();
  if (system) system->times_ = std::move(times), system->cpu_ms_ = cpu_ms;
  return system;
}

Result<DeformSystem> DeformSystem::make_reweighted(const DeformSystem& like, double handle_weight, DeformCounts& counts,
                                                   const Watch& watch) {
  auto paper = like.paper_.with_handle_weight(handle_weight, watch);
  if (!paper) return paper.error();
  ++counts.numeric_factorizations;
  DeformSystem system = like;
  system.paper_ = std::move(*paper);
  return system;
}

Result<DeformSystem> DeformSystem::make_anew(const Points& outline, const DeformOptions& options, DeformCounts& counts,
                                             const Watch& watch) {
  auto region = make_region_mesh(ClosedCurve(outline), options.cell_px, MeshKind::kTrimmed, watch);
  if (!region) return region.error();
  ++counts.meshings;
  auto paper = PaperSystem::make(std::make_shared<const RegionMesh>(std::move(*region)), options.handle_weight, watch);
  if (!paper) return paper.error();
  ++counts.symbolic_factorizations;
  ++counts.numeric_factorizations;
  return DeformSystem(std::move(*paper), runs_backwards(outline));
}

Result<Deformation> DeformSystem::deform(const Points& given, std::span<const PinPair> pins,
                                         const DeformOptions& options, DeformCounts& counts, const Watch& outer) const {
  Deformation result;
  result.times = times_;
  result.cpu_ms = cpu_ms_;
  const Account account(outer, result.times, result.cpu_ms);
  const Watch& watch = account.watch();
  StageTimer timer(watch.times, "match");
  const auto sketch = clean_sketch(given, 1);
  if (!sketch) return sketch.error();
  PaperOptions paper_options;
  paper_options.iterations = options.method == Method::kInitial ? 0 : options.iterations;
  if (pins.empty()) {
    const auto matches = match_curves(match_source_, sketch->curve, {}, {}, watch);
    if (!matches) return matches.error();
    paper_options.start =
        PaperOptions::StartPair{0, mean_start(matches->front(), region().outline().length(), sketch->curve)};
    result.match_cost = matches->front().cost;
  }
  ++counts.matches;
  timer.stop();

  auto solution = solve_paper(paper_, sketch->curve, pins, paper_options, watch);
  if (!solution) return solution.error();
  result.mesh = mesh_;
  result.positions = std::move(solution->positions);
  result.boundary = std::move(solution->boundary);
  result.outline = std::move(solution->outline);
  const double length = sketch->curve.length();
  for (const double fraction : solution->correspondence)
    result.correspondence.push_back(sketch->to_given(fraction * length) / sketch->given_length);
  if (outline_reversed_) {
    std::reverse(result.outline.begin(), result.outline.end());
    std::reverse(result.correspondence.begin(), result.correspondence.end());
    for (double& fraction : result.correspondence)
      fraction = fraction == 0 ? 0 : 1 - fraction;
  }
  result.energies = std::move(solution->energies);
  result.order_violations = solution->order_violations;
  result.handles = static_cast<int>(solution->handles.size());
  return result;
}

Metrics measure(const Deformation& deformation, const ClosedCurve& sketch, const Points& truth) {
  Metrics metrics;
  metrics.distortion = measure_distortion(*deformation.mesh, deformation.positions);
  if (perimeter(deformation.outline) > 0)
    metrics.sketch_distance = measure_sketch_distance(ClosedCurve(deformation.outline), sketch);
  if (!truth.empty()) metrics.truth_error = oversketch::truth_error(deformation.outline, truth, sketch.length());
  metrics.energy = deformation.energies.empty() ? 0 : deformation.energies.back();
  metrics.iterations = deformation.energies.empty() ? 0 : static_cast<int>(deformation.energies.size()) - 1;
  metrics.match_cost = deformation.match_cost;
  metrics.vertices = static_cast<int>(deformation.mesh->vertices.size());
  metrics.handles = deformation.handles;
  metrics.order_violations = deformation.order_violations;
  metrics.times = deformation.times;
  metrics.cpu_ms = deformation.cpu_ms;
  return metrics;
}

} // namespace oversketch
