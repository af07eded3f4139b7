#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/clone_system.h"
#include "core/clone/placed_pair.h"

#include <vector>

namespace oversketch {

/// u = f − g of a placed pair.
struct Correction {
  /// By pixel number; empty: u = 0.
  std::vector<Channels> values;
  /// A bound on the error in any pixel and channel, in the domain's values: see CloneReport::residual_levels.
  double error = 0;
};

/// @param mode  not kNone.
/// @errors those of the system's parts; cancelled.
Result<Correction> solve_correction(const PlacedPair& pair, const CloneSystem& system, BlendMode mode,
                                    CloneQuality quality, const Watch& watch);

} // namespace oversketch
