#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/options.h"
#include "core/deform/paper_boundary.h"
#include "core/deform/paper_handles.h"
#include "core/geometry/curve.h"
#include "core/mesh/region_mesh.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace oversketch {

/// A region made ready for the method of Eitz, Sorkine, Alexa, Sketch Based Image Deformation, VMV 2007: mesh, matrix
/// and factor, for any number of sketches.  Design note "deformation", sections 1 and 2.
///
/// The handles are the boundary vertices of the mesh, one for each place of region().boundary().
/// @threads const; copies share everything.
class PaperSystem {
public:
  /// @param region         should be of kind kTrimmed, so that the boundary follows the outline without bias.
  /// @param handle_weight  ω: how strongly the boundary follows the handles against the stiffness inside; the paper
  ///   uses 0.1 to 1, default 1.
  /// @errors deform.handle-weight (see paper_handles.h); cancelled.
  /// @cost stages "matrix", "symbolic", "factor" of watch.times.
  [[nodiscard]] static Result<PaperSystem> make(std::shared_ptr<const RegionMesh> region, double handle_weight,
                                                const Watch& watch);
  /// The same region with another ω: one numeric factorization, nothing else; in the reduced form (HandleForm) a dense
  /// one of the handles alone.
  [[nodiscard]] Result<PaperSystem> with_handle_weight(double handle_weight, const Watch& watch) const;

  const RegionMesh& region() const { return *region_; }
  const HandleSystem& handles() const { return handles_; }
  const BoundaryMap& boundary_map() const { return *map_; }

private:
  PaperSystem(std::shared_ptr<const RegionMesh> region, std::shared_ptr<const BoundaryMap> map, HandleSystem handles);

  std::shared_ptr<const RegionMesh> region_;
  std::shared_ptr<const BoundaryMap> map_;
  HandleSystem handles_;
};

struct PaperOptions {
  /// Steps of gradient descent on the handles, 0…kMostPaperIterations; 0 leaves them at their start (method "initial").
  int iterations = 50;
  /// Keep mesh, handles and gradients of every step, to be shown.
  bool keep_iterates = false;
  /// A place of the outline and the place of the sketch it starts at (px of arc length, the sketch's as the caller's
  /// sketch runs); none: choose_start().  Not used when there are pins.
  struct StartPair {
    double outline_s = 0;
    double sketch_s = 0;
  };
  std::optional<StartPair> start;
};

inline constexpr int kMostPaperIterations = 100'000;

struct PaperIterate {
  Points positions;
  Points handles;
  /// Gradient of the energy by each handle, px.  The step goes against it.
  Points gradients;
  double energy = 0;
};

struct PaperSolution {
  /// Vertices of the mesh, target pixels.
  Points positions;
  /// For each place of region().boundary() its handle, on the sketch, and the handle's arc length on the sketch as the
  /// caller gave it (px).
  Points handles;
  std::vector<double> handle_s;
  /// Gradient of the energy by each handle at the end, px.
  Points gradients;
  /// E_d before each step and at the end, px²: iterations + 1 of them.
  std::vector<double> energies;
  /// The same states whole, when PaperOptions::keep_iterates.
  std::vector<PaperIterate> iterates;
  /// Where each point of region().outline() went.
  Points outline;
  /// For each point of region().outline() its place on the sketch, interpolated from the handles: fraction of the
  /// sketch's length, [0, 1), along the sketch as the caller gave it.  Increases modulo 1 when the sketch runs like
  /// region().outline(), decreases when `sketch_reversed`; as far as the method keeps the handles in order at all.
  std::vector<double> correspondence;
  /// Handles that do not lie before the next one of the loop: the method lets them pass each other.
  int order_violations = 0;
  /// The sketch runs against region().outline().
  bool sketch_reversed = false;
  /// The deformed boundary loop, a closed polygon.
  Points boundary;
};

/// Deforms a region so that its boundary follows `sketch`, by the paper's method.
///
/// The handles h start on the sketch γ by arc length of the mesh's boundary, from choose_start(); with pins, by arc
/// length between each two of them.  Then `iterations` times:  w(h) minimises E_d(w) + ω² Σ|w_i − h_i|², g =
/// ∂E_d(w(h))/∂h,  h ← nearest point of γ to h − g/2.  See paper_energy.h for E_d and paper_handles.h for w and g. The
/// step is the paper's; it does not depend on the mesh's resolution, so what 50 steps reach does.
///
/// @param sketch  any orientation: one that runs against the outline is walked backwards.  Best cleaned of crossings.
/// @param pins    each is snapped to the nearest point of either curve; the boundary vertex nearest to it along the
/// outline
///   is held at the sketch point throughout, and meets it as far as ω makes vertices follow handles.
/// @errors deform.iterations; deform.pin-not-finite; deform.pins-cross; deform.pins-too-close (two pins want one
/// vertex;
///   `where` as in pins_cross()); sketch.no-area (less than 0.1 % of the square on its perimeter); cancelled.
/// @cost an iteration is HandleSystem::slope() and one nearest point a handle.  Stages "start", "iterations".
/// @threads a pure function.
[[nodiscard]] Result<PaperSolution> solve_paper(const PaperSystem& system, const ClosedCurve& sketch,
                                                std::span<const PinPair> pins, const PaperOptions& options,
                                                const Watch& watch);

} // namespace oversketch
