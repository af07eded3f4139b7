#pragma once

#include "core/base/result.h"
#include "core/io/journal_files.h"

#include <filesystem>
#include <optional>

namespace oversketch {

/// A project that one window has open for writing: the next one is told, and keeps from saving over it.
///
/// A lock in STATE/open/, named by the project's path with its links followed; nothing is put beside the project
/// itself.  It ends with the object or with the process.  Advice among instances of this program, no protection from
/// others.
/// @threads one at a time; claims of several threads and processes may meet.
class FileClaim {
public:
  /// @returns none where somebody has it already, in this process or another.
  /// @errors journal.write: nothing can be claimed there.
  static Result<std::optional<FileClaim>> take(const std::filesystem::path& state_folder,
                                               const std::filesystem::path& project);
  ~FileClaim();
  FileClaim(FileClaim&& other) noexcept = default;
  FileClaim& operator=(FileClaim&& other) noexcept;

private:
  FileClaim(OpenFile lock, std::filesystem::path path) : lock_(std::move(lock)), path_(std::move(path)) {}
  void release();

  OpenFile lock_;
  std::filesystem::path path_;
};

} // namespace oversketch
