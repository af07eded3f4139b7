#pragma once

#include "core/session/content_cache.h"
#include "core/session/snapshot.h"

namespace oversketch::live {

/// Gathers what a window shows of a session, and keeps the 8-bit pictures of its images.
class SnapshotMaker {
public:
  /// Document, history and what is derived of each layer; the caller adds the rest.
  /// @param measured  whether metrics are wanted that are not known yet; a gesture goes without.
  Snapshot make(Session& session, bool measured, const Watch& watch);

  /// The image in 8 bits; the same content gives the same pixels as long as it is kept.
  ShownPicture show(const Image& image);

private:
  std::shared_ptr<const Raster<Rgba8>> thumbnail_of(const Layer& layer);
  std::optional<Metrics> measure(Session& session, const Layer& layer, bool wanted, const Watch& watch);

  ContentCache<Raster<Rgba8>> pictures_{12};
  ContentCache<Raster<Rgba8>> thumbnails_{64};
  ContentCache<Metrics> metrics_{64};
};

} // namespace oversketch::live
