// What a new region and a new sketch cost, stage by stage.

#include "app/cli/bench_cases.h"

#include "core/deform/linear_start.h"
#include "core/deform/match.h"

#include <algorithm>
#include <cmath>

namespace oversketch::cli {
namespace {

/// A tie every 0.7 cell of the outline, and where the match has its other end.
struct Ties {
  std::vector<MeshTie> ties;
  Points targets;
};

Ties make_ties(const RegionMesh& region, const Match& match, const ClosedCurve& sketch) {
  Ties out;
  const ClosedCurve& outline = region.outline();
  const int count = static_cast<int>(std::ceil(outline.length() / (0.7 * region.mesh().cell)));
  for (int i = 0; i < count; ++i) {
    const double s = outline.length() * i / count;
    const CellPoint p = region.locate_outline(s);
    out.ties.push_back({p.cell, {(1 - p.u) * (1 - p.v), p.u * (1 - p.v), p.u * p.v, (1 - p.u) * p.v}});
    out.targets.push_back(sketch.at(match.sketch_at(s)));
  }
  return out;
}

Result<void> run_mesh(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const ClosedCurve outline(c.given.outline);
    const auto done = record.repeat("deform.mesh", c.given.name, input.runs,
                                    [&] { return FlipfreeSystem::make(outline, input.watch); });
    if (!done) return done.error();
  }
  return {};
}

Result<void> run_match(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const MatchSource source(c.flipfree.region().outline());
    const auto done = record.repeat("deform.match", c.given.name, input.runs,
                                    [&] { return match_curves(source, c.sketch, {}, {}, input.watch); });
    if (!done) return done.error();
  }
  return {};
}

Result<void> run_start(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const RegionMesh& region = c.flipfree.region();
    const auto matches = match_curves(MatchSource(region.outline()), c.sketch, {}, {}, input.watch);
    if (!matches) return at(c.given.name, matches.error());
    const Ties ties = make_ties(region, matches->front(), c.sketch);
    const auto start = LinearStart::make(region.mesh(), ties.ties, input.watch);
    if (!start) return at(c.given.name, start.error());
    const auto done = record.repeat("deform.start", c.given.name, input.runs,
                                    [&] { return Result<Points>(start->solve(ties.targets)); });
    if (!done) return done.error();
  }
  return {};
}

double stage_ms(const StageTimes& times, std::string_view stage) {
  double sum = 0;
  for (const auto& [name, ms] : times.stages_ms)
    if (name == stage) sum += ms;
  return sum;
}

/// The solver's part of a new sketch's processor time, by its part of the time by the clock, over its steps.
Result<void> run_newton_step(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases)
    for (int run = -1; run < input.runs; ++run) {
      StageTimes times;
      Watch watch = input.watch;
      watch.times = &times;
      const Stopwatch stopwatch;
      const auto solution = solve_flipfree(c.flipfree, c.given.sketch, {}, {}, nullptr, watch);
      const Spent all = stopwatch.spent();
      if (!solution) return at(c.given.name, solution.error());
      if (run < 0) continue;
      const double part = stage_ms(times, "solve") / all.wall_ms / std::max(1, solution->iterations);
      record.add("deform.newton_step", c.given.name, {part * all.cpu_ms, part * all.wall_ms});
      record.add_value("deform.newton_steps", c.given.name, solution->iterations);
    }
  return {};
}

Result<void> run_sketch(const BenchInput& input, BenchRecord& record, std::string_view row, double vertices) {
  for (const BenchCase& c : input.cases) {
    DeformOptions options;
    options.cell_px = cell_for(c.given.outline, vertices);
    DeformCounts counts;
    const auto system = DeformSystem::make(c.given.outline, options, &c.drawn, counts, input.watch);
    if (!system) return at(c.given.name, system.error());
    const auto done = record.repeat(row, c.given.name, input.runs, [&] {
      return system->deform(c.given.sketch, {}, options, nullptr, counts, input.watch);
    });
    if (!done) return done.error();
  }
  return {};
}

BenchGroup sketch_bench(const BenchRow& row, double vertices) {
  return {{row}, true, [name = row.name, vertices](const BenchInput& input, BenchRecord& record) {
            return run_sketch(input, record, name, vertices);
          }};
}

Result<void> run_display(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const QuadMesh& control = c.flipfree.region().mesh();
    const Points& positions = c.solved.flipfree->positions;
    const auto done = record.repeat("deform.display", c.given.name, input.runs,
                                    [&] { return Result<Points>(prolong(control, positions, c.display)); });
    if (!done) return done.error();
  }
  return {};
}

Result<void> run_display_mesh(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const double cell = cell_for(c.given.outline, kDrawnVertices);
    const auto done = record.repeat("deform.display_mesh", c.given.name, input.runs,
                                    [&] { return make_display_mesh(c.flipfree.region(), cell, input.watch); });
    if (!done) return done.error();
  }
  return {};
}

} // namespace

std::vector<BenchGroup> deform_benches() {
  return {
      {{{"deform.mesh", "ms", "a new region: mesh, handles, symbolic factor, factored start", {}, 3.3}},
       true,
       run_mesh},
      {{{"deform.match", "ms", "outline matched to sketch", {}, 8.5}}, true, run_match},
      {{{"deform.start", "ms", "linear start from a match, system factored", {}, 5.0}}, true, run_start},
      {{{"deform.newton_step", "ms", "one Newton step of a new sketch, with line search and sliding", {}, 2.5},
        {"deform.newton_steps", "count", "Newton steps of a new sketch", {}, {}}},
       true,
       run_newton_step},
      sketch_bench({"deform.sketch.5k", "ms", "a new sketch, to 5k vertices drawn", BenchGoal{25}, 32.0}, 5'000),
      sketch_bench({"deform.sketch.20k", "ms", "a new sketch, to 20k vertices drawn", BenchGoal{25}, 32.0}, 20'000),
      sketch_bench({"deform.sketch.100k", "ms", "a new sketch, to 100k vertices drawn", BenchGoal{28}, 34.0}, 100'000),
      {{{"deform.display", "ms", "solution carried to 20k vertices", {}, 0.2}}, true, run_display},
      {{{"deform.display_mesh", "ms", "another display cell: mesh of 20k vertices", {}, {}}}, true, run_display_mesh},
  };
}

} // namespace oversketch::cli
