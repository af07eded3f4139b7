#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/match.h"
#include "core/deform/metrics.h"
#include "core/deform/options.h"
#include "core/deform/paper.h"
#include "core/mesh/quad_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace oversketch {

enum class Method { kPaper, kInitial };

/// How a region is deformed; see the solvers' headers for meanings and ranges.
struct DeformOptions {
  Method method = Method::kPaper;
  double cell_px = 10;
  double handle_weight = 1;
  int iterations = 50;
};

/// How often each kind of work was done.
struct DeformCounts {
  std::int64_t meshings = 0;
  std::int64_t symbolic_factorizations = 0;
  std::int64_t numeric_factorizations = 0;
  std::int64_t matches = 0;
};

/// A deformed region, whatever the method that made it.
struct Deformation {
  /// The mesh that is drawn, in the source, and where its vertices went.
  std::shared_ptr<const QuadMesh> mesh;
  Points positions;
  /// The closed polygon whose inside is shown.
  Points boundary;
  /// For each point of the caller's outline where it went, and its place on the sketch: a fraction of the sketch's
  /// length, [0, 1), increasing modulo 1.  Of a sketch that runs against the outline it is measured backwards from its
  /// first point.
  Points outline;
  std::vector<double> correspondence;
  /// Energy at the start and after each iteration.
  std::vector<double> energies;
  /// Handles that have passed their neighbour.
  int order_violations = 0;
  int handles = 0;
  /// Of the boundary match, where there was one.
  std::optional<double> match_cost;
  /// Milliseconds by stage, the making of its system included, and processor time of all of it.
  StageTimes times;
  double cpu_ms = 0;
};

/// A region made ready for one method: what depends on neither sketch nor pins.
/// @threads const; copies share everything.
class DeformSystem {
public:
  /// @param outline  simple closed curve, source px.
  /// @param like     a system of the same outline and cell, whose mesh and symbolic factor are used again; or null.
  /// @errors those of make_region_mesh and PaperSystem::make.
  static Result<DeformSystem> make(const Points& outline, const DeformOptions& options, const DeformSystem* like,
                                   DeformCounts& counts, const Watch& watch);

  /// Deforms the region to the sketch.
  /// @param sketch   closed, any orientation, target px; cleaned first: see clean_sketch() for what is cut and what
  /// refused.
  /// @param options  method and iterations count; the rest was fixed when the system was made.
  /// @errors those of clean_sketch, match_curves and solve_paper.
  Result<Deformation> deform(const Points& sketch, std::span<const PinPair> pins, const DeformOptions& options,
                             DeformCounts& counts, const Watch& watch) const;

  const RegionMesh& region() const { return paper_.region(); }

private:
  DeformSystem(PaperSystem paper, bool outline_reversed);
  static Result<DeformSystem> make_anew(const Points& outline, const DeformOptions& options, DeformCounts& counts,
                                        const Watch& watch);
  static Result<DeformSystem> make_reweighted(const DeformSystem& like, double handle_weight, DeformCounts& counts,
                                              const Watch& watch);

  PaperSystem paper_;
  MatchSource match_source_;
  std::shared_ptr<const QuadMesh> mesh_;
  /// The region's outline has the caller's points in reverse order.
  bool outline_reversed_;
  StageTimes times_;
  double cpu_ms_ = 0;
};

/// The contract's numbers of one deformed region; lengths in the sketch's pixels.
struct Metrics {
  DistortionMetrics distortion;
  SketchDistance sketch_distance;
  /// Only where the truth is known.
  std::optional<double> truth_error;
  double energy = 0;
  int iterations = 0;
  std::optional<double> match_cost;
  int vertices = 0;
  int handles = 0;
  int order_violations = 0;
  StageTimes times;
  double cpu_ms = 0;
};

/// @param truth  where each outline point belongs, or empty.
Metrics measure(const Deformation& deformation, const ClosedCurve& sketch, const Points& truth);

} // namespace oversketch
