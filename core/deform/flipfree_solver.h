#pragma once

#include "core/deform/flipfree.h"
#include "core/deform/flipfree_frame.h"
#include "core/deform/flipfree_newton.h"
#include "core/deform/flipfree_system.h"
#include "core/deform/flipfree_warm.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace oversketch {

/// A cleaned sketch and the pins on it, sorted along the outline, no two the same.
struct FlipfreeInput {
  std::shared_ptr<const CleanSketch> sketch;
  SketchFrame frame;
  /// Arc lengths on region().outline() and sketch->curve, px.
  std::vector<PinPlace> pins;
};

/// The correspondence of a solution, with anchors and holds, as functions of the arc length on the outline.
struct WarmPlaces {
  Match places;
  /// certainty holds the holds.
  Match anchors;
};

/// @param remap  null where the sketch is the same.
WarmPlaces carry_over(const FlipfreeSolution& warm, const CurveRemap* remap, const ClosedCurve& outline);

/// Moves places and anchors near each pin along with it: all the way at the pin, less and less to 6 % of the outline on
/// either side (more where the pin moved far), never beyond the next pin.
void shift_to_pins(WarmPlaces& warm, std::span<const PinPlace> pins, const ClosedCurve& outline, double sketch_length);

/// One solve, in the sketch's frame.  `input` must outlive it.
/// @threads one at a time.
class FlipfreeSolver {
public:
  FlipfreeSolver(const FlipfreeSystem& system, const FlipfreeInput& input, const FlipfreeOptions& options,
                 const Watch& watch);
  FlipfreeSolver(const FlipfreeSolver&) = delete;
  FlipfreeSolver& operator=(const FlipfreeSolver&) = delete;

  /// From a match with frame.curve: linear start, stages of W, and the safe way where that leaves flips.  False when
  /// stopped.
  /// @param best  not a runner-up: gives way to a similarity where the sketch is one.
  bool solve_matched(const Match& match, bool best);
  /// From positions (target px) and a correspondence: the last stage alone.  False when stopped.
  bool solve_warm(const Points& positions, const WarmPlaces& warm);

  int flipped() const { return system_.distortion.count_flipped(state_.positions); }
  /// All of a solution but what the caller alone knows: the given sketch and pins, how it began.
  FlipfreeSolution take() const;

private:
  std::vector<Handle> make_handles() const;
  void set_places(const std::function<double(double)>& sketch_s);
  void align_places(bool best);
  void start_linear();
  void start_similar();
  bool run_stages(std::span<const double> stages);
  bool meet_pins();
  double pin_distance() const;
  Point handle_position(const Points& x, std::size_t i) const;
  void take_handles(FlipfreeSolution& out) const;
  void take_outline(FlipfreeSolution& out) const;

  const FlipfreeSystem::Data& system_;
  const FlipfreeInput& input_;
  FlipfreeOptions options_;
  const Watch& watch_;
  const SketchFrame& frame_;
  std::vector<Handle> handles_;
  BlockCholesky hessian_;
  SlideProblem problem_;
  SlideState state_;
  SlideReport report_;
  double pin_factor_ = 1;
  /// When the last stage stops: SlideStage::gain and floor_gain.
  struct Gains {
    double gain = 0;
    double floor_gain = 1e-8;
  };
  Gains gains_;
};

} // namespace oversketch
