// The paper's method: its table, and what a second sketch costs once the region is prepared.

#include "app/cli/bench_cases.h"

#include "core/deform/cleanup.h"
#include "core/deform/paper.h"

#include <algorithm>
#include <string>

namespace oversketch::cli {
namespace {

/// A piece of work split by its stages: their parts of the time by the clock, taken of the processor time.
struct Staged {
  Spent all;
  StageTimes times;

  Spent of(std::initializer_list<std::string_view> stages) const {
    double sum = 0;
    for (const auto& [name, ms] : times.stages_ms)
      if (std::find(stages.begin(), stages.end(), name) != stages.end()) sum += ms;
    const double part = sum / all.wall_ms;
    return {part * all.cpu_ms, part * all.wall_ms};
  }
};

struct TableRun {
  int vertices = 0;
  double energy = 0;
  Staged made, solved;
};

Result<TableRun> run_once(const ClosedCurve& outline, const ClosedCurve& sketch, double cell_px, const Watch& watch) {
  TableRun run;
  Watch staged = watch;
  staged.times = &run.made.times;
  const Stopwatch making;
  auto region = make_region_mesh(outline, cell_px, MeshKind::kTrimmed, staged);
  if (!region) return region.error();
  run.vertices = static_cast<int>(region->mesh().vertices.size());
  const auto system = PaperSystem::make(std::make_shared<const RegionMesh>(std::move(*region)), 1.0, staged);
  if (!system) return system.error();
  run.made.all = making.spent();
  staged.times = &run.solved.times;
  const Stopwatch solving;
  const auto solution = solve_paper(*system, sketch, {}, {}, staged);
  if (!solution) return solution.error();
  run.solved.all = solving.spent();
  run.energy = solution->energies.back();
  return run;
}

Result<void> run_table(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    if (c.given.name != "fish") continue;
    const ClosedCurve outline(c.given.outline);
    const auto sketch = clean_sketch(c.given.sketch, 1.0);
    if (!sketch) return at(c.given.name, sketch.error());
    for (const int cell : {20, 10, 5})
      for (int i = -1; i < input.runs; ++i) {
        const auto run = run_once(outline, sketch->curve, cell, input.watch);
        if (!run) return at(c.given.name, run.error());
        if (i < 0) continue;
        const std::string row = "paper.table." + std::to_string(cell);
        record.add_value(row + ".vertices", c.given.name, run->vertices);
        record.add(row + ".init", c.given.name, run->made.of({"mesh", "matrix"}));
        record.add(row + ".factor", c.given.name, run->made.of({"symbolic", "factor"}));
        record.add(row + ".iterations", c.given.name, run->solved.of({"iterations"}));
        record.add_value(row + ".energy", c.given.name, run->energy);
      }
  }
  return {};
}

Result<void> run_second_sketch(const BenchInput& input, BenchRecord& record) {
  constexpr double kCell = 10;
  for (const BenchCase& c : input.cases) {
    const ClosedCurve outline(c.given.outline);
    const auto make = [&]() -> Result<PaperSystem> {
      auto region = make_region_mesh(outline, kCell, MeshKind::kTrimmed, input.watch);
      if (!region) return region.error();
      return PaperSystem::make(std::make_shared<const RegionMesh>(std::move(*region)), 1.0, input.watch);
    };
    const auto sketch = clean_sketch(c.given.sketch, 1.0);
    if (!sketch) return at(c.given.name, sketch.error());
    auto done = record.repeat("paper.first_sketch", c.given.name, input.runs, [&]() -> Result<PaperSolution> {
      const auto system = make();
      if (!system) return system.error();
      return solve_paper(*system, sketch->curve, {}, {}, input.watch);
    });
    if (!done) return done.error();
    const auto system = make();
    if (!system) return at(c.given.name, system.error());
    done = record.repeat("paper.second_sketch", c.given.name, input.runs,
                         [&] { return solve_paper(*system, sketch->curve, {}, {}, input.watch); });
    if (!done) return done.error();
  }
  return {};
}

std::vector<BenchRow> table_rows() {
  return {
      {"paper.table.20.vertices", "count", "fish in 20 px cells: vertices", {}, {}},
      {"paper.table.20.init", "ms", "  mesh and matrix", {}, {}},
      {"paper.table.20.factor", "ms", "  factorization", {}, {}},
      {"paper.table.20.energy", "px2", "  energy after 50 iterations", {}, {}},
      {"paper.table.20.iterations", "ms", "  50 iterations", {}, {}},
      {"paper.table.10.vertices", "count", "fish in 10 px cells: vertices", {}, {}},
      {"paper.table.10.init", "ms", "  mesh and matrix", {}, {}},
      {"paper.table.10.factor", "ms", "  factorization", {}, {}},
      {"paper.table.10.energy", "px2", "  energy after 50 iterations", {}, {}},
      {"paper.table.10.iterations", "ms", "  50 iterations", {}, {}},
      {"paper.table.5.vertices", "count", "fish in 5 px cells: vertices", {}, {}},
      {"paper.table.5.init", "ms", "  mesh and matrix", {}, {}},
      {"paper.table.5.factor", "ms", "  factorization", {}, {}},
      {"paper.table.5.energy", "px2", "  energy after 50 iterations", {}, {}},
      {"paper.table.5.iterations", "ms", "  50 iterations", {}, {}},
  };
}

} // namespace

std::vector<BenchGroup> paper_benches() {
  return {
      {table_rows(), true, run_table},
      {{{"paper.first_sketch", "ms", "mesh, factor and 50 iterations, 10 px cells", {}, {}},
        {"paper.second_sketch", "ms", "50 iterations on a prepared region, 10 px cells", {}, {}}},
       true,
       run_second_sketch},
  };
}

} // namespace oversketch::cli
