#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/cleanup.h"
#include "core/deform/match.h"
#include "core/deform/options.h"
#include "core/mesh/region_mesh.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace oversketch {

/// Side of a control cell for a region: about 700 vertices whatever its shape and size, source px.
double choose_control_cell(const ClosedCurve& outline);

/// All that the flip-free solver knows of a region before there is a sketch: control mesh, handles, the pattern of its
/// matrices, the factored linear start, what matching needs of the outline.  Immutable; copies share everything.
/// @threads safe to read from several threads.
class FlipfreeSystem {
public:
  /// Meshes with choose_control_cell() and prepares.
  /// @errors those of make_region_mesh(); cancelled.  @cost about 4 ms.
  static Result<FlipfreeSystem> make(const ClosedCurve& outline, const Watch& watch = {});
  /// The same on a mesh of the caller's choice (MeshKind::kCovering; n ≈ 500–1000 vertices is what speed is measured
  /// at).
  static Result<FlipfreeSystem> make(const ClosedCurve& outline, const RegionMesh& mesh, const Watch& watch = {});

  const RegionMesh& region() const;
  /// The caller's outline, as it was given.
  const ClosedCurve& outline() const;

  struct Data;
  const Data& data() const { return *data_; }

private:
  explicit FlipfreeSystem(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// Measured over random bends with a trembling hand: 0.15 costs area spread, but gives the least mean σ1/σ2 at which
/// the distance from the truth no longer falls (0.5: σ1/σ2 0.035 more).
inline constexpr double kDefaultStiffness = 0.15;

struct FlipfreeOptions {
  /// λ: 0.05 is nearly conformal, 2 nearly keeps areas; > 0.
  double stiffness = kDefaultStiffness;
  /// W: what a control cell of distance from the sketch costs along one cell of outline; > 0.
  double follow = 20;
  /// Newton steps at most; 2 for a frame while something is dragged, 0 for as many as it takes.
  int most_steps = 0;

  bool operator==(const FlipfreeOptions&) const = default;
};

/// How a solve began.
enum class FlipfreeStart {
  /// Matched anew, linear start.
  kMatched,
  /// From the warm solution with its correspondence: the same sketch, pins at most moved a little.
  kWarm,
  /// From the warm solution, its correspondence carried over to a sketch of which a part was redrawn.
  kRemapped,
};

struct FlipfreeSolution {
  /// Control vertices, target px.
  Points positions;
  /// Handles in the outline's order: arc length on region().outline() (px), on `sketch->curve` (px, strictly
  /// increasing, not wrapped), and where each lies, target px.  Pins have a handle each.
  std::vector<double> handle_outline_s;
  std::vector<double> handle_sketch_s;
  Points handles;
  /// Where the match has each handle (as handle_sketch_s), and how hard it is held there: what a warm solve starts
  /// from.
  std::vector<double> anchors;
  std::vector<double> holds;
  /// Where each point of the caller's outline went, target px.
  Points outline;
  /// For each point of the caller's outline its place on the given sketch as a part of its length, [0, 1): run in the
  /// outline's direction from the first point of the sketch; increasing but for one wrap.
  std::vector<double> correspondence;

  /// The cleaned sketch, in the direction of region().outline().
  std::shared_ptr<const CleanSketch> sketch;
  /// The sketch as it was given.
  std::shared_ptr<const Points> given_sketch;
  std::vector<PinPair> pins;
  FlipfreeOptions options;

  FlipfreeStart start = FlipfreeStart::kMatched;
  /// Cost of the match this correspondence descends from (Match::cost).
  double match_cost = 0;
  /// Energy after each Newton step, in cells (flipfree_newton.h).  From stage to stage the sketch weighs more, and the
  /// energy may rise.
  std::vector<double> energies;
  double energy = 0;
  int iterations = 0;
  int matches = 0;
  int numeric_factorizations = 0;
  /// Control cells with a corner of det ≤ 0.  Anything but 0 is a failure to be told to the user.
  int flipped = 0;
  /// Handles out of order on the sketch.  Always 0.
  int order_violations = 0;
  /// Largest distance of a pinned outline point from its place, control cells.
  double pin_distance = 0;
  /// Whether the solve ended by itself and not at most_steps.
  bool converged = false;
};

/// Deforms a region so that its outline lies on `sketch`, choosing the correspondence (design note "deformation",
/// section 3).
///
/// Cleans the sketch, matches the curves, starts from the linear solution and runs projected Newton steps with sliding
/// handles (run_stage()) at W/20, W/4 and W.  When that ends with a flipped cell, starts again from the similarity that
/// fits best, from where no cell can flip.  All work is done in the frame of the sketch's centroid and area, so that
/// moving, scaling, reversing the sketch or starting it elsewhere changes the answer by rounding alone.
///
/// With `warm` of the same system:
///   the same sketch     keeps the correspondence; handles near a moved pin are shifted along with it; matched again
///   only
///                       when a pin is further than 5 % of the length from where its outline point was
///   a part redrawn      (at least 30 % of the length is the same points) keeps it on the rest and carries it over by
///   arc
///                       length on the new part
///   else                as without.
///
/// @param sketch  closed, any orientation; target px.  See clean_sketch() for what is cut and refused.
/// @param pins    snapped to the nearest point of each curve; each is met to 0.1 cell, see pin_distance.
/// @errors those of clean_sketch(); deform.pins-cross; cancelled.  `warm` is never changed: the last good state stays.
/// @cost 750 vertices, one core: about 10 ms cold, of which 4 ms are the match; 0.6 ms a Newton step.
/// @threads pure.
Result<FlipfreeSolution> solve_flipfree(const FlipfreeSystem& system, const Points& sketch,
                                        std::span<const PinPair> pins, const FlipfreeOptions& options,
                                        const FlipfreeSolution* warm, const Watch& watch = {});

/// The best match and up to `count` − 1 runners-up, each solved: the alternatives to offer.  Best match first.
///
/// A runner-up is offered only if it is an answer: without a flipped cell, its outline and the sketch nowhere further
/// from each other than 15 % of the square root of the sketch's area (or than 1½ times the best's furthest, where no
/// match fits), and not what the best one came to as well (2 % of the same in the mean).
/// @errors as solve_flipfree().
Result<std::vector<FlipfreeSolution>> solve_alternatives(const FlipfreeSystem& system, const Points& sketch,
                                                         std::span<const PinPair> pins, const FlipfreeOptions& options,
                                                         int count, const Watch& watch = {});

} // namespace oversketch
