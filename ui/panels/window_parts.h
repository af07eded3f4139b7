#pragma once

#include "ui/canvas/canvas_panel.h"
#include "ui/panels/deform_panel.h"
#include "ui/panels/dialogs.h"
#include "ui/panels/file_browser.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/tab_bar.h"
#include "ui/state/shortcuts.h"
#include "ui/window_state.h"

#include <limits>

namespace oversketch {

/// See WindowState.
struct WindowState::Parts {
  Parts(const std::function<void()>& wake, std::unique_ptr<SystemDialog> dialog, std::filesystem::path samples)
      : system(std::move(dialog)), browser(wake, std::move(samples)) {}

  std::unique_ptr<SystemDialog> system;
  /// What the desktop's dialog is open for.
  std::optional<FileRequest> system_request;
  WindowFlags flags;
  /// Design pixels.
  float side_width = 320;
  /// What the side panel's sections above the history needed in the frame before, screen pixels.
  float sections_height = std::numeric_limits<float>::infinity();
  CanvasesState canvases;
  LayersPanelState layers;
  DeformPanelState deform;
  HistoryPanelState history;
  TabBarState tabs;
  FileBrowser browser;
  NewDocumentState new_document;
  /// Of a question's answers, the one that Enter gives.
  std::size_t chosen_answer = 0;
  std::string shortcut_search;
  /// The tab that the panels have in hand; what is being typed or dragged there ends with it.
  int tab = 0;
  /// A dialog was drawn in the frame before.
  bool dialog_open = false;
};

} // namespace oversketch
