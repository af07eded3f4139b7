#pragma once

#include "core/clone/live.h"
#include "core/session/content_cache.h"
#include "core/session/drawn_layer.h"
#include "core/session/snapshot.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace oversketch::live {

enum class Quality {
  /// What is at hand soonest: while something moves.
  kFirst,
  /// What stays.
  kRest,
};

/// The pixels in the rectangle, which must lie in the picture (CHECK).
Raster<Rgba8> part_of(const Raster<Rgba8>& pixels, const Rect& rect);

/// The picture of a document on a screen, in 8 bits, brought up to date by painting again only what has changed: the
/// layers that are other than before, and those above and round them that overlap what is painted anew.
class Picture {
public:
  /// @param target  the picture under all layers, or null: nothing is shown.
  /// @param layers  lowest first.
  /// @param changed  gains what is other than before.
  /// @errors those of the parts of the clone systems and of clone_live, with the layer as the place; cancelled.  The
  ///   picture is as before then, or painted anew the next time.
  Result<void> paint(std::shared_ptr<const Raster<Rgba8>> target, std::span<const DrawnLayer> layers, Quality quality,
                     const Watch& watch, PictureUpdate& changed);

  const Raster<Rgba8>& pixels() const { return pixels_; }
  /// Where layers stand, within the picture.
  Rect layers_rect() const;

  struct Timing {
    double mask_ms = 0;
    double blend_ms = 0;
  };
  /// Of the layer's last painting.
  std::optional<Timing> timing_of(LayerId id) const;

private:
  /// A layer as it has been painted, or shall be.
  struct Painted {
    LayerId id;
    /// Shape, place and blending.
    Hash name;
    Rect rect;
    CloneQuality quality = CloneQuality::kFirst;
    std::shared_ptr<const LiveRegion> region;
    DrawnLayer layer;
    Timing timing;
  };

  Result<std::vector<Painted>> prepare(std::span<const DrawnLayer> layers, Quality quality, const Watch& watch);
  Result<std::shared_ptr<const LiveRegion>> region_of(const DrawnLayer& layer);
  std::size_t first_changed(const std::vector<Painted>& wanted) const;
  std::vector<bool> list_dirty(const std::vector<Painted>& wanted, std::size_t first, Rect& dirty) const;
  Result<const Raster<Rgba8>*> picture_below(std::vector<Painted>& wanted, std::size_t count, const Watch& watch);
  static Result<void> paint_layer(Painted& layer, Raster<Rgba8>& pixels, const Watch& watch);

  std::shared_ptr<const Raster<Rgba8>> target_;
  Raster<Rgba8> pixels_;
  std::vector<Painted> painted_;
  /// What pixels_ holds is what painted_ says.
  bool sound_ = false;
  ContentCache<LiveRegion> regions_{6};

  /// The target with the lowest layers painted on, so that a higher one that is moved about finds it; their names.
  Raster<Rgba8> below_;
  std::vector<Hash> below_names_;
};

} // namespace oversketch::live
