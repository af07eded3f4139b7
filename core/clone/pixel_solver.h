#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/channels.h"
#include "core/clone/pixel_graph.h"
#include "core/geometry/mask.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace oversketch {

/// Solves Poisson's equation on the pixels of a mask, exactly: the reference way.
///
/// A u = b with A the 5-point Laplacian: 4 on the diagonal, −1 for each neighbour inside the mask; neighbours outside
/// are Dirichlet values and stand in b.  A depends on the mask alone: it is factored once (sparse Cholesky, approximate
/// minimum degree), and each move costs a forward and a back substitution of all channels at once.
///
/// Copies share the factor.
/// @threads const after making; one object may be used by several threads.
class PixelSolver {
public:
  /// @param most_bytes  refused when estimate_bytes(mask.count()) is above.
  /// @errors clone.empty-mask; clone.too-large; cancelled (asked between ordering and factorization).
  /// @cost on one core 0.13, 1 and 8.5 s for discs of 2¹⁶, 2¹⁸ and 2²⁰ pixels, keeping 360, 430 and 510 bytes a pixel.
  static Result<PixelSolver> make(const Mask& mask, const Watch& watch = {}, std::int64_t most_bytes = kMostBytes);

  const PixelGraph& graph() const;
  const Mask& mask() const { return graph().mask; }
  /// Pixels of the mask.
  int unknowns() const { return graph().count; }
  /// Of the factor.
  std::int64_t bytes() const;

  /// u = A⁻¹ b, both by pixel number of the graph, unknowns() values each.  Accuracy: see error_bound.
  /// @cost two passes over the factor: 6, 39 and 190 ms for the discs above; 32 bytes a pixel while it runs.
  std::vector<Channels> solve(std::span<const Channels> b) const;

  /// A bound on max |u − A⁻¹ b| in any channel, from the residual b − A u:  max |b − A u| · (m + 1)²/8, m the shorter
  /// side of the mask's box; for (m + 1)²/8 ≥ ‖A⁻¹‖∞ by comparison with the parabola across a strip of m pixels.
  double error_bound(std::span<const Channels> u, std::span<const Channels> b) const;

  /// 8 GB.
  static constexpr std::int64_t kMostBytes = 8'000'000'000;
  /// What making a solver of that many pixels may take at its peak, for the worst shape (a full square): measured and
  /// rounded up, see the .cpp.
  static std::int64_t estimate_bytes(std::int64_t pixels);

private:
  struct Data;
  explicit PixelSolver(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

} // namespace oversketch
