#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/blend.h"
#include "core/clone/clone_system.h"
#include "core/geometry/mask.h"
#include "core/image/image.h"
#include "core/image/warped_region.h"

namespace oversketch {

struct CloneReport {
  /// Pixels of the mask, those outside the target too.
  std::int64_t unknowns = 0;
  /// A bound on the error of the solution in any pixel of the result, in 8-bit levels; a result's rounding to float is
  /// not counted.  Of a membrane: Membrane::error_share() of the range of the differences on the ring; else from the
  /// residual of the linear system.  0 where nothing was solved.  At export at most 0.03, but where float can do no
  /// better: there, as of mixed gradients in the log domain or of sources many times brighter than white in the linear
  /// one, it is ten to some hundred times the error.
  double residual_levels = 0;
  /// Box round the pixels of the target that may have changed; all zero when the region lies wholly outside.
  Rect changed;
};

/// Blends a region into a picture without a seam, in place.
///
/// Ω = the mask shifted by (dx, dy), g = the source shifted alike, f* = the target, its edge pixels repeated outside.
/// With A, d = f* − g and u as in guidance.h, as near as `quality` says, in the values of options.domain:
///   import      f = g + u,  Δu = 0 in Ω, u = d on the ring of pixels round Ω (Pérez, Gangnet, Blake 2003)
///   mixed       f = g + u,  u from the stronger differences
///   monochrome  import of g's luminance: a source in colour changes even a target that equals it
///   average     f = a (g + u) + (1 − a) f*,  a = options.average, u as in import
///   none        f = g
/// u is multiplied by 1 − (1 − strength) w, w = inside_weights(options.feather_px): all of it at the edge, `strength`
/// of it deep inside.  Source alpha and opacity weigh the result against the target ("over"): an opaque target stays
/// opaque, a translucent one gains the alpha of what is laid over it; where either picture is transparent on the ring
/// nothing is matched (see PlacedPair).  In mode none w fades the paste.  Results are not clamped.
///
/// Pixels of the target outside Ω keep their bits; the part of Ω outside the target is solved with, not painted.  After
/// an error the target is as before.
///
/// @param source  must reach over mask.bounds() grown by 1 (over mask.bounds() in mode none).
/// @param system  made from the mask Ω.
/// @errors clone.bad-option; clone.empty-target; clone.source-too-small; clone.not-finite (a pixel of the source or the
///   target in Ω or on its ring is not a number or infinite, or the result would be); clone.out-of-range (a value of
///   such a pixel is beyond ±65504; not in mode none); cancelled. And the errors of the system's parts that are made
///   for it.
/// @cost one pass of right-hand side, solution and painting; 112 bytes a pixel while it runs (96 more before that in
///   mode mixed).
/// @threads one call a target at a time; source and system may be shared.  Works on up to 4 threads, as the watch
/// allows.
Result<CloneReport> clone_into(Raster<Rgba>& target, const WarpedRegion& source, int dx, int dy,
                               const CloneSystem& system, const BlendOptions& options = {},
                               CloneQuality quality = CloneQuality::kExport, const Watch& watch = {});

/// Mode none without a system: plain paste; options.mode and strength are not looked at.
Result<CloneReport> paste_into(Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask, int dx, int dy,
                               const BlendOptions& options = {}, const Watch& watch = {});

} // namespace oversketch
