#pragma once

#include "ui/canvas/canvas_panel.h"
#include "ui/panels/deform_panel.h"
#include "ui/panels/dialogs.h"
#include "ui/panels/file_browser.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/layers_panel.h"
#include "ui/state/shortcuts.h"
#include "ui/window_state.h"

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
  CanvasesState canvases;
  LayersPanelState layers;
  DeformPanelState deform;
  HistoryPanelState history;
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
