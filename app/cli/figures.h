#pragma once

#include "app/cli/cli.h"
#include "app/cli/figure_mesh.h"
#include "app/cli/figure_page.h"

#include "core/deform/deformation.h"
#include "core/session/case_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oversketch::cli {

/// What every figure is made from.
struct FigureInput {
  Lettering lettering;
  /// Where case files, and the sample scripts with their pictures, are read; where figures are written.
  std::filesystem::path cases, samples, out;
  /// Cases to show instead of the figure's own; empty: its own.
  std::vector<std::string> names;
  const Watch* watch = nullptr;
};

// Each writes its files and gives their names.

/// compare.png: a row for each case; source, the paper's start, its 50 steps, the flip-free method.
Result<Json> draw_compare(const FigureInput& input);
/// The paper's own pictures: paper-mesh.png, paper-gradients.png, paper-weight.png, paper-cells.png.
Result<Json> draw_paper(const FigureInput& input);
/// The paper's table: table.json and table.md.
Result<Json> write_paper_table(const FigureInput& input);
/// alternatives.png: a row for each ambiguous case; source, the best match, the runners-up.
Result<Json> draw_alternatives(const FigureInput& input);

/// errors.png and errors.json: how far each quality of blending is from the exact solution, on photographs.
Result<Json> draw_errors(const FigureInput& input);

/// A case, its outline, and its sketch made clean and running like the outline.
struct FigureCase {
  DeformCase given;
  ClosedCurve outline;
  ClosedCurve sketch;
  /// Whether it is shown with y upwards.
  bool upwards = false;
};

/// Of the curve pairs' folder, to be shown with y upwards, as curves are plotted.
/// @errors those of read_case() and clean_sketch().
Result<FigureCase> read_figure_case(const FigureInput& input, const std::string& name);
Result<FigureCase> make_figure_case(DeformCase given, bool upwards);

/// Cells of the meshes in figures, source px; squares of the chessboard are two cells.
inline constexpr double kFigureCell = 10;

/// Solved from nothing with cells of kFigureCell.
Result<DeformedCase> solve_figure(const FigureCase& shown, Method method, const Watch& watch);

/// The region as a deformation shows it, and as it lies in the source.
RegionPicture deformed_region(const FigureCase& shown, const Deformation& deformation);
RegionPicture source_region(const FigureCase& shown, const Deformation& deformation);

/// Where the place at `fraction` of the outline's length went, by its neighbouring points.
Point follow_outline(const FigureCase& shown, const Points& moved, double fraction);

/// Dots of a dozen colours, equally far from each other along the outline; `at(k)` gives the place of dot k in the
/// figure.
inline constexpr int kDots = 12;
std::uint32_t dot_color(int k);
void draw_dot(Canvas& canvas, Point at, int k);
void draw_goal(Canvas& canvas, Point at, int k);

/// "flips 82   σ₁/σ₂ 4.77   area ×31.2", centred at `at`.
void write_metrics(Page& page, const Metrics& metrics, Point at);

/// @errors file.write.
Result<std::string> save_page(const FigureInput& input, Page page, const std::string& name);

} // namespace oversketch::cli
