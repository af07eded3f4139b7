#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/blend.h"
#include "core/clone/membrane.h"
#include "core/clone/multigrid.h"
#include "core/clone/pixel_graph.h"

#include <memory>
#include <utility>
#include <vector>

namespace oversketch {

/// How near to the exact solution, in 8-bit levels, worst pixel; on photographs, and for differences along the ring
/// that are white noise over all 255 levels.  Mixed gradients, screening, and masks on which no membrane pays are
/// solved on every pixel in any quality.
enum class CloneQuality {
  kFirst,  ///< membrane with k = 1: 2 (4); ready soonest
  kDrag,   ///< membrane with k = 2: 0.7 (0.9)
  kRest,   ///< membrane with k = 4: 0.25 (0.25)
  kExport, ///< on every pixel: 0.03
};

/// All that blending needs and that depends on the mask alone; kept as long as the mask stays.  A move by whole pixels
/// changes none of it.
///
/// The parts that cost are made when they are first asked for, each once; one that was cancelled or refused is made at
/// the next call.  Copies share everything.
/// @threads one object may be used by several threads; who asks for a part that is being made waits for it.
class CloneSystem {
public:
  /// @errors clone.empty-mask; clone.too-large (more than INT_MAX pixels).
  /// @cost O(runs + perimeter).
  static Result<CloneSystem> make(const Mask& mask);

  const PixelGraph& graph() const;
  const Mask& mask() const { return graph().mask; }

  /// Makes the parts that a blend with those options and that quality needs, so that the blend does not wait for them.
  /// @errors those of MaskMultigrid::make; cancelled.
  Result<void> prepare(const BlendOptions& options, CloneQuality quality, const Watch& watch = {}) const;

  /// How far from each pixel's centre the nearest centre outside the mask is, px, by pixel number.
  std::shared_ptr<const std::vector<float>> depths() const;
  /// Whether membrane() would find one made.  Where it does not pay it never is, and a coarser one may serve.
  bool has_membrane(CloneQuality quality) const;

  /// For any quality but kExport (CHECK).  None where it does not pay: see Membrane.
  /// @errors cancelled.
  Result<std::shared_ptr<const Membrane>> membrane(CloneQuality quality, const Watch& watch = {}) const;

  /// A solve on every pixel: what mixed gradients, screening and export need.  Whoever holds it has it alone; let go,
  /// it is kept for the next who asks, whatever values stand in it.
  /// @param screening  λ; grids are kept for one λ at a time.
  /// @errors those of MaskMultigrid::make.
  Result<std::shared_ptr<MultigridSolve>> pixels(double screening, int threads, const Watch& watch = {}) const;

private:
  struct Data;
  explicit CloneSystem(std::shared_ptr<Data> data) : data_(std::move(data)) {}
  std::shared_ptr<Data> data_;
};

} // namespace oversketch
