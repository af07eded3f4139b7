#pragma once

// Names and locks of a journal's files: shared by its writer and its readers.

#include "core/base/file.h"
#include "core/base/result.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace oversketch {

inline constexpr const char* kJournalsFolder = "journals";
inline constexpr const char* kJournalFile = "journal.jsonl";
inline constexpr const char* kJournalBase = "base.ora";
inline constexpr const char* kJournalImages = "images";
inline constexpr const char* kJournalLock = "lock";
/// Comment lines of the script.
inline constexpr std::string_view kNameComment = "# name: ", kSavedComment = "# saved: ", kStampComment = "# stamp: ";

/// The line that tells how the project's file is, as far as this program knows; without its end.
std::string print_stamp(const std::filesystem::path& project);
std::optional<FileStamp> parse_stamp(std::string_view line);

/// An open file, closed with the object.
class OpenFile {
public:
  explicit OpenFile(int descriptor = -1) : descriptor_(descriptor) {}
  ~OpenFile();
  OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  bool open() const { return descriptor_ >= 0; }
  int number() const { return descriptor_; }

private:
  int descriptor_;
};

/// The folder's lock, taken; not open when a living process holds it, or the folder is not there.
OpenFile take_journal_lock(const std::filesystem::path& folder, bool make);

Error journal_write_error(int system_error, const std::filesystem::path& path);

} // namespace oversketch
