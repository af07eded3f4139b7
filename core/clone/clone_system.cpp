#include "core/clone/clone_system.h"

#include "core/base/check.h"
#include "core/clone/feather.h"
#include "core/clone/lazy.h"

#include <array>
#include <cmath>
#include <limits>

namespace oversketch {
struct CloneSystem::Data {
  explicit Data(const Mask& mask) : graph(mask) {}

  PixelGraph graph;
  Lazy<PixelSolver> pixels;
  Lazy<std::vector<float>> depths;
  /// By quality.
  std::array<Lazy<Membrane>, 3> membranes;

  Result<std::shared_ptr<const PixelSolver>> full(const Watch& watch) {
    return pixels.get([&] { return PixelSolver::make(graph.mask, watch); });
  }
};

Result<CloneSystem> CloneSystem::make(const Mask& mask) {
  if (mask.empty()) return Error{"clone.empty-mask", "The region covers no pixel: make it larger.", ""};
  if (mask.count() > std::numeric_limits<int>::max())
    return Error{
        "clone.too-large",
        "The region has " + std::to_string(mask.count()) + " pixels, more than can be numbered: make it smaller.", ""};
  return CloneSystem(std::make_shared<Data>(mask));
}

const PixelGraph& CloneSystem::graph() const {
  return data_->graph;
}

Result<std::shared_ptr<const Membrane>> CloneSystem::membrane(CloneQuality quality, const Watch& watch) const {
  CHECK(quality != CloneQuality::kExport, "export is solved on every pixel");
  const auto which = static_cast<std::size_t>(quality);
  return data_->membranes[which].get([&] { return Membrane::make(graph(), 1 << which, watch); });
}

std::shared_ptr<const std::vector<float>> CloneSystem::depths() const {
  return data_->depths
      .get([&]() -> Result<std::vector<float>> {
        std::vector<float> depths;
        for (const double squared : squared_depths(graph()))
          depths.push_back(static_cast<float>(std::sqrt(squared)));
        return depths;
      })
      .value();
}

bool CloneSystem::has_membrane(CloneQuality quality) const {
  return quality != CloneQuality::kExport && data_->membranes[static_cast<std::size_t>(quality)].is_made();
}

Result<void> CloneSystem::prepare(BlendMode mode, CloneQuality quality, const Watch& watch) const {
  if (mode == BlendMode::kNone) return {};
  if (mode != BlendMode::kMixed && quality != CloneQuality::kExport) {
    if (const auto made = membrane(quality, watch); !made) return made.error();
    return {};
  }
  if (const auto made = data_->full(watch); !made) return made.error();
  return {};
}

Result<CloneSystem::Solution> CloneSystem::solve(std::span<const Channels> b, const Watch& watch) const {
  const auto solver = data_->full(watch);
  if (!solver) return solver.error();
  if (watch.stopped()) return cancelled();
  Solution out{(*solver)->solve(b), 0};
  if (watch.stopped()) return cancelled();
  out.error = (*solver)->error_bound(out.u, b);
  return out;
}

} // namespace oversketch
