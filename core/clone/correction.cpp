#include "core/clone/correction.h"

#include "core/base/check.h"
#include "core/clone/guidance.h"

#include <algorithm>
#include <span>

namespace oversketch {
namespace {

constexpr int kMostCycles = 40;

Float4 to_float(const Channels& c) {
  return {Float4::Lanes{static_cast<float>(c.v[0]), static_cast<float>(c.v[1]), static_cast<float>(c.v[2]), 0}};
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

std::vector<Float4> ring_values(const PlacedPair& pair, const PixelGraph& graph, double& range) {
  const std::vector<Channels> differences = ring_differences(pair, graph);
  range = range_of(differences);
  std::vector<Float4> ring(differences.size());
  std::transform(differences.begin(), differences.end(), ring.begin(), to_float);
  return ring;
}

Result<Correction> span_membrane(const PlacedPair& pair, const CloneSystem& system,
                                 const std::shared_ptr<const Membrane>& membrane, const Watch& watch) {
  const StageTimer timer(watch.times, "clone.solve");
  double range = 0;
  Correction out{membrane, membrane->solve(ring_values(pair, system.graph(), range)), nullptr, 0};
  out.error = membrane->error_share() * range;
  if (watch.stopped()) return cancelled();
  return out;
}

/// In four sums, so that none waits for the one before.
void write_ramp(const Float4& value, const Float4& step, int count, Float4* to) {
  const Float4 two = step + step, four = two + two;
  Float4 a = value, b = value + step, c = value + two, d = b + two;
  int i = 0;
  for (; i + 4 <= count; i += 4, a += four, b += four, c += four, d += four)
    to[i] = a, to[i + 1] = b, to[i + 2] = c, to[i + 3] = d;
  for (; i < count; ++i, a = b, b = c, c = d)
    to[i] = a;
}

void start_from(const Correction& start, const Mask& mask, MultigridSolve& solve) {
  std::vector<Float4> line;
  for (std::size_t run = 0; run < mask.runs().size(); ++run) {
    start.read(run, mask.runs()[run], line);
    solve.set_start(run, line);
  }
}

} // namespace

void Correction::read(std::size_t index, const Mask::Run& run, std::vector<Float4>& u) const {
  const auto count = static_cast<std::size_t>(run.x1 - run.x0);
  if (pixels || membrane)
    u.resize(count);
  else
    u.assign(count, Float4{});
  if (pixels) return pixels->get(index, u);
  if (!membrane) return;
  Float4* to = u.data();
  membrane->walk(
      values, index, run.y, [&](const Float4* at, int length) { to = std::copy_n(at, length, to); },
      [&](const Float4& value, const Float4& step, int length) {
        write_ramp(value, step, length, to);
        to += length;
      });
}

Result<void> Correction::refine(double wanted_error, const Watch& watch) {
  CHECK(pixels != nullptr, "what was solved on the pixels can be solved further");
  const StageTimer timer(watch.times, "clone.solve");
  // Two at least: how fast they go on, near float's rounding, the first cannot know.
  const auto solved = pixels->solve(wanted_error, 2, kMostCycles, watch);
  if (!solved) return solved.error();
  error = solved->error;
  return {};
}

Result<SolveWay> choose_way(const CloneSystem& system, const BlendOptions& options, CloneQuality quality,
                            const Watch& watch) {
  const bool is_mixed = options.mode == BlendMode::kMixed, is_export = quality == CloneQuality::kExport;
  SolveWay way{nullptr, true, kExportLevels, 1, kMostCycles};
  // Of bounds, for errors of 1.5 and 0.1 where mixed gradients are chosen: see MultigridSolve::Outcome.  After two
  // cycles from zero errors were 0.2 to 0.5 of them, 1.0 levels at the most (blob, snake, 16 k to 4 M pixels).
  if (quality == CloneQuality::kFirst || quality == CloneQuality::kDrag)
    way.tolerance_levels = is_mixed || options.screening > 0 ? 4.2 : 1, way.least = 2, way.most = 6;
  if (quality == CloneQuality::kRest) way.tolerance_levels = 0.18, way.least = 3, way.most = 20;
  // A membrane is no better a start than zero for what is mixed, and far from a screened solution.
  if (is_mixed || options.screening > 0) return way;
  const auto membrane = system.membrane(is_export ? CloneQuality::kDrag : quality, watch);
  if (!membrane) return membrane.error();
  way.membrane = *membrane;
  way.on_pixels = is_export || !way.membrane;
  return way;
}

Result<Correction> solve_correction(const PlacedPair& pair, const CloneSystem& system, const BlendOptions& options,
                                    CloneQuality quality, int threads, const Watch& watch) {
  const Result<SolveWay> way = choose_way(system, options, quality, watch);
  if (!way) return way.error();
  if (!way->on_pixels) return span_membrane(pair, system, way->membrane, watch);
  double range = 0;
  return solve_on_pixels(ring_values(pair, system.graph(), range), read_pair(pair), system, options, *way, threads,
                         watch);
}

Result<Correction> solve_on_pixels(const std::vector<Float4>& ring, const ReadPixels& read, const CloneSystem& system,
                                   const BlendOptions& options, const SolveWay& way, int threads, const Watch& watch) {
  const auto grids = system.pixels(options.screening, threads, watch);
  if (!grids) return grids.error();
  const StageTimer timer(watch.times, "clone.solve");
  MultigridSolve& solve = **grids;
  const PixelGraph& graph = system.graph();
  if (way.membrane)
    start_from({way.membrane, way.membrane->solve(ring), nullptr, 0}, graph.mask, solve);
  else
    solve.start_from_zero();
  if (watch.stopped()) return cancelled();
  // Of an imported gradient b is 0 but beside the ring: u is harmonic there.
  if (options.mode == BlendMode::kMixed)
    set_mixed_side(read, graph.mask, solve);
  else
    solve.set_ring_side(graph, ring);
  const double tolerance = way.tolerance_levels / 255 / largest_slope(options.domain, 1);
  const auto solved = solve.solve(tolerance, way.least, way.most, watch);
  if (!solved) return solved.error();
  return Correction{nullptr, {}, *grids, solved->error};
}

} // namespace oversketch
