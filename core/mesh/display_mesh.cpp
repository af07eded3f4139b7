#include "core/mesh/display_mesh.h"

#include "core/base/check.h"
#include "core/mesh/assemble.h"
#include "core/mesh/cell_copies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace oversketch {

namespace {

/// For each copy of the fine cut the copy of the coarse one that it is part of.
class Nesting {
public:
  Nesting(const CellCopies& fine, const CellCopies& coarse) : fine_(fine), coarse_(coarse) {}

  std::vector<int> run() {
    coarse_of_.assign(static_cast<std::size_t>(fine_.copy_count()), -1);
    nest_chains();
    for (const CellCopies::Span& span : fine_.spans)
      if (!span.entered()) nest_inside(span);
    return std::move(coarse_of_);
  }

private:
  /// The fine outline is cut at the coarse lines just where the coarse one is, and between them once more.
  void nest_chains() {
    int chain = static_cast<int>(coarse_.chains.size()) - 1;
    int begun = 0;
    for (const CellCopies::Chain& fine : fine_.chains) {
      if (fine.on_coarse_line) chain = begun++;
      CHECK(chain < static_cast<int>(coarse_.chains.size()),
            "fine and coarse outline are cut at the same coarse lines");
      coarse_of_[fine.copy] = coarse_.chains[chain].copy;
    }
    CHECK(begun == static_cast<int>(coarse_.chains.size()), "fine and coarse outline are cut at the same coarse lines");
  }

  /// Cells in a row, wholly inside: those within one coarse cell lie in the same piece of it.
  void nest_inside(const CellCopies::Span& span) {
    for (int column = span.first_column; column <= span.last_column; ++column) {
      const int copy = span.first_copy + (column - span.first_column);
      const bool same_cell = column > span.first_column && fine_.grid.within(column) != 0;
      coarse_of_[copy] = same_cell ? coarse_of_[copy - 1] : coarse_copy_of(column, fine_.copies[copy].row);
    }
  }

  int coarse_copy_of(int column, int row) const {
    const Grid& grid = fine_.grid;
    const auto copy = coarse_.copy_at(0.5 * (grid.corner(column, row) + grid.corner(column + 1, row + 1)));
    CHECK(copy.has_value(), "a cell inside the region lies in a copy of a coarse cell");
    return *copy;
  }

  const CellCopies& fine_;
  const CellCopies& coarse_;
  std::vector<int> coarse_of_;
};

/// How far outside the unit square.
double overshoot(const CellPoint& at) {
  return std::max({-at.u, at.u - 1, -at.v, at.v - 1, 0.0});
}

/// Each vertex in the control mesh, through one of the display cells that have it: one whose control copy stayed, if
/// any.
std::vector<CellPoint> place_vertices(const RegionMesh& control, const CellCopies& fine, const QuadMesh& mesh) {
  const CellCopies& coarse = control.copies();
  const std::vector<int> coarse_of = Nesting(fine, coarse).run();
  const double step = 1.0 / fine.grid.divisions;
  std::vector<CellPoint> places(mesh.vertices.size());
  std::vector<double> overshoots(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (int copy = 0; copy < fine.copy_count(); ++copy) {
    const CellCopies::Copy &at = fine.copies[copy], &in = coarse.copies[coarse_of[copy]];
    const int left = at.column - in.column * fine.grid.divisions, top = at.row - in.row * fine.grid.divisions;
    for (int k = 0; k < 4; ++k) {
      const int vertex = mesh.cells[copy][k];
      if (overshoots[vertex] <= 0) continue;
      const double u = (left + (k == 1 || k == 2 ? 1 : 0)) * step, v = (top + (k >= 2 ? 1 : 0)) * step;
      const CellPoint place = control.place_in_cell(coarse_of[copy], u, v);
      if (overshoot(place) >= overshoots[vertex]) continue;
      overshoots[vertex] = overshoot(place);
      places[vertex] = place;
    }
  }
  return places;
}

/// The smallest number of parts of `whole` that are at most `most` long; a quotient that is whole but for rounding is
/// whole.
double parts(double whole, double most) {
  constexpr double kRounding = 1e-9;
  return std::max(1.0, std::ceil(whole / most * (1 - kRounding)));
}

} // namespace

Result<DisplayMesh> make_display_mesh(const RegionMesh& control, double cell_px, const Watch& watch) {
  if (!std::isfinite(cell_px) || cell_px <= 0)
    return Error{"mesh.cell", "The cell size must be a positive number of pixels.", "display cell size"};
  StageTimer timer(watch.times, "display mesh");
  const double divisions = parts(control.mesh().cell, cell_px);
  if (divisions > static_cast<double>(kMostGridCrossings)) return too_many_vertices();
  Grid grid = control.copies().grid;
  grid.divisions = static_cast<int>(divisions);
  const auto fine = cut_into_copies(control.outline(), grid, watch);
  if (!fine) return fine.error();
  DisplayMesh display;
  display.divisions = grid.divisions;
  display.mesh = assemble_mesh(*fine, std::vector<bool>(static_cast<std::size_t>(fine->copy_count()), true));
  if (watch.stopped()) return cancelled();
  display.in_control = place_vertices(control, *fine, display.mesh);
  return display;
}

Points prolong(const QuadMesh& control, const Points& positions, const DisplayMesh& display) {
  CHECK(positions.size() == control.vertices.size(), "one position for each control vertex");
  Points moved;
  moved.reserve(display.in_control.size());
  for (const CellPoint& at : display.in_control)
    moved.push_back(locate(control, positions, at));
  return moved;
}

} // namespace oversketch
