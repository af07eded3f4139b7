#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/blend.h"
#include "core/clone/pixel_graph.h"
#include "core/clone/pixel_solver.h"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace oversketch {

/// How near to the exact solution.  With the membrane of clone modes import, monochrome and average; mixed gradients
/// are solved on every pixel in any quality.
enum class CloneQuality {
  kFirst,  ///< while nothing better is there: within 2.7 levels on photographs
  kDrag,   ///< within a level
  kRest,   ///< within 0.3 levels
  kExport, ///< within 0.03 levels
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

  /// Makes the parts that a blend of that mode and quality needs, so that the blend itself does not wait for them.
  /// @errors clone.too-large, cancelled.
  Result<void> prepare(BlendMode mode, CloneQuality quality, const Watch& watch = {}) const;

  /// A solution on every pixel of the mask.
  struct Solution {
    /// By pixel number.
    std::vector<Channels> u;
    /// A bound on |u − A⁻¹ b| in any pixel and channel, in the values of b.
    double error = 0;
  };

  /// A u = b on the pixels, A and b as in guidance.h, whatever b is: what mixed gradients and export need.
  /// @errors clone.too-large, cancelled.
  Result<Solution> solve(std::span<const Channels> b, const Watch& watch = {}) const;

private:
  struct Data;
  explicit CloneSystem(std::shared_ptr<Data> data) : data_(std::move(data)) {}
  std::shared_ptr<Data> data_;
};

} // namespace oversketch
