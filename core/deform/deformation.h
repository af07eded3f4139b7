#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/flipfree.h"
#include "core/deform/metrics.h"
#include "core/deform/options.h"
#include "core/deform/paper.h"
#include "core/mesh/display_mesh.h"
#include "core/mesh/quad_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace oversketch {

enum class Method { kFlipfree, kPaper, kInitial };

/// How a region is deformed; see the solvers' headers for meanings and ranges.
struct DeformOptions {
  Method method = Method::kFlipfree;
  /// Side of a cell of the mesh that is drawn, source px; of the paper's methods also of the one that is solved.
  double cell_px = 10;
  double stiffness = kDefaultStiffness;
  double follow = 20;
  double handle_weight = 1;
  int iterations = 50;

  bool operator==(const DeformOptions&) const = default;
};

/// What the numbers may be; outside, deform.stiffness, deform.follow and
/// deform.iterations are the errors.
inline constexpr double kLeastStiffness = 0.001, kMostStiffness = 1000, kLeastFollow = 0.01, kMostFollow = 10'000;

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
  /// Energy at the start (the paper's) and after each iteration.
  std::vector<double> energies;
  /// The mesh that was solved, in the source, and where its vertices went; null where it is the drawn one.
  std::shared_ptr<const QuadMesh> control_mesh;
  std::shared_ptr<const Points> control_positions;
  /// Where the handles lie; of the paper's methods also the energy's gradient by each at the end, px.
  Points handle_points;
  Points handle_gradients;
  /// Cells of the control mesh, where that is another than the drawn one, with a corner of det ≤ 0.
  int flipped_control_cells = 0;
  /// Handles that have passed their neighbour.
  int order_violations = 0;
  int iterations = 0;
  int handles = 0;
  /// Vertices of the mesh that was solved.
  int vertices = 0;
  /// Of the boundary match, where there was one.
  std::optional<double> match_cost;
  /// The solution itself, method flipfree: what a warm solve starts from.
  std::shared_ptr<const FlipfreeSolution> flipfree;
  /// Milliseconds by stage, the making of its system included, and processor time of all of it.
  StageTimes times;
  double cpu_ms = 0;
};

/// A region made ready for one method: what depends on neither sketch nor pins.
/// @threads const; copies share everything.
class DeformSystem {
public:
  /// @param outline  simple closed curve, source px.
  /// @param like     a system of the same outline and kind of method (of the paper's also of the same cell): what does
  /// not
  ///   depend on what has changed is used again; or null.
  /// @errors those of make_region_mesh, make_display_mesh, PaperSystem::make and FlipfreeSystem::make.
  static Result<DeformSystem> make(const Points& outline, const DeformOptions& options, const DeformSystem* like,
                                   DeformCounts& counts, const Watch& watch);

  /// Deforms the region to the sketch.
  /// @param sketch   closed, any orientation, target px; cleaned first: see clean_sketch() for what is cut and refused.
  /// @param options  stiffness, follow, iterations and which of the paper's methods count; the rest was fixed when the
  ///   system was made.
  /// @param warm     a deformation of the same region to start from (see solve_flipfree()), or null; the paper's
  /// methods
  ///   always start anew.
  /// @errors those of clean_sketch, match_curves, solve_flipfree and solve_paper.
  Result<Deformation> deform(const Points& sketch, std::span<const PinPair> pins, const DeformOptions& options,
                             const Deformation* warm, DeformCounts& counts, const Watch& watch) const;

  /// The best match and the runners-up, each solved; the best first, `count` at most (the paper's methods have one).
  Result<std::vector<Deformation>> alternatives(const Points& sketch, std::span<const PinPair> pins,
                                                const DeformOptions& options, int count, DeformCounts& counts,
                                                const Watch& watch) const;

  /// The same solution on this system's drawn mesh: all that another cell size costs with method flipfree.
  /// @param solved  of a system of the same outline; has `flipfree` (CHECK).
  Deformation redisplay(const Deformation& solved) const;

private:
  struct PaperPart {
    PaperSystem system;
    MatchSource match;
    std::shared_ptr<const QuadMesh> mesh;
    /// The region's outline has the caller's points in reverse order.
    bool outline_reversed = false;
  };
  struct FlipfreePart {
    FlipfreeSystem system;
    std::shared_ptr<const QuadMesh> control;
    std::shared_ptr<const DisplayMesh> display;
    std::shared_ptr<const QuadMesh> mesh;
    /// Arc lengths on region().outline() at which the shown boundary is taken: its points, and between them every
    /// fraction of a control cell.
    std::vector<double> boundary_s;
  };

  explicit DeformSystem(PaperPart part) : part_(std::move(part)) {}
  explicit DeformSystem(FlipfreePart part) : part_(std::move(part)) {}

  static Result<DeformSystem> make_paper(const Points& outline, const DeformOptions& options, const PaperPart* like,
                                         DeformCounts& counts, const Watch& watch);
  static Result<DeformSystem> make_flipfree(const Points& outline, const DeformOptions& options,
                                            const FlipfreePart* like, DeformCounts& counts, const Watch& watch);
  static Result<Deformation> deform_paper(const PaperPart& part, const Points& sketch, std::span<const PinPair> pins,
                                          const DeformOptions& options, const Watch& watch);
  static Deformation show_flipfree(const FlipfreePart& part, std::shared_ptr<const FlipfreeSolution> solution);

  std::variant<PaperPart, FlipfreePart> part_;
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
