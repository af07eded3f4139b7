#pragma once

#include "core/base/result.h"
#include "core/clone/bleed.h"
#include "core/deform/deformation.h"
#include "core/document/command.h"
#include "core/document/document.h"
#include "core/image/display.h"
#include "core/session/session.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// A picture to look at.  The same content has the same hash, whatever document it comes from.
struct ShownPicture {
  Hash content;
  std::shared_ptr<const Raster<Rgba8>> pixels;
};

/// What is derived of one layer, as far as it is known.
struct LayerSnapshot {
  LayerId id;
  ShownPicture source;
  /// The region's part of the source, 96 px at most on a side; null before there is a region.
  std::shared_ptr<const Raster<Rgba8>> thumbnail;
  /// In the layer's own space: the placement puts it into the target.  Null while there is no region.
  std::shared_ptr<const Deformation> deformation;
  std::optional<Metrics> metrics;
  /// Of the selected layer: how its colours differ from the target's along the boundary, in target pixels.
  std::shared_ptr<const BleedForecast> bleed;
  /// Of the last painting on the screen: what depends on the mask alone, and one move.
  double mask_ms = 0;
  double blend_ms = 0;
};

/// What a comparison shows over the finished picture: the same document with one layer taken otherwise.
struct ComparePicture {
  Rect rect;
  std::shared_ptr<const Raster<Rgba8>> pixels;
};

/// One of the matcher's answers to where the curves begin, solved.
struct AlternativeSnapshot {
  /// What takes it: a pin at the point that tells it best from the others, added or moved there.
  Command take;
  /// It is what the layer shows.
  bool chosen = false;
  double match_cost = 0;
  /// The deformed region, small, transparent outside.
  std::shared_ptr<const Raster<Rgba8>> picture;
};

/// Everything a window shows of a session at one moment.  Immutable, shared between threads.
struct Snapshot {
  /// Grows with every change.
  std::uint64_t revision = 0;
  /// While a gesture goes on, with its preview.
  Document document;
  bool in_gesture = false;
  /// Bottom first, as document.layers; may lack layers that have just come.
  std::vector<LayerSnapshot> layers;
  ShownPicture target;

  std::vector<std::string> history;
  std::size_t cursor = 0;
  bool modified = false;
  Counters counters;

  /// The last thing that was refused, and which one that was: a window shows each number once.
  std::optional<Error> problem;
  std::uint64_t problem_number = 0;

  std::optional<ComparePicture> compare;
  /// Of the selected layer, when they were asked for: the best answer and those nearly as good.  None where there is
  /// no other, or where pins decide that hold none of these.
  std::vector<AlternativeSnapshot> alternatives;

  const LayerSnapshot* find(LayerId id) const;
};

/// A part of the shown picture that has changed; its size is that of `pixels`.
struct PicturePatch {
  int x = 0;
  int y = 0;
  Raster<Rgba8> pixels;
};

/// What has happened to the shown picture since it was last asked for.
struct PictureUpdate {
  int width = 0;
  int height = 0;
  /// The size is another one, or everything is new: the patches cover all of it.
  bool whole = false;
  std::vector<PicturePatch> patches;
};

} // namespace oversketch
