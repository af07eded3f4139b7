#pragma once

#include "core/geometry/point.h"
#include "ui/state/preferences.h"

#include <vector>

namespace oversketch {

/// A line drawn by hand: every point that was told, with its time, and the smooth line that it stands for.
///
/// The line is smoothed by its arc length, not by the number of points, so that neither the speed of the hand nor the
/// rate of the events matters: it is sampled every kStep screen px and averaged with a Gaussian G, twice over,
/// x ↦ 2 G x − G G x, which smooths as strongly but hardly shrinks arcs.  The window narrows towards both ends: the
/// line begins where the pen was set down and always reaches the pen, so there is nothing left to catch up with when it
/// is lifted.
class Stroke {
public:
  struct Sample {
    Point at;
    double time_s = 0;
  };

  /// @param zoom  screen pixels per pixel of the points: what is smoothed are screen pixels.
  Stroke(Smoothing smoothing, double zoom) : smoothing_(smoothing), zoom_(zoom) {}

  /// Points that are not finite are left out.
  void add(Point at, double time_s);
  const std::vector<Sample>& samples() const { return samples_; }

  /// The smooth line; with Smoothing::kNone the points as they came, repeats left out.
  /// @cost length on the screen · window: about 0.1 ms for 1000 px with kBasic.
  Points smoothed() const;

  /// Standard deviation of the average, screen px.
  static double sigma_px(Smoothing smoothing);
  static constexpr double kStep = 1;

private:
  Smoothing smoothing_;
  double zoom_;
  std::vector<Sample> samples_;
};

} // namespace oversketch
