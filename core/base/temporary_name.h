#pragma once

#include <filesystem>

namespace oversketch {

/// Names of files that stand beside another while it is written: ".oversketch-PROCESS-TIME-ATTEMPT.tmp", numbers in
/// hex. No other call, thread or process is likely to choose the same at the same moment; O_EXCL settles the rest.
std::filesystem::path temporary_name(const std::filesystem::path& folder, int attempt);

/// Takes the lock by which others see that a file of such a name is still being written; it goes with the descriptor.
///
/// @returns false where somebody was just about to clean the file away: choose another name then.  True also where the
///   file system knows no locks; nobody cleans there.
bool lock_temporary(int descriptor);

/// Removes what killed processes have left in the folder; returns how many files.
///
/// Gone are regular files alone, of exactly such a name, of this user, whose process no longer runs here and whose lock
/// is free: another process's file, of another machine on a shared disk too, holds its lock.
/// @cost reads the folder's names.  @threads safe, for the same folder too.
int remove_stale_temporaries(const std::filesystem::path& folder);

} // namespace oversketch
