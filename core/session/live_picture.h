#pragma once

#include "core/session/snapshot.h"

namespace oversketch::live {

enum class Quality {
  /// What is at hand soonest: while something moves.
  kFirst,
  /// What stays.
  kRest,
};

/// The picture of a session on a screen, in 8 bits, kept up to date.
class Picture {
public:
  /// Paints what session.shown() has become since the last call.
  /// @param changed  gains what is other than before.
  /// @errors those of Session::composite; the picture is as before then.
  Result<void> update(Session& session, Quality quality, const Watch& watch, PictureUpdate& changed);

private:
  Raster<Rgba8> pixels_;
};

} // namespace oversketch::live
