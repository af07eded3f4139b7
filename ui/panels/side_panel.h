#pragma once

#include "ui/panels/window_layout.h"
#include "ui/panels/window_parts.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/draw_context.h"
#include "ui/widgets/pictures.h"

namespace oversketch {

/// What the side panel's sections draw from.
struct SidePanelScene {
  const EditorState& state;
  /// Of the tab in front; null without one.
  const Snapshot* snapshot = nullptr;
  WindowState::Parts& parts;
  Pictures& pictures;
  const EntryContext& entries;
};

/// The sections one below the other; scrolls where they do not fit.
void draw_side_panel(const SidePanelScene& scene, const Area& area, const DrawContext& context);

} // namespace oversketch
