#pragma once

#include "ui/state/editor.h"

#include <mutex>
#include <optional>
#include <vector>

namespace oversketch {

/// What workers have finished, waiting for the window's thread.
struct Editor::Inbox {
  struct Entry {
    int tab = 0;
    Then then;
    Result<void> result;
  };
  std::mutex mutex;
  std::vector<Entry> entries;
  /// What earlier runs left behind, once it has been looked for.
  std::optional<std::vector<AbandonedJournal>> found;
};

} // namespace oversketch
