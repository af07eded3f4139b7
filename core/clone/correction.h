#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/clone_system.h"
#include "core/clone/mixed_rows.h"
#include "core/clone/placed_pair.h"

#include <memory>
#include <vector>

namespace oversketch {

/// u = f − g of a placed pair, where its solver left it; neither: u = 0.
struct Correction {
  std::shared_ptr<const Membrane> membrane;
  MembraneValues values;
  std::shared_ptr<MultigridSolve> pixels;
  /// A bound on the error in any pixel and channel, in the domain's values: see CloneReport::residual_levels.
  double error = 0;

  bool is_zero() const { return !membrane && !pixels; }
  /// u of a run of the mask from left to right, in place of what `u` holds; the fourth number means nothing.
  /// @param index  its number in the mask.
  void read(std::size_t index, const Mask::Run& run, std::vector<Float4>& u) const;
  /// Goes on solving on the pixels (CHECK) until the error is at most that, or float can do no better.
  /// @errors cancelled.
  Result<void> refine(double wanted_error, const Watch& watch);
};

/// At export, 8-bit levels.
inline constexpr double kExportLevels = 0.03;

/// By what parts of a system a blend is solved.
struct SolveWay {
  /// Alone, or as the start on the pixels; none: zero is the start.
  std::shared_ptr<const Membrane> membrane;
  bool on_pixels = false;
  /// Of the solve on the pixels: errors left, 8-bit levels; the least cycles, the most.
  double tolerance_levels = 0;
  int least = 1;
  int most = 1;
};

/// Makes the membrane if it must; not the grids.
/// @param options  mode not kNone.
/// @errors cancelled.
Result<SolveWay> choose_way(const CloneSystem& system, const BlendOptions& options, CloneQuality quality,
                            const Watch& watch);

/// @param options  those of the pair; mode not kNone.
/// @errors those of the system's parts; clone.not-finite (without a place); cancelled.
Result<Correction> solve_correction(const PlacedPair& pair, const CloneSystem& system, const BlendOptions& options,
                                    CloneQuality quality, int threads, const Watch& watch);

/// The same where the way is on_pixels, for pictures of any kind.
/// @param ring  d at the outer pixel of each of the graph's ring edges, in the domain's values.
/// @param read  the pair; used for mixed gradients.
Result<Correction> solve_on_pixels(const std::vector<Float4>& ring, const ReadPixels& read, const CloneSystem& system,
                                   const BlendOptions& options, const SolveWay& way, int threads, const Watch& watch);

} // namespace oversketch
