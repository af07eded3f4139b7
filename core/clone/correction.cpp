#include "core/clone/correction.h"

#include "core/clone/guidance.h"

#include <algorithm>
#include <iterator>

namespace oversketch {
namespace {

Float4 to_float(const Channels& c) {
  return {Float4::Lanes{static_cast<float>(c.v[0]), static_cast<float>(c.v[1]), static_cast<float>(c.v[2]), 0}};
}

Channels to_channels(const Float4& f) {
  return {{f[0], f[1], f[2], 0}};
}

/// The widest range of a channel.
double range_of(const std::vector<Channels>& values) {
  double widest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto less = [k](const Channels& a, const Channels& b) { return a.v[k] < b.v[k]; };
    const auto [low, high] = std::minmax_element(values.begin(), values.end(), less);
    widest = std::max(widest, high->v[k] - low->v[k]);
  }
  return widest;
}

Result<Correction> span_membrane(const PlacedPair& pair, const CloneSystem& system, CloneQuality quality,
                                 const Watch& watch) {
  const auto made = system.membrane(quality, watch);
  if (!made) return made.error();
  const StageTimer timer(watch.times, "clone.solve");
  const Membrane& membrane = **made;
  const PixelGraph& graph = system.graph();
  const std::vector<Channels> differences = ring_differences(pair, graph);
  std::vector<Float4> ring(differences.size());
  std::transform(differences.begin(), differences.end(), ring.begin(), to_float);
  const MembraneValues values = membrane.solve(ring);
  if (watch.stopped()) return cancelled();

  Correction out{{}, membrane.error_share() * range_of(differences)};
  out.values.reserve(static_cast<std::size_t>(graph.count));
  const auto add_pixels = [&](const Float4* at, int count) {
    std::transform(at, at + count, std::back_inserter(out.values), to_channels);
  };
  const auto add_ramp = [&](const Float4& first, const Float4& step, int count) {
    for (int i = 0; i < count; ++i)
      out.values.push_back(to_channels(first + static_cast<float>(i) * step));
  };
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  for (std::size_t run = 0; run < runs.size(); ++run)
    membrane.walk(values, run, runs[run].y, add_pixels, add_ramp);
  return out;
}

} // namespace

Result<Correction> solve_correction(const PlacedPair& pair, const CloneSystem& system, BlendMode mode,
                                    CloneQuality quality, const Watch& watch) {
  if (mode != BlendMode::kMixed && quality != CloneQuality::kExport) return span_membrane(pair, system, quality, watch);
  if (const auto ready = system.prepare(mode, quality, watch); !ready) return ready.error();
  const StageTimer timer(watch.times, "clone.solve");
  const std::vector<Channels> side =
      mode == BlendMode::kMixed ? mixed_side(pair, system.graph()) : membrane_side(pair, system.graph());
  if (watch.stopped()) return cancelled();
  Result<CloneSystem::Solution> solved = system.solve(side, watch);
  if (!solved) return solved.error();
  return Correction{std::move(solved->u), solved->error};
}

} // namespace oversketch
