#include "core/deform/deformation.h"

#include "core/geometry/curve.h"

#include <cmath>
#include <ctime>

namespace oversketch {
namespace {

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

Result<void> check_options(const DeformOptions& options) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(options.stiffness, kLeastStiffness, kMostStiffness))
    return Error{"deform.stiffness", "the stiffness must be from 0.001 to 1000", ""};
  if (!within(options.follow, kLeastFollow, kMostFollow))
    return Error{"deform.follow", "how closely the sketch is followed must be from 0.01 to 10000", ""};
  if (options.iterations < 0 || options.iterations > kMostPaperIterations)
    return Error{"deform.iterations", "the iterations must be from 0 to " + std::to_string(kMostPaperIterations), ""};
  return {};
}

/// Times of what was used again count for nothing; those of the solve go behind those of its system.
void put_before(StageTimes system, double system_cpu_ms, Deformation& solved) {
  for (const auto& [stage, ms] : solved.times.stages_ms)
    system.add(stage, ms);
  solved.times = std::move(system);
  solved.cpu_ms += system_cpu_ms;
}

} // namespace

Result<DeformSystem> DeformSystem::make(const Points& outline, const DeformOptions& options, const DeformSystem* like,
                                        DeformCounts& counts, const Watch& outer) {
  if (auto sound = check_options(options); !sound) return sound.error();
  StageTimes times;
  double cpu_ms = 0;
  auto system = [&]() -> Result<DeformSystem> {
    const Account account(outer, times, cpu_ms);
    if (options.method == Method::kFlipfree)
      return make_flipfree(outline, options, like == nullptr ? nullptr : std::get_if<FlipfreePart>(&like->part_),
                           counts, account.watch());
    return make_paper(outline, options, like == nullptr ? nullptr : std::get_if<PaperPart>(&like->part_), counts,
                      account.watch());
  }();
  if (system) system->times_ = std::move(times), system->cpu_ms_ = cpu_ms;
  return system;
}

Result<Deformation> DeformSystem::deform(const Points& sketch, std::span<const PinPair> pins,
                                         const DeformOptions& options, const Deformation* warm, DeformCounts& counts,
                                         const Watch& outer) const {
  if (auto sound = check_options(options); !sound) return sound.error();
  StageTimes times;
  double cpu_ms = 0;
  auto solved = [&]() -> Result<Deformation> {
    const Account account(outer, times, cpu_ms);
    if (const auto* paper = std::get_if<PaperPart>(&part_)) {
      ++counts.matches;
      return deform_paper(*paper, sketch, pins, options, account.watch());
    }
    const auto& part = std::get<FlipfreePart>(part_);
    const FlipfreeOptions flipfree{options.stiffness, options.follow, 0};
    auto solution = solve_flipfree(part.system, sketch, pins, flipfree,
                                   warm == nullptr ? nullptr : warm->flipfree.get(), account.watch());
    if (!solution) return solution.error();
    counts.matches += solution->matches;
    counts.numeric_factorizations += solution->numeric_factorizations;
    return show_flipfree(part, std::make_shared<const FlipfreeSolution>(std::move(*solution)));
  }();
  if (!solved) return solved;
  solved->times = std::move(times);
  solved->cpu_ms = cpu_ms;
  put_before(times_, cpu_ms_, *solved);
  return solved;
}

Result<std::vector<Deformation>> DeformSystem::alternatives(const Points& sketch, std::span<const PinPair> pins,
                                                            const DeformOptions& options, int count,
                                                            DeformCounts& counts, const Watch& outer) const {
  if (auto sound = check_options(options); !sound) return sound.error();
  std::vector<Deformation> found;
  const auto* part = std::get_if<FlipfreePart>(&part_);
  if (part == nullptr) {
    auto only = deform(sketch, pins, options, nullptr, counts, outer);
    if (!only) return only.error();
    found.push_back(std::move(*only));
    return found;
  }
  StageTimes times;
  double cpu_ms = 0;
  auto solutions = [&] {
    const Account account(outer, times, cpu_ms);
    return solve_alternatives(part->system, sketch, pins, {options.stiffness, options.follow, 0}, count,
                              account.watch());
  }();
  if (!solutions) return solutions.error();
  ++counts.matches;
  for (FlipfreeSolution& solution : *solutions) {
    counts.numeric_factorizations += solution.numeric_factorizations;
    found.push_back(show_flipfree(*part, std::make_shared<const FlipfreeSolution>(std::move(solution))));
    // The stages were timed together.
    found.back().times = times;
    found.back().cpu_ms = cpu_ms;
    put_before(times_, cpu_ms_, found.back());
  }
  return found;
}

Deformation DeformSystem::redisplay(const Deformation& solved) const {
  const auto* part = std::get_if<FlipfreePart>(&part_);
  CHECK(part != nullptr && solved.flipfree, "only a flip-free solution has a control mesh of its own");
  Deformation shown = show_flipfree(*part, solved.flipfree);
  shown.times = solved.times;
  shown.cpu_ms = solved.cpu_ms;
  return shown;
}

Metrics measure(const Deformation& deformation, const ClosedCurve& sketch, const Points& truth) {
  Metrics metrics;
  metrics.distortion = measure_distortion(*deformation.mesh, deformation.positions);
  metrics.distortion.flipped_cells += deformation.flipped_control_cells;
  // What is shown: between the outline's own points it bends.  The paper's goes round whole cells.
  const Points& shown = deformation.flipfree ? deformation.boundary : deformation.outline;
  if (perimeter(shown) > 0) metrics.sketch_distance = measure_sketch_distance(ClosedCurve(shown), sketch);
  if (!truth.empty()) metrics.truth_error = truth_error(deformation.outline, truth, sketch.length());
  metrics.energy = deformation.energies.empty() ? 0 : deformation.energies.back();
  metrics.iterations = deformation.iterations;
  metrics.match_cost = deformation.match_cost;
  metrics.vertices = deformation.vertices;
  metrics.handles = deformation.handles;
  metrics.order_violations = deformation.order_violations;
  metrics.times = deformation.times;
  metrics.cpu_ms = deformation.cpu_ms;
  return metrics;
}

} // namespace oversketch
