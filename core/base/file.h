#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

/// The whole file.
/// @errors file.missing, file.unreadable (a folder, no permission), file.too-large (more than `most_bytes`); `where` is
///   the path.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uintmax_t most_bytes = 2'000'000'000);
Result<std::string> read_text_file(const std::filesystem::path& path, std::uintmax_t most_bytes = 500'000'000);

/// ".png" of "a/Sea.PNG": what tells kinds of files apart, in lower case; empty where there is none.
std::string ending_of(const std::filesystem::path& path);

/// All of the bytes to an open file.
/// @returns 0 or the system's error.
int write_all(int descriptor, std::span<const std::byte> bytes);

/// Whether a path, all links on it followed, lies below the folder; what is not there yet counts as it would be made.
bool lies_below(const std::filesystem::path& folder, const std::filesystem::path& path);

/// By which a file is known to be as it was.
struct FileStamp {
  std::uintmax_t bytes = 0;
  /// Of its last change, ns.
  std::int64_t changed = 0;
  bool operator==(const FileStamp&) const = default;
};
/// None where there is no file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

/// Replaces the file whole or not at all: written to a fresh name beside it, synced, renamed.  A failure leaves the old
/// file as it was and no other file behind.  A link stays a link: the file it leads to is replaced.  Permissions of a
/// file that was there are kept.  What is no file at all (a device, a pipe) is written to as it stands; a pipe that
/// nobody comes to read within two seconds is an error.
/// @threads may be called from several threads, for the same path too: the last one wins whole.
/// @errors file.write, with the system's reason; `where` is the path.
Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

struct WriteOptions {
  /// The file that was there stays beside the new one under this name and "~", in place of an older one of that name.
  /// At no moment is either name without a whole file.
  bool keep_previous = false;
  /// What killed processes left beside it while they wrote is removed (remove_stale_temporaries()).
  bool clean_folder = false;
  /// Stopped: error cancelled, the old file as it was.
  Watch watch{};
};
Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                        const WriteOptions& options);
Result<void> write_file(const std::filesystem::path& path, std::string_view text);

} // namespace oversketch
