#pragma once

// What a Journal has open; for its own sources.

#include "core/io/journal.h"
#include "core/io/journal_files.h"
#include "core/io/picture_folder.h"

#include <deque>
#include <mutex>
#include <variant>

namespace oversketch {

struct Journal::Data {
  /// A step, or a comment.
  using Line = std::variant<Step, std::string>;

  explicit Data(std::filesystem::path in)
      : folder(std::move(in)), pictures(folder, kJournalImages, PictureFolder::Form::kAsOpened) {}

  /// @param bytes  of whole lines that stand there.
  Result<void> open_for_appending(std::size_t bytes);
  Result<void> write_waiting();

  std::filesystem::path folder;
  OpenFile lock;
  OpenFile file;
  std::mutex mutex;
  /// Not written yet; the first one's turn is next.
  std::deque<Line> waiting;

private:
  Result<std::string> line_of(const Line& line);
  /// 0 or the system's error.
  int append_whole(std::string_view line);

  PictureFolder pictures;
  /// Bytes of the whole lines in the file.
  std::size_t size = 0;
};

/// Makes a Journal of what is there.
struct JournalRecovery {
  using Data = Journal::Data;
  static Journal adopt(std::unique_ptr<Journal::Data> data) { return Journal(std::move(data)); }
};

} // namespace oversketch
