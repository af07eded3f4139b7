// What is solved on every pixel: mixed gradients while dragging and at rest, and export.

#include "app/cli/bench_cases.h"
#include "app/cli/bench_shapes.h"

#include "core/clone/correction.h"
#include "core/clone/guidance.h"
#include "core/clone/live.h"
#include "core/clone/mixed_rows.h"
#include "core/clone/pixel_solver.h"
#include "core/image/display.h"
#include "core/warp/warp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oversketch::cli {
namespace {

struct MixedSize {
  std::string name;
  double pixels = 0;
  // For the smooth shape: a mixed move while dragging, an export, ms; and what the prototype took.
  std::optional<double> drag_ms, export_ms, drag_prototype_ms, export_prototype_ms;
};

struct MixedShape {
  std::string name;
  Mask (*make)(double pixels) = nullptr;
};

constexpr int kShift = 8;

struct MixedScene {
  CloneSystem system;
  WarpedRegion source;
  Raster<Rgba> target;
};

Result<MixedScene> make_mixed_scene(const Mask& mask) {
  const Rect box = mask.bounds();
  auto source = unwarped_region(Image(make_picture(box.right() + 8, box.bottom() + 8, 1)), mask);
  if (!source) return source.error();
  auto system = CloneSystem::make(mask);
  if (!system) return system.error();
  // Eight bits, as on the screen.
  const Raster<Rgba8> levels = to_display(Image(make_picture(box.right() + 40, box.bottom() + 40, 2)));
  Raster<Rgba> target(levels.width(), levels.height());
  std::transform(levels.values().begin(), levels.values().end(), target.values().begin(), from_display);
  return MixedScene{std::move(*system), std::move(*source), std::move(target)};
}

BlendOptions with_mode(BlendMode mode) {
  BlendOptions options;
  options.mode = mode;
  return options;
}

/// By a factor up to a million pixels, else by as many cycles as float has use for.
Result<std::vector<Float4>> solve_exactly(const PlacedPair& pair, const MixedScene& scene, bool is_mixed,
                                          const Watch& watch) {
  const PixelGraph& graph = scene.system.graph();
  std::vector<Float4> out;
  out.reserve(static_cast<std::size_t>(graph.count));
  if (graph.count < 2'000'000) {
    const auto solver = PixelSolver::make(graph.mask, watch);
    if (!solver) return solver.error();
    for (const Channels& c : solver->solve(is_mixed ? mixed_side(pair, graph) : membrane_side(pair, graph)))
      out.push_back(
          {Float4::Lanes{static_cast<float>(c.v[0]), static_cast<float>(c.v[1]), static_cast<float>(c.v[2])}});
    return out;
  }
  const auto solve = scene.system.pixels(0, 1, watch);
  if (!solve) return solve.error();
  const auto near = solve_correction(pair, scene.system, with_mode(is_mixed ? BlendMode::kMixed : BlendMode::kImport),
                                     CloneQuality::kExport, 1, watch);
  if (!near) return near.error();
  // Ten cycles more, on the side that is still there.
  const auto pixels = std::const_pointer_cast<MultigridSolve>(near->pixels);
  if (const auto more = pixels->solve(0, 10, 10, watch); !more) return more.error();
  std::vector<Float4> line;
  for (std::size_t run = 0; run < graph.mask.runs().size(); ++run) {
    near->read(run, graph.mask.runs()[run], line);
    out.insert(out.end(), line.begin(), line.end());
  }
  return out;
}

void record_errors(const std::string& name, const Correction& correction, const std::vector<Float4>& exact,
                   const Mask& mask, BenchRecord& record) {
  double worst = 0, sum = 0;
  std::size_t pixel = 0;
  std::vector<Float4> line;
  for (std::size_t run = 0; run < mask.runs().size(); ++run) {
    correction.read(run, mask.runs()[run], line);
    for (const Float4& u : line) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double error = 255 * std::abs(static_cast<double>(u[k] - exact[pixel][k]));
        worst = std::max(worst, error);
        sum += error / 3;
      }
      ++pixel;
    }
  }
  record.add_value(name + ".worst", "", worst);
  record.add_value(name + ".mean", "", sum / static_cast<double>(exact.size()));
}

Result<void> measure_errors(const std::string& name, const MixedScene& scene, BlendMode mode, CloneQuality quality,
                            const std::vector<Float4>& exact, const PlacedPair& pair, const Watch& watch,
                            BenchRecord& record) {
  const auto correction = solve_correction(pair, scene.system, with_mode(mode), quality, 1, watch);
  if (!correction) return correction.error();
  record_errors(name, *correction, exact, scene.system.mask(), record);
  return {};
}

/// From zero: what the cycles do without a membrane's help.
Result<void> measure_cycles(const std::string& name, const MixedScene& scene, const PlacedPair& pair,
                            const Watch& watch, BenchRecord& record) {
  const auto grids = MaskMultigrid::make(scene.system.mask(), 0, watch);
  if (!grids) return grids.error();
  MultigridSolve solve(*grids);
  set_mixed_side(read_pair(pair), scene.system.mask(), solve);
  const auto done = solve.solve(0, 4, 4, watch);
  if (!done) return done.error();
  record.add_value(name + ".contraction", "", done->contraction);
  record.add_value(name + ".bytes", "", static_cast<double>(grids->bytes() + solve.bytes()) / grids->unknowns());
  return {};
}

Result<void> run_mixed(const std::string& name, const Mask& mask, const BenchInput& input, BenchRecord& record) {
  const auto scene = make_mixed_scene(mask);
  if (!scene) return scene.error();
  const BlendOptions options = with_mode(BlendMode::kMixed);
  const auto set_up = [&] { return MaskMultigrid::make(mask, 0, input.watch); };
  if (auto done = record.repeat(name + ".setup", "", input.runs, set_up); !done) return done;
  const auto region = LiveRegion::make(scene->source, scene->system);
  if (!region) return region.error();
  const Raster<Rgba8> below = to_display(Image(scene->target));
  Raster<Rgba8> out = below;
  const PlacedPair still(scene->target, scene->source, kShift, kShift, options);
  const auto exact = solve_exactly(still, *scene, true, input.watch);
  if (!exact) return exact.error();
  for (const auto& kind : {std::pair{".drag", CloneQuality::kDrag}, std::pair{".rest", CloneQuality::kRest}}) {
    const std::string part = kind.first;
    const CloneQuality quality = kind.second;
    int moves = 0;
    const auto solve = [&] {
      const int shift = moves++ % 16;
      return solve_correction(PlacedPair(scene->target, scene->source, shift, 16 - shift, options), scene->system,
                              options, quality, 1, input.watch);
    };
    if (auto done = record.repeat(name + part + ".solve", "", input.runs, solve); !done) return done;
    const auto move = [&] {
      const int shift = moves++ % 16;
      return clone_live(below, out, *region, scene->system, shift, 16 - shift, options, quality, 1, input.watch);
    };
    if (auto done = record.repeat(name + part, "", input.runs, move); !done) return done;
    if (auto done = measure_errors(name + part, *scene, BlendMode::kMixed, quality, *exact, still, input.watch, record);
        !done)
      return done;
  }
  return measure_cycles(name, *scene, still, input.watch, record);
}

Result<void> run_export(const std::string& name, const Mask& mask, const BenchInput& input, BenchRecord& record) {
  const auto scene = make_mixed_scene(mask);
  if (!scene) return scene.error();
  int moves = 0;
  const auto solve = [&] {
    const int shift = moves++ % 16;
    return solve_correction(PlacedPair(scene->target, scene->source, shift, 16 - shift, {}), scene->system, {},
                            CloneQuality::kExport, 1, input.watch);
  };
  if (auto done = record.repeat(name, "", input.runs, solve); !done) return done;
  const PlacedPair still(scene->target, scene->source, kShift, kShift, {});
  const auto exact = solve_exactly(still, *scene, false, input.watch);
  if (!exact) return exact.error();
  return measure_errors(name, *scene, BlendMode::kImport, CloneQuality::kExport, *exact, still, input.watch, record);
}

std::optional<BenchGoal> most(std::optional<double> value) {
  return value ? std::optional(BenchGoal{*value, BenchStatistic::kMedian}) : std::nullopt;
}

std::vector<BenchRow> mixed_rows(const std::string& name, const MixedSize& size, bool has_goals) {
  const auto goal = [&](std::optional<double> value) { return has_goals ? most(value) : std::nullopt; };
  return {{name + ".setup", "ms", "mixed: grids made", {}, {}},
          {name + ".drag", "ms", "  a move while dragging, painted", goal(size.drag_ms),
           has_goals ? size.drag_prototype_ms : std::nullopt},
          {name + ".drag.solve", "ms", "    of it right-hand side and solution", {}, {}},
          {name + ".drag.worst", "level", "    worst error", most(1.5), {}},
          {name + ".drag.mean", "level", "    mean error", most(0.1), {}},
          {name + ".rest", "ms", "  at rest, painted", {}, {}},
          {name + ".rest.solve", "ms", "    of it right-hand side and solution", {}, {}},
          {name + ".rest.worst", "level", "    worst error", {}, {}},
          {name + ".rest.mean", "level", "    mean error", {}, {}},
          {name + ".contraction", "ratio", "  of the error, the fourth cycle", most(0.3), {}},
          {name + ".bytes", "B", "  grids and values, a pixel", most(36), {}}};
}

std::vector<BenchRow> export_rows(const std::string& name, const MixedSize& size, bool has_goals) {
  return {{name, "ms", "export: membrane, cycles to 0.03 levels", has_goals ? most(size.export_ms) : std::nullopt,
           has_goals ? size.export_prototype_ms : std::nullopt},
          {name + ".worst", "level", "  worst error", most(0.03), {}},
          {name + ".mean", "level", "  mean error", {}, {}}};
}

} // namespace

std::vector<BenchGroup> mixed_benches() {
  const MixedSize sizes[] = {{"65k", 65'536, {}, {}, {}, {}},
                             {"262k", 262'144, 4.5, 4, 4.4, 3.7},
                             {"1m", 1'048'576, 17, 17, 19, 17},
                             {"4m", 4'194'304, 85, 90, 102, 87}};
  using Run = Result<void> (*)(const std::string&, const Mask&, const BenchInput&, BenchRecord&);
  std::vector<BenchGroup> groups;
  for (const MixedSize& size : sizes)
    for (const MixedShape& shape : {MixedShape{"blob", make_blob}, {"snake", make_snake}, {"holed", make_holed}}) {
      const auto add = [&](const std::string& name, std::vector<BenchRow> rows, Run run) {
        groups.push_back({std::move(rows), false,
                          [=, make = shape.make, pixels = size.pixels](const BenchInput& input, BenchRecord& record) {
                            return run(name, make(pixels), input, record);
                          }});
      };
      const bool has_goals = shape.make == make_blob;
      const std::string where = size.name + "." + shape.name;
      add("clone.mixed." + where, mixed_rows("clone.mixed." + where, size, has_goals), run_mixed);
      add("clone.export." + where, export_rows("clone.export." + where, size, has_goals), run_export);
    }
  return groups;
}

} // namespace oversketch::cli
