#pragma once

#include "ui/state/editor_state.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

struct FileRow {
  std::filesystem::path path;
  /// What is shown: the name, of recent files too.
  std::string name;
  bool folder = false;
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type time{};
};

struct FolderListing {
  std::filesystem::path folder;
  std::vector<FileRow> rows;
  /// Why the folder cannot be shown; empty when it can.
  std::string problem;
};

enum class FileFilter { kAll, kPictures, kProjects };
enum class FileSort { kName, kSize, kDate };

/// Everything in a folder, in no order.  Touches the disk: for a worker.
FolderListing read_folder(const std::filesystem::path& folder);
/// The files that still exist, in the order given.
FolderListing read_files(const std::vector<std::filesystem::path>& files);

/// What a browser shows of them: folders first, then by the column; hidden ones and other kinds left out.
std::vector<FileRow> arrange(std::vector<FileRow> rows, FileFilter filter, FileSort sort, bool descending, bool hidden);

/// By the name's ending, in any case.
bool is_picture(const std::filesystem::path& path);
bool is_project(const std::filesystem::path& path);

/// The next row, from `from` on and round, whose name begins with the text, in any case; −1 when there is none.
int find_by_prefix(const std::vector<FileRow>& rows, std::string_view text, int from);

/// What is typed, made longer as far as all names that begin like it agree; a single folder gets its slash.
/// @param base  what relative paths begin at.
std::string complete_path(std::string_view typed, const std::filesystem::path& base);

/// What is typed as a path: "~" is the home, relative ones begin at the base.
std::filesystem::path path_of(std::string_view typed, const std::filesystem::path& base);

/// "1.2 MB".
std::string format_bytes(std::uintmax_t bytes);
/// "2026-11-27 14:03", of this machine's clock.
std::string format_time(std::filesystem::file_time_type time);

struct Place {
  std::string id;
  std::string label;
  /// Empty: the recent files.
  std::filesystem::path path;
};
/// Home, desktop, pictures, samples, recent and the root: those that are there.
std::vector<Place> make_places(const std::filesystem::path& samples);

} // namespace oversketch
