#pragma once

#include <cstdlib>

#include <unistd.h>

namespace oversketch::testing {

/// Folders of tests in memory, where there is such a file system: syncing costs nothing there, and what is tested here
/// is a process that dies and calls that fail, not a disk.
inline void use_folders_in_memory() {
  constexpr const char* kMemory = "/dev/shm";
  if (::access(kMemory, W_OK | X_OK) == 0) ::setenv("TMPDIR", kMemory, 1);
}

} // namespace oversketch::testing
