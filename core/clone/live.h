#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/clone.h"
#include "core/clone/clone_system.h"
#include "core/image/display.h"
#include "core/image/warped_region.h"

#include <memory>
#include <utility>

namespace oversketch {

/// A warped region packed for painting on the screen: the mask's pixels run by run, 16 bits a channel.
///
/// Values are kept to 1/64 of a level between −512 and 511 levels; what lies beyond is shown as if it lay there. Copies
/// share the pixels.
/// @threads const after making.
class LiveRegion {
public:
  /// @param source  must reach over the mask's bounds grown by 1.
  /// @param system  of the mask.
  /// @errors clone.source-too-small; clone.not-finite, clone.out-of-range (in the mask or on its ring).
  /// @cost 8 bytes and about 2 ns a pixel.
  static Result<LiveRegion> make(const WarpedRegion& source, const CloneSystem& system);

  struct Data;
  const Data& data() const { return *data_; }

private:
  explicit LiveRegion(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// Blends a region over `below` on the screen, as clone_into does for pictures; rounded and clamped to 8 bits here and
/// nowhere else.
///
/// @param below   the picture under the layer; what the differences on the ring are taken from.
/// @param out     of the same size (CHECK), or `below` itself; holds `below` where the layer is not.  All pixels of the
/// mask shifted by
///   (dx, dy) are written, no others: where the layer stood before, the caller restores what was below.
/// @param system  the one that the region was made with, or a copy (CHECK).
/// @param threads  1…64 (CHECK) that paint; the same bits with any number.
/// @errors clone.bad-option; clone.empty-target; those of the system's parts; cancelled.  Then `out` is as before.
/// @cost a membrane's solution and the painting: 0.8, 2.3, 6.5 ms for smooth opaque shapes of 2¹⁸, 2²⁰ and 2²² pixels,
///   imported at kDrag in the encoded domain; with other options about 10 ns a pixel more, in other domains 20.  Mixed
///   gradients are solved on every pixel.
/// @threads one call an `out` at a time; all else may be shared.
Result<CloneReport> clone_live(const Raster<Rgba8>& below, Raster<Rgba8>& out, const LiveRegion& region,
                               const CloneSystem& system, int dx, int dy, const BlendOptions& options,
                               CloneQuality quality, int threads = 1, const Watch& watch = {});

} // namespace oversketch
