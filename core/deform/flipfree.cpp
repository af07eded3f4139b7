#include "core/deform/flipfree.h"

#include "core/base/check.h"
#include "core/deform/flipfree_solver.h"
#include "core/deform/metrics.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oversketch {
namespace {

/// A pin further than this from where its point was (part of the length) is matched anew.
constexpr double kFarPin = 0.05;
/// What a runner-up must keep to: see solve_alternatives().  Parts of the square root of the sketch's area.
constexpr double kFurthest = 0.15;
constexpr double kFurtherThanBest = 1.5;
constexpr double kSameAnswer = 0.02;

bool has_same_sketch(const FlipfreeSolution* warm, const Points& given) {
  return warm && *warm->given_sketch == given;
}

Result<FlipfreeInput> prepare(const FlipfreeSystem& system, const Points& given, std::span<const PinPair> pins,
                              const FlipfreeOptions& options, const FlipfreeSolution* warm) {
  CHECK(options.stiffness > 0 && options.follow > 0 && options.most_steps >= 0, "options out of range");
  std::shared_ptr<const CleanSketch> sketch = has_same_sketch(warm, given) ? warm->sketch : nullptr;
  if (!sketch) {
    auto clean = clean_sketch(given, 1.0);
    if (!clean) return clean.error();
    sketch = std::make_shared<const CleanSketch>(std::move(*clean));
  }
  const RegionMesh& region = system.region();
  FlipfreeInput out{sketch, make_sketch_frame(region.outline(), region.mesh().cell, sketch->curve), {}};
  auto places = place_pins(system.region().outline(), out.sketch->curve, pins);
  if (!places) return places.error();
  out.pins = std::move(*places);
  std::sort(out.pins.begin(), out.pins.end(),
            [](const PinPlace& a, const PinPlace& b) { return a.outline_s < b.outline_s; });
  const auto repeats = [](const PinPlace& a, const PinPlace& b) { return b.outline_s <= a.outline_s; };
  out.pins.erase(std::unique(out.pins.begin(), out.pins.end(), repeats), out.pins.end());
  return out;
}

/// Whether every pin is near where the warm solution has its outline point.
bool stays_near(const WarmPlaces& warm, const FlipfreeInput& input) {
  const ClosedCurve& sketch = input.sketch->curve;
  return std::all_of(input.pins.begin(), input.pins.end(), [&](const PinPlace& pin) {
    const double at = warm.places.sketch_at(pin.outline_s);
    return std::min(sketch.forward(at, pin.sketch_s), sketch.forward(pin.sketch_s, at)) <= kFarPin * sketch.length();
  });
}

/// Nothing where the warm solution is no good start, or leads to flips.
Result<std::optional<FlipfreeSolution>> solve_warm(const FlipfreeSystem& system, const FlipfreeInput& input,
                                                   const FlipfreeOptions& options, const FlipfreeSolution& warm,
                                                   const Watch& watch) {
  using Nothing = std::optional<FlipfreeSolution>;
  const bool same = input.sketch == warm.sketch;
  const auto remap = same ? std::nullopt : find_remap(warm.sketch->curve, input.sketch->curve);
  if (warm.flipped > 0 || (!same && !remap)) return Nothing();
  const ClosedCurve& outline = system.region().outline();
  WarmPlaces places = carry_over(warm, remap ? &*remap : nullptr, outline);
  if (!stays_near(places, input)) return Nothing();
  shift_to_pins(places, input.pins, outline, input.sketch->curve.length());
  const StageTimer timer(watch.times, "solve");
  FlipfreeSolver solver(system, input, options, watch);
  if (!solver.solve_warm(warm.positions, places)) return cancelled();
  if (solver.flipped() > 0) return Nothing();
  FlipfreeSolution solution = solver.take();
  solution.start = same ? FlipfreeStart::kWarm : FlipfreeStart::kRemapped;
  solution.match_cost = warm.match_cost;
  return Nothing(std::move(solution));
}

std::vector<PinPlace> in_frame(const FlipfreeInput& input) {
  std::vector<PinPlace> pins = input.pins;
  for (PinPlace& pin : pins)
    pin.sketch_s = snap_to_frame(pin.sketch_s / input.frame.px_per_s);
  return pins;
}

/// Of the outline from the sketch or of the sketch from it, px.
double furthest_from_sketch(const FlipfreeSolution& solution) {
  return measure_sketch_distance(ClosedCurve(solution.handles), solution.sketch->curve).max;
}

bool is_worth_offering(const FlipfreeSolution& other, const FlipfreeSolution& best) {
  if (other.flipped > 0) return false;
  const double size = std::sqrt(std::abs(best.sketch->curve.signed_area()));
  if (furthest_from_sketch(other) > std::max(kFurthest * size, kFurtherThanBest * furthest_from_sketch(best)))
    return false;
  double apart = 0;
  for (std::size_t i = 0; i < best.outline.size(); ++i)
    apart += distance(other.outline[i], best.outline[i]) / static_cast<double>(best.outline.size());
  return apart > kSameAnswer * size;
}

Result<std::vector<FlipfreeSolution>> solve_matched(const FlipfreeSystem& system, const FlipfreeInput& input,
                                                    const FlipfreeOptions& options, int count, const Watch& watch) {
  StageTimer match_timer(watch.times, "match");
  const auto matches = match_curves(system.data().source, input.frame.curve, in_frame(input), {count - 1}, watch);
  match_timer.stop();
  if (!matches) return matches.error();
  std::vector<FlipfreeSolution> solutions;
  for (const Match& match : *matches) {
    const StageTimer timer(watch.times, "solve");
    FlipfreeSolver solver(system, input, options, watch);
    const bool best = solutions.empty();
    if (!solver.solve_matched(match, best)) return cancelled();
    FlipfreeSolution solution = solver.take();
    solution.match_cost = match.cost;
    solution.matches = best ? 1 : 0;
    if (best || is_worth_offering(solution, solutions.front())) solutions.push_back(std::move(solution));
    watch.report(static_cast<double>(&match - matches->data() + 1) / static_cast<double>(matches->size()), "solve");
  }
  return solutions;
}

} // namespace

Result<FlipfreeSolution> solve_flipfree(const FlipfreeSystem& system, const Points& sketch,
                                        std::span<const PinPair> pins, const FlipfreeOptions& options,
                                        const FlipfreeSolution* warm, const Watch& watch) {
  if (warm) CHECK(warm->positions.size() == system.region().mesh().vertices.size(), "warm must be of the same system");
  if (watch.stopped()) return cancelled();
  const auto input = prepare(system, sketch, pins, options, warm);
  if (!input) return input.error();
  std::optional<FlipfreeSolution> solution;
  if (warm) {
    auto tried = solve_warm(system, *input, options, *warm, watch);
    if (!tried) return tried.error();
    solution = std::move(*tried);
  }
  if (!solution) {
    auto solved = solve_matched(system, *input, options, 1, watch);
    if (!solved) return solved.error();
    solution = std::move(solved->front());
  }
  solution->given_sketch = has_same_sketch(warm, sketch) ? warm->given_sketch : std::make_shared<const Points>(sketch);
  solution->pins.assign(pins.begin(), pins.end());
  return std::move(*solution);
}

Result<std::vector<FlipfreeSolution>> solve_alternatives(const FlipfreeSystem& system, const Points& sketch,
                                                         std::span<const PinPair> pins, const FlipfreeOptions& options,
                                                         int count, const Watch& watch) {
  CHECK(count >= 1, "there is at least the best match");
  if (watch.stopped()) return cancelled();
  const auto input = prepare(system, sketch, pins, options, nullptr);
  if (!input) return input.error();
  auto solutions = solve_matched(system, *input, options, count, watch);
  if (!solutions) return solutions.error();
  const auto given = std::make_shared<const Points>(sketch);
  for (FlipfreeSolution& solution : *solutions) {
    solution.given_sketch = given;
    solution.pins.assign(pins.begin(), pins.end());
  }
  return solutions;
}

} // namespace oversketch
