#pragma once

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
};

} // namespace oversketch
