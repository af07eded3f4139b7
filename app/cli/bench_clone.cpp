// The membrane and the live painting: set-up, a move, memory, and how far from the exact solution.

#include "app/cli/bench_cases.h"
#include "app/cli/bench_floor.h"
#include "app/cli/bench_shapes.h"

#include "core/base/check.h"
#include "core/clone/live.h"
#include "core/clone/live_data.h"
#include "core/clone/pixel_solver.h"
#include "core/image/display.h"
#include "core/warp/warp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oversketch::cli {
namespace {

struct MembraneSize {
  std::string name;
  double pixels = 0;
  // For the smooth shape: a move at k = 2, ms, its multiple of the floor, bytes a pixel.
  double move_ms = 0, floors = 0, bytes = 0;
  // Of the prototype, at k = 1, 2, 4: a move, ms; at k = 2 the set-up.
  std::array<std::optional<double>, 3> prototype_ms;
  std::optional<double> prototype_setup_ms;
};

struct Shape {
  std::string name;
  Mask (*make)(double pixels) = nullptr;
};

const std::array kQualities{CloneQuality::kFirst, CloneQuality::kDrag, CloneQuality::kRest};

std::string suffix(CloneQuality quality) {
  return ".k" + std::to_string(1 << static_cast<int>(quality));
}

struct Scene {
  CloneSystem system;
  LiveRegion region;
  Raster<Rgba8> below, out;
};

Result<Scene> make_scene(const Mask& mask) {
  const Rect box = mask.bounds();
  const auto source = unwarped_region(Image(make_picture(box.right() + 8, box.bottom() + 8, 1)), mask);
  if (!source) return source.error();
  auto system = CloneSystem::make(mask);
  if (!system) return system.error();
  auto region = LiveRegion::make(*source, *system);
  if (!region) return region.error();
  Raster<Rgba8> below = to_display(Image(make_picture(box.right() + 40, box.bottom() + 40, 2)));
  Raster<Rgba8> out = below;
  return Scene{std::move(*system), std::move(*region), std::move(below), std::move(out)};
}

/// The floor of a move.
void mix_runs(Scene& scene) {
  const LivePixel* g = scene.region.data().pixels.data();
  for (const Mask::Run& run : scene.system.mask().runs()) {
    const int count = run.x1 - run.x0;
    mix_pixels(g, &scene.below.at(run.x0, run.y), count, &scene.out.at(run.x0, run.y));
    g += count;
  }
}

/// What a system keeps for one membrane.
double bytes_of(const PixelGraph& graph, const Membrane& membrane) {
  return static_cast<double>(membrane.bytes()) + 16.0 * static_cast<double>(graph.mask.runs().size()) +
         12.0 * static_cast<double>(graph.stretches.size() + graph.ring.size());
}

/// u by pixel number.
std::vector<Float4> read_all(const Membrane& membrane, const PixelGraph& graph, const std::vector<Float4>& ring) {
  const MembraneValues values = membrane.solve(ring);
  std::vector<Float4> out;
  out.reserve(static_cast<std::size_t>(graph.count));
  for (std::size_t run = 0; run < graph.mask.runs().size(); ++run)
    membrane.walk(
        values, run, graph.mask.runs()[run].y,
        [&](const Float4* at, int count) { out.insert(out.end(), at, at + count); },
        [&](Float4 value, const Float4& step, int count) {
          for (int i = 0; i < count; ++i, value += step)
            out.push_back(value);
        });
  return out;
}

/// Differences on the ring, in levels: of the two pictures in channels 0 and 1; white noise over 255 levels in
/// channel 2.
std::vector<Float4> make_ring(const Scene& scene) {
  BenchRandom random(7);
  std::vector<Float4> ring;
  const PixelGraph& graph = scene.system.graph();
  for (std::size_t i = 0; i < graph.ring.size(); ++i) {
    const PixelGraph::RingEdge& edge = graph.ring[i];
    const Rgba &source = scene.region.data().ring[i], target = from_display(scene.below.at(edge.x, edge.y));
    ring.push_back({Float4::Lanes{255 * (target.r - source.r), 255 * (target.b - source.b),
                                  static_cast<float>(random.between(-127.5, 127.5)), 0}});
  }
  return ring;
}

Result<std::vector<Channels>> solve_exactly(const PixelGraph& graph, const std::vector<Float4>& ring,
                                            const Watch& watch) {
  const auto solver = PixelSolver::make(graph.mask, watch);
  if (!solver) return solver.error();
  std::vector<Channels> side(static_cast<std::size_t>(graph.count));
  for (std::size_t i = 0; i < ring.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      side[static_cast<std::size_t>(graph.ring[i].pixel)].v[k] += static_cast<double>(ring[i][k]);
  return solver->solve(side);
}

Result<void> measure_errors(const std::string& name, const Scene& scene, const Watch& watch, BenchRecord& record) {
  const PixelGraph& graph = scene.system.graph();
  const std::vector<Float4> ring = make_ring(scene);
  const auto exact = solve_exactly(graph, ring, watch);
  if (!exact) return exact.error();
  for (const CloneQuality quality : kQualities) {
    const auto membrane = scene.system.membrane(quality, watch);
    if (!membrane) return membrane.error();
    CHECK(*membrane, "smooth shapes have membranes");
    const std::vector<Float4> near = read_all(**membrane, graph, ring);
    double worst = 0, sum = 0, noise = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const auto error = [&](std::size_t k) { return std::abs(near[i][k] - (*exact)[i].v[k]); };
      worst = std::max({worst, error(0), error(1)});
      sum += (error(0) + error(1)) / 2;
      noise = std::max(noise, error(2));
    }
    record.add_value(name + ".worst" + suffix(quality), "", worst);
    record.add_value(name + ".mean" + suffix(quality), "", sum / static_cast<double>(near.size()));
    record.add_value(name + ".noise" + suffix(quality), "", noise);
  }
  return {};
}

Result<void> run_membrane(const std::string& name, const Mask& mask, bool has_reference, const BenchInput& input,
                          BenchRecord& record) {
  auto scene = make_scene(mask);
  if (!scene) return scene.error();
  const PixelGraph& graph = scene->system.graph();
  const auto floor = [&] {
    mix_runs(*scene);
    return Result<void>();
  };
  for (const CloneQuality quality : kQualities) {
    const int k = 1 << static_cast<int>(quality);
    const auto set_up = [&] { return Membrane::make(graph, k, input.watch); };
    if (auto done = record.repeat(name + ".setup" + suffix(quality), "", input.runs, set_up); !done) return done;
    int moves = 0;
    const auto move = [&] {
      const int shift = moves++ % 16;
      return clone_live(scene->below, scene->out, scene->region, scene->system, shift, 16 - shift, {}, quality, 1,
                        input.watch);
    };
    if (auto done = record.repeat(name + ".move" + suffix(quality), "", 4 * input.runs, move); !done) return done;
    if (auto done = record.repeat(name + ".floor", "", 4 * input.runs, floor); !done) return done;
    const auto made = scene->system.membrane(quality, input.watch);
    if (!made) return made.error();
    CHECK(*made, "smooth shapes have membranes");
    record.add_value(name + ".bytes" + suffix(quality), "", bytes_of(graph, **made) / static_cast<double>(graph.count));
  }
  const auto least = record.summarize(name + ".floor");
  for (const CloneQuality quality : kQualities) {
    const auto moved = record.summarize(name + ".move" + suffix(quality));
    if (moved && least) record.add_value(name + ".floors" + suffix(quality), "", moved->median / least->median);
  }
  return has_reference ? measure_errors(name, *scene, input.watch, record) : Result<void>();
}

std::vector<BenchRow> rows_of(const std::string& name, const MembraneSize& size, bool has_goals, bool has_reference) {
  const auto most = [&](double value) {
    return has_goals ? std::optional(BenchGoal{value, BenchStatistic::kMedian}) : std::nullopt;
  };
  std::vector<BenchRow> rows;
  for (const CloneQuality quality : kQualities) {
    const bool drags = quality == CloneQuality::kDrag;
    const std::string k = suffix(quality), of = ", k = " + k.substr(2);
    const auto at = static_cast<std::size_t>(quality);
    rows.push_back({name + ".setup" + k,
                    "ms",
                    "membrane made" + of,
                    {},
                    has_goals && drags ? size.prototype_setup_ms : std::nullopt});
    rows.push_back({name + ".move" + k, "ms", "  a move, painted", drags ? most(size.move_ms) : std::nullopt,
                    has_goals ? size.prototype_ms[at] : std::nullopt});
    rows.push_back(
        {name + ".floors" + k, "ratio", "  a move by the floor", drags ? most(size.floors) : std::nullopt, {}});
    rows.push_back({name + ".bytes" + k, "B", "  kept, a pixel", drags ? most(size.bytes) : std::nullopt, {}});
    if (!has_reference) continue;
    const BenchGoal level{1, BenchStatistic::kMedian};
    rows.push_back(
        {name + ".worst" + k, "level", "  worst error, pictures", drags ? std::optional(level) : std::nullopt, {}});
    rows.push_back({name + ".mean" + k, "level", "  mean error, pictures", {}, {}});
    rows.push_back({name + ".noise" + k, "level", "  worst error, white noise", {}, {}});
  }
  rows.push_back({name + ".floor", "ms", "both pictures read, one written", {}, {}});
  return rows;
}

} // namespace

std::vector<BenchGroup> membrane_benches() {
  const MembraneSize sizes[] = {{"65k", 65'536, 0, 0, 0, {}, {}},
                                {"262k", 262'144, 0.9, 6, 13, {0.5, 0.83, 1.6}, 26},
                                {"1m", 1'048'576, 2.2, 4, 7, {1.4, 2.1, 4.0}, 61},
                                {"4m", 4'194'304, 6.5, 2.8, 4, {4.5, 6.8, 12}, 155}};
  std::vector<BenchGroup> groups;
  for (const MembraneSize& size : sizes)
    for (const Shape& shape : {Shape{"blob", make_blob}, {"snake", make_snake}, {"holed", make_holed}}) {
      const std::string name = "clone.membrane." + size.name + "." + shape.name;
      const bool has_goals = shape.make == make_blob && size.move_ms > 0;
      // The exact solution of the largest would take minutes and gigabytes.
      const bool has_reference = size.pixels < 2e6;
      groups.push_back({rows_of(name, size, has_goals, has_reference), false,
                        [=, pixels = size.pixels](const BenchInput& input, BenchRecord& record) {
                          return run_membrane(name, shape.make(pixels), has_reference, input, record);
                        }});
    }
  return groups;
}

} // namespace oversketch::cli
