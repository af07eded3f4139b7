#pragma once

// What holds for every document and every session, whatever led to it.

#include "core/session/session.h"

#include "tests/fuzz/fuzz.h"

#include <cmath>
#include <set>

namespace oversketch::fuzz {

inline void check_layer(const Layer& layer, const Document& document) {
  MUST_HOLD(layer.id.number > 0 && layer.id.number < document.next_layer, "layer ids stay below their counter");
  MUST_HOLD(!layer.source.image.empty(), "a layer has a source");
  MUST_HOLD(layer.outline.empty() == layer.sketch.empty(), "a region has a sketch");
  MUST_HOLD(layer.outline.empty() || check_closed_curve(layer.outline, "outline").ok(), "outlines are simple");
  for (const Point p : layer.outline)
    MUST_HOLD(p.x >= 0 && p.y >= 0 && p.x <= layer.source.image.width() && p.y <= layer.source.image.height(),
              "outlines lie in their pictures");
  for (const Point p : layer.sketch)
    MUST_HOLD(is_finite(p), "sketches are numbers");
  const Placement& placement = layer.placement;
  MUST_HOLD(std::isfinite(placement.factor.real()) && std::isfinite(placement.factor.imag()), "placements are numbers");
  MUST_HOLD(placement.offset.x >= 0 && placement.offset.x < 1 && placement.offset.y >= 0 && placement.offset.y < 1,
            "whole pixels stand apart");
}

inline void check_document(const Document& document) {
  if (document.empty()) {
    MUST_HOLD(document.layers.empty(), "no layers without a target");
    return;
  }
  std::set<int> layers, pins;
  for (const Layer& layer : document.layers) {
    check_layer(layer, document);
    MUST_HOLD(layers.insert(layer.id.number).second, "layer ids differ");
    for (const Pin& pin : layer.pins) {
      MUST_HOLD(pins.insert(pin.id.number).second && pin.id.number < document.next_pin, "pin ids differ");
      MUST_HOLD(is_finite(pin.outline) && is_finite(pin.sketch), "pins are numbers");
    }
  }
  MUST_HOLD(!document.selected || document.find(*document.selected) != nullptr, "what is selected is there");
}

/// To the first entry and back: each document as it was.  The cursor ends where it stood.
inline void check_history(Session& session) {
  const auto entries = session.history().entries();
  const std::size_t cursor = session.history().cursor();
  if (entries.empty()) return;
  MUST_HOLD(session.jump(0).ok(), "undo all");
  MUST_HOLD(session.document() == entries.front().document, "undo all leads to the beginning");
  for (std::size_t i = 1; i < entries.size(); ++i) {
    MUST_HOLD(session.redo().ok(), "redo");
    MUST_HOLD(session.document() == entries[i].document, "redo leads where the command did");
  }
  MUST_HOLD(!session.history().can_redo(), "redo all leads to the end");
  MUST_HOLD(session.jump(cursor).ok(), "back");
}

inline void check_session(Session& session) {
  for (const History::Entry& entry : session.history().entries())
    check_document(entry.document);
  check_history(session);
}

} // namespace oversketch::fuzz
