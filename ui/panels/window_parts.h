#pragma once

#include "ui/panels/deform_panel.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/layers_panel.h"
#include "ui/state/shortcuts.h"
#include "ui/window_state.h"

namespace oversketch {

/// See WindowState.
struct WindowState::Parts {
  std::function<void()> wake;
  std::unique_ptr<SystemDialog> system;
  WindowFlags flags;
  /// Design pixels.
  float side_width = 320;
  LayersPanelState layers;
  DeformPanelState deform;
  HistoryPanelState history;
};

} // namespace oversketch
