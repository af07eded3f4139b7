#pragma once

#include "core/session/snapshot.h"
#include "ui/canvas/mesh_paint.h"
#include "ui/canvas/paint.h"
#include "ui/state/view_state.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oversketch {

/// What the overlays are drawn of.
struct OverlayScene {
  const Layer& layer;
  /// Null as long as nothing has been derived.
  const LayerSnapshot* derived = nullptr;
  const Overlays& shown;
  std::optional<PinId> selected_pin;
};

/// What is worth keeping from frame to frame; belongs to one canvas panel.
struct OverlayCache {
  MeshCache drawn;
  MeshCache control;
};

/// Draws all overlays that are on, of one layer, on one side: the source has the region as it is, the target what has
/// become of it.
/// @cost below 4 ms for 20,000 cells; what lies outside the canvas costs next to nothing.
void draw_overlays(const CanvasPaint& paint, Side side, const OverlayScene& scene, OverlayCache& cache);

/// What the colours of an overlay mean.
struct Legend {
  std::string title;
  /// Of the calm end and the alarming one.
  std::string low;
  std::string high;
};
/// Of the overlays that colour by a value.
std::vector<Legend> list_legends(const Overlays& shown, bool derived);

/// Legends below each other at the canvas's upper right corner; those that do not fit are left out.
void draw_legends(const CanvasPaint& paint, std::span<const Legend> legends);

/// Places on the outline with the places of the sketch that they are matched with.
struct MatchedPlaces {
  /// Fractions of the outline's length, 0…1.
  std::vector<double> fractions;
  /// Source px; target px.
  Points outline;
  Points sketch;
};

/// `count` places, equally spaced by arc length of the outline.  Between the outline's points the correspondence is
/// linear.  Empty where it does not fit the layer's curves (a solve that is on its way).
MatchedPlaces matched_places(const Layer& layer, const Deformation& deformation, int count);

} // namespace oversketch
