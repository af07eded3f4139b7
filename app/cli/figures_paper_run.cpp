#include "app/cli/figures_paper.h"

#include "core/base/file.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace oversketch::cli {
namespace {

constexpr std::array<double, 3> kTableCells = {20, 10, 5};
/// Of so many runs the table has the median.
constexpr int kTableRuns = 5;

double time_of(const StageTimes& times, std::initializer_list<std::string_view> stages) {
  double sum = 0;
  for (const auto& [stage, ms] : times.stages_ms)
    if (std::find(stages.begin(), stages.end(), stage) != stages.end()) sum += ms;
  return sum;
}

/// The curve run clockwise on a screen, as meshes have it.
ClosedCurve clockwise(const ClosedCurve& curve) {
  if (curve.signed_area() > 0) return curve;
  return ClosedCurve(Points(curve.points().rbegin(), curve.points().rend()));
}

/// Where `initial` starts: the outline's first point and its place on the sketch.
Result<PaperOptions::StartPair> find_start(const ClosedCurve& outline, const ClosedCurve& sketch,
                                           const PaperSetup& setup, const Watch& watch) {
  DeformOptions options;
  options.method = Method::kInitial;
  options.cell_px = setup.cell_px;
  const auto solved = solve_case({"", outline.points(), sketch.points(), {}, {}}, options, watch);
  if (!solved) return solved.error();
  return PaperOptions::StartPair{0, solved->deformation.correspondence.front() * sketch.length()};
}

/// Times of one stage over several runs.
double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

Result<Json> table_row(const FigureCase& shown, double cell_px, const Watch& watch) {
  std::vector<PaperRun> runs;
  for (int i = 0; i < kTableRuns; ++i) {
    auto run = run_paper(shown, {cell_px, 1, 50}, watch);
    if (!run) return run.error();
    runs.push_back(std::move(*run));
  }
  const auto seconds = [&](double PaperRun::*stage) {
    std::vector<double> values;
    for (const PaperRun& run : runs)
      values.push_back(run.*stage / 1e3);
    return median(std::move(values));
  };
  const PaperRun& run = runs.front();
  Json row;
  row["cell_px"] = cell_px;
  row["vertices"] = run.mesh->vertices.size();
  row["handles"] = run.solution.handles.size();
  row["init_s"] = seconds(&PaperRun::mesh_ms) + seconds(&PaperRun::matrix_ms);
  row["factor_s"] = seconds(&PaperRun::factor_ms);
  row["energy_start_px2"] = run.solution.energies.front();
  row["energy_px2"] = run.solution.energies.back();
  row["iterations_50_s"] = seconds(&PaperRun::steps_ms);
  row["flipped_cells"] = run.distortion.flipped_cells;
  return row;
}

std::string table_text(const std::string& name, const Json& rows) {
  std::string text = "# The paper's method, " + name +
                     ": times in seconds\n\n"
                     "init: mesh and matrix of the energy; factor: its factorization, once for all sketches; E_d: the "
                     "energy after 50 steps (at the start).\n\n"
                     "| cell px | vertices | handles | init | factor | E_d px² | 50 iterations | flipped cells |\n"
                     "|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const Json& row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "| %g | %d | %d | %.4f | %.4f | %.1f (%.1f) | %.4f | %d |\n",
                  row["cell_px"].get<double>(), row["vertices"].get<int>(), row["handles"].get<int>(),
                  row["init_s"].get<double>(), row["factor_s"].get<double>(), row["energy_px2"].get<double>(),
                  row["energy_start_px2"].get<double>(), row["iterations_50_s"].get<double>(),
                  row["flipped_cells"].get<int>());
    text += line;
  }
  return text;
}

} // namespace

Result<PaperRun> run_paper(const FigureCase& shown, const PaperSetup& setup, const Watch& outer) {
  const ClosedCurve outline = clockwise(shown.outline), sketch = clockwise(shown.sketch);
  const auto start = find_start(outline, sketch, setup, outer);
  if (!start) return start.error();
  StageTimes times;
  Watch watch = outer;
  watch.times = &times;
  StageTimer mesh_timer(&times, "mesh");
  auto region = make_region_mesh(outline, setup.cell_px, MeshKind::kTrimmed, watch);
  if (!region) return region.error();
  mesh_timer.stop();
  auto mesh = std::make_shared<const QuadMesh>(region->mesh());
  const auto system =
      PaperSystem::make(std::make_shared<const RegionMesh>(std::move(*region)), setup.handle_weight, watch);
  if (!system) return system.error();
  PaperOptions options;
  options.iterations = setup.iterations;
  options.start = *start;
  auto solution = solve_paper(*system, sketch, {}, options, watch);
  if (!solution) return solution.error();
  PaperRun run{std::move(mesh), sketch, std::move(*solution), {}, {}};
  run.distortion = measure_distortion(*run.mesh, run.solution.positions);
  run.distance = measure_sketch_distance(ClosedCurve(run.solution.outline), sketch);
  run.mesh_ms = time_of(times, {"mesh"});
  run.matrix_ms = time_of(times, {"matrix"});
  run.factor_ms = time_of(times, {"symbolic", "factor"});
  run.steps_ms = time_of(times, {"start", "iterations"});
  return run;
}

RegionPicture deformed_region(const FigureCase& shown, const PaperRun& run) {
  return {run.mesh.get(), run.solution.positions, run.solution.boundary, shown.given.outline};
}

Result<Json> write_paper_table(const FigureInput& input) {
  const auto shown = read_figure_case(input, input.names.empty() ? "fish" : input.names.front());
  if (!shown) return shown.error();
  Json rows = Json::array();
  for (const double cell : kTableCells) {
    auto row = table_row(*shown, cell, *input.watch);
    if (!row) return at(shown->given.name, row.error());
    rows.push_back(std::move(*row));
  }
  Json table;
  table["case"] = shown->given.name;
  table["method"] = "paper";
  table["runs"] = kTableRuns;
  table["rows"] = rows;
  auto written = write_file(input.out / "table.json", table.dump(1) + "\n");
  if (!written) return written.error();
  written = write_file(input.out / "table.md", table_text(shown->given.name, rows));
  if (!written) return written.error();
  return Json::array({"table.json", "table.md"});
}

} // namespace oversketch::cli
