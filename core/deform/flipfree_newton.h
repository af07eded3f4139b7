#pragma once

#include "core/base/watch.h"
#include "core/deform/flipfree_energy.h"
#include "core/deform/flipfree_handles.h"

#include <vector>

namespace oversketch {

/// Everything that one solve works on, in units of a control cell: the source's cells and, on average, the target's are
/// unit squares.
struct SlideProblem {
  const DistortionEnergy& distortion;
  const ClosedCurve& curve;
  const std::vector<Handle>& handles;
  double stiffness = 0.5;
  /// Where the match has each handle (arc length, as HandlePlaces::s), and how hard it holds it there, >= 0.
  std::vector<double> anchors;
  std::vector<double> holds;
};

struct SlideState {
  Points positions;
  HandlePlaces places;
  /// Every D has been above 1e-3 once: nothing may flip any more.
  bool untangled = false;
};

struct SlideReport {
  /// Energy after each step.
  std::vector<double> energies;
  int steps = 0;
  int factorizations = 0;
};

struct SlideStage {
  /// W: what a cell of distance along one cell of outline costs.
  double follow = 20;
  /// What pins weigh beside it: W times this, in both directions.
  double pin_factor = 4;
  int most_steps = 60;
  /// Stop when a step gains less than this part of the energy above its floor (that of a rotation) …
  double gain = 1e-3;
  /// … or than this part of the floor.
  double floor_gain = 1e-8;
};

/// Projected Newton steps on
///   E = DistortionEnergy + Σ_i W span_i [(n_i·d_i)² + 0.04 (t_i·d_i)²],   d_i = x(handle i) − γ(s_i)   (pinned: 4 W
///   span |d|²),
/// each followed by sliding: three times s ← s + clip(t·d, ±0.7 cell), in order (order_handles()), kept unless E rises
/// by more than 2 %.  While a corner's D is below 1e-3, ε > 0 untangles (given up after 8 steps); from then on no
/// corner loses more than 95 % of its D in a step, so nothing can flip again.
/// @returns false when stopped; the state is then that after the last whole step.
bool run_stage(const SlideProblem& problem, const SlideStage& stage, SlideState& state, SlideReport& report,
               BlockCholesky& hessian, const Watch& watch);

} // namespace oversketch
