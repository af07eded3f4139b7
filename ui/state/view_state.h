#pragma once

#include "core/document/document.h"
#include "core/session/live_session.h"
#include "ui/canvas/view.h"

#include <optional>

namespace oversketch {

enum class Tool { kOutline, kSketch, kPin, kMove, kPan };

/// Which canvas: the picture that a region is taken from, or the one it goes into.
enum class Side { kSource, kTarget };

/// The layer's curve on that side, in the pixels of that side's picture.
inline Points curve_on(const Layer& layer, Side side) {
  return side == Side::kSource ? layer.outline : layer.sketch_in_target();
}

/// What is drawn over the pictures.
struct Overlays {
  /// All of them off at once, without forgetting which were on.
  bool shown = true;
  bool curves = true;
  bool pins = true;
  bool correspondence = true;
  bool handles = false;
  bool control_mesh = false;
  bool display_mesh = false;
  bool gradients = false;
  bool flipped = true;
  bool heat_sigma = false;
  bool heat_area = false;
  bool bleed = false;

  bool operator==(const Overlays&) const = default;
};

struct CanvasState {
  View view;
  /// To be fitted as soon as the canvas knows its size and its picture.
  bool fit_wanted = true;
};

/// How one document is looked at: plain, neither saved nor undone.
struct DocumentView {
  CanvasState source;
  CanvasState target;
  /// Share of the width that the source canvas takes, 0…1.
  double split = 0.42;
  std::optional<PinId> selected_pin;
  LiveSession::Compare compare = LiveSession::Compare::kOff;
  /// Where the comparison's slider stands, share of the target canvas's width; what is right of it is compared.
  double compare_split = 0.5;
  /// Shown in place of the result while a key is held.
  bool before_held = false;

  CanvasState& canvas(Side side) { return side == Side::kSource ? source : target; }
  const CanvasState& canvas(Side side) const { return side == Side::kSource ? source : target; }
};

} // namespace oversketch
