#pragma once

#include "core/session/live_session.h"
#include "ui/state/action.h"
#include "ui/state/preferences.h"
#include "ui/state/view_state.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// One document in the window.
struct Tab {
  std::unique_ptr<LiveSession> session;
  DocumentView view;
  /// Where it was opened from or saved to; empty before that.
  std::filesystem::path path;
  std::filesystem::path exported_to;
  /// Cannot be saved over its file (a newer version's): save asks for another name.
  bool read_only = false;
};

/// All that the window shows and no document holds.
struct EditorState {
  std::vector<Tab> tabs;
  std::size_t front = 0;
  Tool tool = Tool::kOutline;
  Overlays overlays;
  Preferences preferences;
  /// The status bar's line, and until when it stays (the frame clock's seconds).
  std::string said;
  double said_until = 0;
  bool show_shortcuts = false;
  bool show_preferences = false;
  bool show_about = false;

  Tab* tab() { return front < tabs.size() ? &tabs[front] : nullptr; }
  const Tab* tab() const { return front < tabs.size() ? &tabs[front] : nullptr; }
};

} // namespace oversketch
