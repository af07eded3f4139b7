#pragma once

#include "app/cli/figures.h"

#include "core/deform/paper.h"

#include <memory>

namespace oversketch::cli {

struct PaperSetup {
  double cell_px = kFigureCell;
  /// ω.
  double handle_weight = 1;
  int iterations = 50;
};

/// The paper's method on one case, solved from nothing.
struct PaperRun {
  std::shared_ptr<const QuadMesh> mesh;
  /// The clean sketch, clockwise on a screen: what handle_s counts on.
  ClosedCurve sketch;
  PaperSolution solution;
  DistortionMetrics distortion;
  SketchDistance distance;
  /// Milliseconds: mesh; the energy's matrix; its factor; all steps.
  double mesh_ms = 0, matrix_ms = 0, factor_ms = 0, steps_ms = 0;
};

/// Handles start by arc length where DeformSystem's method `initial` has them.
Result<PaperRun> run_paper(const FigureCase& shown, const PaperSetup& setup, const Watch& watch);

RegionPicture deformed_region(const FigureCase& shown, const PaperRun& run);

} // namespace oversketch::cli
