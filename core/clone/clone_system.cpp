#include "core/clone/clone_system.h"

#include <limits>
#include <mutex>

namespace oversketch {
namespace {

/// A part that is made when it is first wanted.
template <class T>
class Lazy {
public:
  template <class Make>
  Result<std::shared_ptr<const T>> get(Make make) {
    const std::scoped_lock lock(making_);
    if (!part_) {
      Result<T> made = make();
      if (!made) return made.error();
      part_ = std::make_shared<const T>(std::move(*made));
    }
    return part_;
  }

private:
  std::mutex making_;
  std::shared_ptr<const T> part_;
};

} // namespace

struct CloneSystem::Data {
  explicit Data(const Mask& mask) : graph(mask) {}

  PixelGraph graph;
  Lazy<PixelSolver> pixels;

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

Result<void> CloneSystem::prepare(BlendMode mode, CloneQuality, const Watch& watch) const {
  if (mode == BlendMode::kNone) return {};
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
