#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/correction.h"
#include "core/clone/pixel_graph.h"
#include "core/clone/placed_pair.h"

#include <functional>

namespace oversketch {

/// What is painted: the pair, and the correction u (null: u = 0).
struct Painting {
  const PlacedPair& pair;
  const PixelGraph& graph;
  const BlendOptions& options;
  const Correction* correction;
};

/// A run shifted by (dx, dy) and clipped to the target: columns x0 ≤ x < x1 and row y of the target, `pixel` the number
/// of the first one.
struct TargetRun {
  int y = 0;
  int x0 = 0;
  int x1 = 0;
  int pixel = 0;

  int length() const { return x1 - x0; }
};

/// Empty (x0 ≥ x1) when it lies outside.
/// @param first  number of the run's first pixel.
TargetRun clip_run(const Rect& target, const Mask::Run& run, int first, int dx, int dy);

/// Box round the pixels of the target under the mask shifted by (dx, dy); all zero when there are none.
Rect painted_rect(const Rect& target, const Mask& mask, int dx, int dy);

/// Asked with the largest |red, green or blue| before anything is written: whether the correction has been bettered, so
/// that all must be computed again.
using Refine = std::function<Result<bool>(double largest)>;

/// Writes the blended pixels (see clone_into) into the target: all of them, or none after an error.
/// @param target  the one that the pair reads.
/// @param refine  asked once; may be empty.
/// @returns the largest |red, green or blue| written.
/// @errors clone.not-finite (a result past the largest float), cancelled, those of `refine`.
Result<double> paint(Raster<Rgba>& target, const Painting& painting, int dx, int dy, const Watch& watch,
                     const Refine& refine = {});

} // namespace oversketch
