#pragma once

#include "core/geometry/mask.h"
#include "core/geometry/point.h"
#include "core/image/image.h"
#include "core/image/warped_region.h"

#include <array>
#include <vector>

namespace oversketch {

/// Where colours will bleed into a region that is blended in, forecast from its edge alone; before anything is solved.
///
/// The correction u of gradients imported is f* − g on the ring of pixels round the mask, and a mean of that inside: a
/// difference that is the same all round shifts the region's colour, as it should; one that changes along the edge,
/// where the edge crosses an object of either picture, tints the inside near by.
struct BleedSample {
  /// On the outline, as it was given.
  Point at;
  /// Arc length from the outline's first point, px.
  double s = 0;
  /// f* − g just outside the mask there, red, green, blue, 8-bit levels of the encoded values; transparency counted as
  /// in PlacedPair.
  std::array<float, 3> mismatch{};
  /// Its length.
  float norm = 0;
  /// Length of the difference between the mean mismatch of the kBleedReach_px px before and after.
  float jump = 0;
  /// Whether it lies in the target.  Beyond, the target's edge pixels are matched, and nobody sees what bleeds in.
  bool is_seen = false;
};

inline constexpr int kBleedReach_px = 4;

struct BleedForecast {
  /// About 1 px apart, in the order of the outline; all of a closed curve.
  std::vector<BleedSample> samples;
  /// Over the samples that are seen; 0 where none is.
  std::array<float, 3> mean{};
  float largest_norm = 0;
  float largest_jump = 0;
};

/// @param outline  closed, either way round; what the mask was drawn from, in the mask's coordinates.  Without length:
///   no samples.
/// @param source  must reach over the outline; where it does not, its nearest pixel is taken.
/// @cost 0.1 µs a sample.
BleedForecast forecast_bleed(const Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask, int dx, int dy,
                             const Points& outline);

} // namespace oversketch
