#pragma once

#include "ui/state/editor.h"

#include <mutex>

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
};

} // namespace oversketch
