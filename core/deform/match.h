#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/deform/options.h"
#include "core/geometry/curve.h"

#include <memory>
#include <span>
#include <vector>

namespace oversketch {

/// Which place of the outline belongs to which place of the sketch: a monotone cyclic map, linear between its nodes.
struct Match {
  /// Arc lengths (px), strictly increasing; the last entries stand for the first place again, one whole length further.
  /// sketch_s starts anywhere and is not wrapped.
  std::vector<double> outline_s;
  std::vector<double> sketch_s;
  /// How sharply shape decides at each node, >= 0: what the local cost rises by when the partner moves 1.5 % of the
  /// length along the sketch, the smaller of both ways.  0 on straight and evenly round parts, about 1 at a corner.
  std::vector<double> certainty;
  /// Mean cost by length of what was matched, >= 0.  Same shape: below about 0.12; unrelated shapes: 0.19 in the
  /// median.
  double cost = 0;

  /// Arc length of the sketch that belongs to arc length s of the outline; not wrapped, increasing over one round of s.
  double sketch_at(double s) const;
  /// certainty at arc length s of the outline.
  double certainty_at(double s) const;
};

struct MatchOptions {
  /// How many runners-up to keep beside the best match, >= 0.
  int alternatives = 0;
};

/// What matching needs to know of one curve.  Immutable; copies share it.
/// @cost about 0.2 ms.  @threads safe to read from several threads.
class MatchSource {
public:
  explicit MatchSource(const ClosedCurve& outline);

  const ClosedCurve& outline() const { return outline_; }

  struct Profile;
  const Profile& profile() const { return *profile_; }

private:
  ClosedCurve outline_;
  std::shared_ptr<const Profile> profile_;
};

/// A pin by arc length: outline and sketch, px.
struct PinPlace {
  double outline_s = 0;
  double sketch_s = 0;
};

/// Each pin snapped to the nearest point of either curve, in the order given.
///
/// @errors deform.pins-cross: no map can meet all pins (the order of two differs, or two share one end only); names the
///         two that stand closest among those whose exchange would help.
Result<std::vector<PinPlace>> place_pins(const ClosedCurve& outline, const ClosedCurve& sketch,
                                         std::span<const PinPair> pins);

/// Matches two closed curves by shape, whatever their first points; both must run in the same direction.
///
/// Elastic cyclic matching: each curve is smoothed over 0.4 % of its length and described at u by its turning angles
/// A_k(u) at three scales (1.2, 3, 7 % of the length, from averaged points of the arcs before and after) and its
/// direction T(u). Minimises the mean over the path of
///   Σ_k w_k (1 − cos(A_k − B_k)) + w_T (1 − cos(T_A − T_B)) + 0.1 log²(slope),   w = 0.5, 1, 1, w_T = 0.02,
/// by dynamic programming over steps of slope 1/6…6, over all cyclic shifts at 96 samples. w_T favours no rotation
/// where shapes are symmetric; where no match is good (cost > 0.2) it is raised to 0.3. Near the best shifts the same
/// again at 320 samples and half the scales, directions compared after the turn that the coarse match makes, w_T = 0.1:
/// the turn of the whole costs nothing where places are decided. Of matches that cost the same the one that turns least
/// is best. Pins split the curves into pieces, matched one by one without regard to direction, and are met exactly.
///
/// @param sketch  runs like the outline; target pixels, any scale.
/// @param pins    places by arc length, as place_pins() gives them.
/// @returns best first.  Runners-up differ from each better one by more than 4 % of the length in the mean; fewer than
///          asked for when there are no more, none beside the best when there are pins.
/// @errors kCancelled.
/// @cost about 4 ms, 6 ms where no match is good.  @threads pure.
Result<std::vector<Match>> match_curves(const MatchSource& source, const ClosedCurve& sketch,
                                        std::span<const PinPlace> pins, const MatchOptions& options,
                                        const Watch& watch);

} // namespace oversketch
