#include "core/deform/flipfree_solver.h"

#include "core/deform/flipfree_align.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace oversketch {
namespace {

/// W of the stages, parts of the user's; the safe way starts far from the sketch and takes longer.
constexpr std::array<double, 3> kStages{0.05, 0.25, 1.0};
constexpr std::array<double, 4> kSafeStages{0.005, 0.05, 0.25, 1.0};
constexpr std::array<double, 1> kLastStage{1.0};
constexpr int kMostSteps = 60;
/// What a step must gain for a stage to go on (SlideStage::gain): stages that only lead on, and the last one.  Sliding
/// on to the very bottom takes steps and moves places away from the truth: at 2e-3 a sixth more steps, and over random
/// bends 0.5…1 % more distance.
constexpr double kEarlyGain = 0.1;
constexpr double kGain = 5e-3;
/// The same from a warm start, which is nearly there: what is left is drift along flat valleys.  Where the shape hardly
/// differs from its source, the energy above its floor is nothing to measure by: hence the floor's own part.
constexpr double kWarmGain = 2e-2;
constexpr double kWarmFloorGain = 2e-5;
/// A handle this near to a pin gives way to it, cells.
constexpr double kPinClearance = 0.3;
/// Pins are held at least as hard as this in the last stage: most are met at once.
constexpr double kPinWeight = 640;
/// Pins further than this from their place are held harder, cells; half of what is promised.
constexpr double kPinTolerance = 0.05;
constexpr double kPinHarder = 8;
constexpr int kPinRounds = 4;
/// How hard the match holds a handle: everywhere, and where shape decides sharply (times certainty squared).
constexpr double kHold = 0.015;
constexpr double kSureHold = 0.2;
/// A sketch this near to a similarity of the outline is one, and one that no other can better, cells.
constexpr double kSimilar = 0.05;
constexpr double kSame = 1e-3;
/// How far a moved pin takes its neighbours along: part of the outline, and in parts of its own way.
constexpr double kPinReach = 0.06;
constexpr double kPinReachOfWay = 4;

/// Shortest way round from a to b, signed.
double shortest(const ClosedCurve& curve, double a, double b) {
  const double ahead = curve.forward(a, b);
  return ahead <= 0.5 * curve.length() ? ahead : ahead - curve.length();
}

} // namespace

WarmPlaces carry_over(const FlipfreeSolution& warm, const CurveRemap* remap, const ClosedCurve& outline) {
  WarmPlaces out;
  const std::size_t n = warm.handle_outline_s.size();
  const double around = warm.sketch->curve.length();
  for (std::size_t i = 0; i <= n; ++i) {
    const double shift = i == n ? around : 0.0;
    const double s = warm.handle_sketch_s[i % n] + shift, anchor = warm.anchors[i % n] + shift;
    out.places.outline_s.push_back(warm.handle_outline_s[i % n] + (i == n ? outline.length() : 0.0));
    out.places.sketch_s.push_back(remap ? (*remap)(s) : s);
    out.anchors.sketch_s.push_back(remap ? (*remap)(anchor) : anchor);
    out.anchors.certainty.push_back(remap && remap->redrawn(anchor) ? 0.0 : warm.holds[i % n]);
  }
  out.anchors.outline_s = out.places.outline_s;
  return out;
}

void shift_to_pins(WarmPlaces& warm, std::span<const PinPlace> pins, const ClosedCurve& outline, double sketch_length) {
  struct Shift {
    double at, by, reach;
  };
  std::vector<Shift> shifts;
  for (const PinPlace& pin : pins) {
    double by = std::fmod(pin.sketch_s - warm.places.sketch_at(pin.outline_s), sketch_length);
    by -= std::round(by / sketch_length) * sketch_length;
    double reach = std::max(kPinReach, kPinReachOfWay * std::abs(by) / sketch_length) * outline.length();
    reach = std::min(reach, 0.45 * outline.length());
    for (const PinPlace& other : pins)
      if (&other != &pin) reach = std::min(reach, std::abs(shortest(outline, pin.outline_s, other.outline_s)));
    shifts.push_back({pin.outline_s, by, reach});
  }
  for (std::size_t i = 0; i < warm.places.outline_s.size(); ++i)
    for (const Shift& shift : shifts) {
      const double away = std::abs(shortest(outline, shift.at, warm.places.outline_s[i]));
      const double by = away < shift.reach ? shift.by * (1 - away / shift.reach) : 0.0;
      warm.places.sketch_s[i] += by;
      warm.anchors.sketch_s[i] += by;
    }
}

FlipfreeSolver::FlipfreeSolver(const FlipfreeSystem& system, const FlipfreeInput& input, const FlipfreeOptions& options,
                               const Watch& watch)
    : system_(system.data()),
      input_(input),
      options_(options),
      watch_(watch),
      frame_(input.frame),
      handles_(make_handles()),
      hessian_(system_.distortion.pattern()),
      problem_{system_.distortion, frame_.curve, handles_, options.stiffness, {}, {}} {}

std::vector<Handle> FlipfreeSolver::make_handles() const {
  const double clearance = kPinClearance * system_.region.mesh().cell;
  const ClosedCurve& outline = system_.region.outline();
  std::vector<Handle> handles;
  for (const Handle& handle : system_.handles) {
    const auto near = [&](const PinPlace& pin) {
      return std::abs(shortest(outline, pin.outline_s, handle.outline_s)) < clearance;
    };
    if (std::none_of(input_.pins.begin(), input_.pins.end(), near)) handles.push_back(handle);
  }
  const double span = system_.handles.front().span;
  for (const PinPlace& pin : input_.pins)
    handles.push_back({pin.outline_s, make_tie(system_.region.locate_outline(pin.outline_s)), span, true});
  std::sort(handles.begin(), handles.end(), [](const Handle& a, const Handle& b) { return a.outline_s < b.outline_s; });
  return handles;
}

/// @param sketch_s  arc length on frame_.curve of an arc length on the outline, increasing, not wrapped.
void FlipfreeSolver::set_places(const std::function<double(double)>& sketch_s) {
  const double whole = frame_.curve.length();
  auto& s = state_.places.s;
  s.clear();
  for (const Handle& handle : handles_)
    s.push_back(sketch_s(handle.outline_s));
  // Pins stand exactly where they were put; the first one decides in which round the others are.
  auto pin = input_.pins.begin();
  const double* before = nullptr;
  for (std::size_t i = 0; i < handles_.size(); ++i) {
    if (!handles_[i].pinned) continue;
    const double want = snap_to_frame((pin++)->sketch_s / frame_.px_per_s);
    const double turns = before ? std::ceil((*before - want) / whole) : std::round((s[i] - want) / whole);
    s[i] = want + turns * whole;
    before = &s[i];
  }
  order_handles(s, handles_, whole);
}

void FlipfreeSolver::start_linear() {
  // The factored start has the system's own handles; where pins took the place of some, their neighbours speak for
  // them.
  Match map;
  for (std::size_t i = 0; i <= handles_.size(); ++i) {
    const bool last = i == handles_.size();
    map.outline_s.push_back(handles_[last ? 0 : i].outline_s + (last ? system_.region.outline().length() : 0.0));
    map.sketch_s.push_back(state_.places.s[last ? 0 : i] + (last ? frame_.curve.length() : 0.0));
  }
  Points targets;
  for (const Handle& own : system_.handles)
    targets.push_back(frame_.curve.at(map.sketch_at(own.outline_s)));
  state_.positions = system_.start.solve(targets);
  state_.untangled = false;
}

/// The region unchanged but for its turn and place: far from the sketch perhaps, but nothing is flipped.
void FlipfreeSolver::start_similar() {
  place_handles(frame_.curve, 1.0, state_.places);
  const Points& source = system_.region.mesh().vertices;
  std::complex<double> source_mean, target_mean, product;
  const double n = static_cast<double>(handles_.size());
  for (std::size_t i = 0; i < handles_.size(); ++i) {
    source_mean += to_complex(handle_position(source, i)) / n;
    target_mean += to_complex(state_.places.points[i]) / n;
  }
  for (std::size_t i = 0; i < handles_.size(); ++i)
    product += std::conj(to_complex(handle_position(source, i)) - source_mean) *
               (to_complex(state_.places.points[i]) - target_mean);
  const double turn = std::abs(product) > 0 ? std::arg(product) : 0.0;
  const std::complex<double> factor = std::polar(1 / system_.region.mesh().cell, turn);
  state_.positions = transformed(source, {factor, target_mean - factor * source_mean});
  state_.untangled = true;
}

bool FlipfreeSolver::run_stages(std::span<const double> stages) {
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const bool last = k + 1 == stages.size();
    SlideStage stage;
    stage.follow = stages[k] * options_.follow;
    stage.pin_factor = pin_factor_ * std::max(4.0, last ? kPinWeight / stage.follow : 0.0);
    stage.gain = last ? gains_.gain : kEarlyGain;
    stage.floor_gain = gains_.floor_gain;
    stage.most_steps = options_.most_steps > 0 ? options_.most_steps : kMostSteps;
    if (!run_stage(problem_, stage, state_, report_, hessian_, watch_)) return false;
    // What a soft boundary does not untangle, a hard one will not.
    if (flipped() > 0) return true;
  }
  return true;
}

Point FlipfreeSolver::handle_position(const Points& x, std::size_t i) const {
  const MeshTie& tie = handles_[i].tie;
  const auto& c = system_.distortion.cell(tie.cell);
  Point p;
  for (std::size_t k = 0; k < 4; ++k)
    p += tie.weights[k] * x[c[k]];
  return p;
}

double FlipfreeSolver::pin_distance() const {
  double worst = 0;
  for (std::size_t i = 0; i < handles_.size(); ++i)
    if (handles_[i].pinned)
      worst = std::max(worst, distance(handle_position(state_.positions, i), state_.places.points[i]));
  return worst;
}

/// Holds pins harder until each is met.
bool FlipfreeSolver::meet_pins() {
  if (options_.most_steps > 0) return true;
  for (int k = 0; k < kPinRounds && pin_distance() > kPinTolerance; ++k) {
    pin_factor_ *= kPinHarder;
    if (!run_stages(kLastStage)) return false;
  }
  return true;
}

/// Places to the last bit where the sketch is the outline's own shape; the best match must find the turn that fits.
void FlipfreeSolver::align_places(bool best) {
  Points own;
  std::vector<double> own_s;
  for (std::size_t i = 0; i < handles_.size(); ++i) {
    own.push_back(handle_position(system_.region.mesh().vertices, i));
    own_s.push_back(handles_[i].outline_s);
  }
  auto aligned = align_similar(own, frame_.curve, state_.places.s, kSimilar);
  if (best && !(aligned && aligned->distance < kSame))
    if (auto same = find_similar(own, system_.region.outline(), own_s, frame_.curve, kSame)) aligned = std::move(same);
  if (aligned) state_.places.s = std::move(aligned->s);
}

bool FlipfreeSolver::solve_matched(const Match& match, bool best) {
  gains_.gain = kGain;
  set_places([&](double s) { return match.sketch_at(s); });
  for (const Handle& handle : handles_) {
    const double certainty = std::min(1.0, match.certainty_at(handle.outline_s));
    problem_.holds.push_back(handle.pinned ? 0.0 : kHold + kSureHold * certainty * certainty);
  }
  if (input_.pins.empty()) align_places(best);
  problem_.anchors = state_.places.s;
  start_linear();
  if (!run_stages(kStages)) return false;
  if (flipped() > 0) {
    state_.places.s = problem_.anchors;
    start_similar();
    if (!run_stages(kSafeStages)) return false;
  }
  return meet_pins();
}

bool FlipfreeSolver::solve_warm(const Points& positions, const WarmPlaces& warm) {
  gains_ = {kWarmGain, kWarmFloorGain};
  set_places([&](double s) { return warm.anchors.sketch_at(s) / frame_.px_per_s; });
  problem_.anchors = state_.places.s;
  for (const Handle& handle : handles_)
    problem_.holds.push_back(handle.pinned ? 0.0 : warm.anchors.certainty_at(handle.outline_s));
  set_places([&](double s) { return warm.places.sketch_at(s) / frame_.px_per_s; });
  state_.positions.clear();
  for (const Point p : positions)
    state_.positions.push_back(frame_.from_target(p));
  state_.untangled = system_.distortion.least_determinant(state_.positions) > 0;
  return run_stages(kLastStage) && meet_pins();
}

void FlipfreeSolver::take_handles(FlipfreeSolution& out) const {
  for (std::size_t i = 0; i < handles_.size(); ++i) {
    out.handle_outline_s.push_back(handles_[i].outline_s);
    out.handle_sketch_s.push_back(state_.places.s[i] * frame_.px_per_s);
    out.anchors.push_back(problem_.anchors[i] * frame_.px_per_s);
    out.handles.push_back(frame_.to_target(handle_position(state_.positions, i)));
  }
  out.holds = problem_.holds;
  const auto& s = out.handle_sketch_s;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double next = i + 1 < s.size() ? s[i + 1] : s[0] + input_.sketch->curve.length();
    if (next <= s[i]) ++out.order_violations;
  }
}

void FlipfreeSolver::take_outline(FlipfreeSolution& out) const {
  Match map{out.handle_outline_s, out.handle_sketch_s, {}, 0};
  map.outline_s.push_back(map.outline_s.front() + system_.region.outline().length());
  map.sketch_s.push_back(map.sketch_s.front() + input_.sketch->curve.length());
  for (std::size_t i = 0; i < system_.outline_ties.size(); ++i) {
    const MeshTie& tie = system_.outline_ties[i];
    Point p;
    for (std::size_t k = 0; k < 4; ++k)
      p += tie.weights[k] * state_.positions[system_.distortion.cell(tie.cell)[k]];
    out.outline.push_back(frame_.to_target(p));
    const double part = input_.sketch->to_given(map.sketch_at(system_.outline_s[i])) / input_.sketch->given_length;
    out.correspondence.push_back(system_.reversed && part > 0 ? 1 - part : part);
  }
}

FlipfreeSolution FlipfreeSolver::take() const {
  FlipfreeSolution out;
  for (const Point p : state_.positions)
    out.positions.push_back(frame_.to_target(p));
  take_handles(out);
  take_outline(out);
  out.sketch = input_.sketch;
  out.options = options_;
  out.energies = report_.energies;
  out.energy = report_.energies.empty() ? 0.0 : report_.energies.back();
  out.iterations = report_.steps;
  out.numeric_factorizations = report_.factorizations;
  out.flipped = flipped();
  out.pin_distance = pin_distance();
  out.converged = options_.most_steps == 0 || report_.steps < options_.most_steps;
  return out;
}

} // namespace oversketch
