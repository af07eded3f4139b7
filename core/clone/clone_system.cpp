#include "core/clone/clone_system.h"

#include "core/base/check.h"
#include "core/clone/correction.h"
#include "core/clone/feather.h"
#include "core/clone/lazy.h"

#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

namespace oversketch {

struct CloneSystem::Data {
  /// The grids of one λ, and a solve that nobody holds.
  struct Grids {
    std::mutex making;
    std::optional<MaskMultigrid> made;
    std::unique_ptr<MultigridSolve> idle;
  };

  explicit Data(const Mask& mask) : graph(mask) {}

  PixelGraph graph;
  Lazy<std::vector<float>> depths;
  /// By quality.
  std::array<Lazy<std::optional<Membrane>>, 3> membranes;
  std::shared_ptr<Grids> grids = std::make_shared<Grids>();
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
  const auto made = data_->membranes[which].get([&]() -> Result<std::optional<Membrane>> {
    auto membrane = Membrane::make(graph(), 1 << which, watch);
    if (membrane) return std::optional(std::move(*membrane));
    if (membrane.error().code == "clone.no-membrane") return std::optional<Membrane>();
    return membrane.error();
  });
  if (!made) return made.error();
  return std::shared_ptr<const Membrane>(*made, (*made)->has_value() ? &***made : nullptr);
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
  if (quality == CloneQuality::kExport) return false;
  const auto made = data_->membranes[static_cast<std::size_t>(quality)].if_made();
  return made && made->has_value();
}

Result<void> CloneSystem::prepare(const BlendOptions& options, CloneQuality quality, const Watch& watch) const {
  if (options.mode == BlendMode::kNone) return {};
  const Result<SolveWay> way = choose_way(*this, options, quality, watch);
  if (!way) return way.error();
  if (way->on_pixels)
    if (const auto made = pixels(options.screening, 1, watch); !made) return made.error();
  return {};
}

Result<std::shared_ptr<MultigridSolve>> CloneSystem::pixels(double screening, int threads, const Watch& watch) const {
  const std::shared_ptr<Data::Grids> grids = data_->grids;
  std::unique_ptr<MultigridSolve> solve;
  {
    const std::scoped_lock lock(grids->making);
    if (!grids->made || grids->made->screening() != screening) {
      auto made = MaskMultigrid::make(mask(), screening, watch);
      if (!made) return made.error();
      grids->idle.reset();
      grids->made = std::move(*made);
    }
    solve = std::move(grids->idle);
    if (!solve) solve = std::make_unique<MultigridSolve>(*grids->made);
  }
  solve->use_threads(threads);
  const auto give_back = [grids, screening](MultigridSolve* done) {
    std::unique_ptr<MultigridSolve> held(done);
    const std::scoped_lock lock(grids->making);
    if (!grids->idle && grids->made->screening() == screening) grids->idle = std::move(held);
  };
  return std::shared_ptr<MultigridSolve>(solve.release(), give_back);
}

} // namespace oversketch
