#include "ui/panels/file_listing.h"

#include "core/base/file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <system_error>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(),
                         [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return out;
}

template <std::size_t n>
bool has_ending(const fs::path& path, const std::array<std::string_view, n>& endings) {
  return std::ranges::find(endings, ending_of(path)) != endings.end();
}

FileRow read_row(const fs::directory_entry& entry) {
  std::error_code error;
  FileRow row{entry.path(), entry.path().filename().string(), entry.is_directory(error), 0, {}};
  if (!row.folder) row.bytes = entry.file_size(error);
  if (error) row.bytes = 0;
  row.time = entry.last_write_time(error);
  return row;
}

/// Digits count as numbers: "fish 9" comes before "fish 10".
bool comes_before(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto run = [&](std::string_view text, std::size_t& at) {
        while (at + 1 < text.size() && text[at] == '0' && digit(text[at + 1]))
          ++at;
        const std::size_t from = at;
        while (at < text.size() && digit(text[at]))
          ++at;
        return text.substr(from, at - from);
      };
      const std::string_view x = run(a, i), y = run(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      continue;
    }
    if (a[i] != b[j]) return a[i] < b[j];
    ++i;
    ++j;
  }
  return a.size() - i < b.size() - j;
}

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  return home == nullptr ? fs::path() : fs::path(home);
}

/// XDG_PICTURES_DIR and its like from user-dirs.dirs, where desktops keep the folders' names in the user's language.
fs::path user_folder(std::string_view key, const char* otherwise) {
  const fs::path home = home_folder();
  if (home.empty()) return {};
  const char* config = std::getenv("XDG_CONFIG_HOME");
  std::ifstream file((config != nullptr && *config != '\0' ? fs::path(config) : home / ".config") / "user-dirs.dirs");
  for (std::string line; std::getline(file, line);) {
    const std::string start = std::string(key) + "=\"";
    if (!line.starts_with(start)) continue;
    std::string value = line.substr(start.size(), line.rfind('"') - start.size());
    if (value.starts_with("$HOME/")) return home / value.substr(6);
    return value;
  }
  return home / otherwise;
}

} // namespace

FolderListing read_folder(const fs::path& folder) {
  FolderListing listing{folder, {}, {}};
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) {
    listing.problem = folder.string() + " cannot be shown: " + error.message() + ".";
    return listing;
  }
  for (; entries != fs::directory_iterator(); entries.increment(error)) {
    listing.rows.push_back(read_row(*entries));
    if (error) break;
  }
  return listing;
}

FolderListing read_files(const std::vector<fs::path>& files) {
  FolderListing listing;
  for (const fs::path& file : files) {
    std::error_code error;
    const fs::directory_entry entry(file, error);
    if (!error && entry.exists(error)) listing.rows.push_back(read_row(entry));
  }
  return listing;
}

bool is_picture(const fs::path& path) {
  static constexpr std::array<std::string_view, 6> kEndings = {".png", ".jpg", ".jpeg", ".bmp", ".tga", ".hdr"};
  return has_ending(path, kEndings);
}

bool is_project(const fs::path& path) {
  static constexpr std::array<std::string_view, 2> kEndings = {".ora", ".jsonl"};
  return has_ending(path, kEndings);
}

std::vector<FileRow> arrange(std::vector<FileRow> rows, FileFilter filter, FileSort sort, bool descending,
                             bool hidden) {
  std::erase_if(rows, [&](const FileRow& row) {
    if (!hidden && row.name.starts_with('.')) return true;
    if (row.folder || filter == FileFilter::kAll) return false;
    return filter == FileFilter::kPictures ? !is_picture(row.path) : !is_project(row.path);
  });
  const auto by_name = [](const FileRow& a, const FileRow& b) { return comes_before(lower(a.name), lower(b.name)); };
  std::ranges::stable_sort(rows, [&](const FileRow& a, const FileRow& b) {
    if (a.folder != b.folder) return a.folder;
    const FileRow& first = descending ? b : a;
    const FileRow& second = descending ? a : b;
    if (sort == FileSort::kSize && first.bytes != second.bytes) return first.bytes < second.bytes;
    if (sort == FileSort::kDate && first.time != second.time) return first.time < second.time;
    return sort == FileSort::kName ? by_name(first, second) : by_name(a, b);
  });
  return rows;
}

int find_by_prefix(const std::vector<FileRow>& rows, std::string_view text, int from) {
  const int count = static_cast<int>(rows.size());
  const std::string start = lower(text);
  for (int step = 0; step < count; ++step) {
    const int index = (std::max(from, 0) + step) % count;
    if (lower(rows[static_cast<std::size_t>(index)].name).starts_with(start)) return index;
  }
  return -1;
}

fs::path path_of(std::string_view typed, const fs::path& base) {
  if (typed == "~") return home_folder();
  if (typed.starts_with("~/")) return home_folder() / typed.substr(2);
  const fs::path path(typed);
  return (path.is_absolute() ? path : base / path).lexically_normal();
}

std::string complete_path(std::string_view typed, const fs::path& base) {
  const std::size_t slash = typed.rfind('/');
  const std::string_view head = slash == std::string_view::npos ? std::string_view() : typed.substr(0, slash + 1);
  const std::string_view tail = typed.substr(head.size());
  const FolderListing listing = read_folder(head.empty() ? base : path_of(head, base));
  std::string common;
  int matches = 0;
  bool folder = false;
  for (const FileRow& row : listing.rows) {
    if (!row.name.starts_with(tail) || (tail.empty() && row.name.starts_with('.'))) continue;
    folder = row.folder;
    if (matches++ == 0) {
      common = row.name;
      continue;
    }
    const auto differ = std::ranges::mismatch(common, row.name).in1;
    common.erase(differ, common.end());
  }
  if (matches == 0) return std::string(typed);
  return std::string(head) + common + (matches == 1 && folder ? "/" : "");
}

std::string format_bytes(std::uintmax_t bytes) {
  static constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; size >= 1000 && unit + 1 < kUnits.size(); ++unit)
    size /= 1000;
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 || size >= 99.5 ? "%.0f %s" : "%.1f %s", size, kUnits[unit]);
  return text;
}

std::string format_time(fs::file_time_type time) {
  const auto system = std::chrono::file_clock::to_sys(time);
  const std::time_t seconds =
      std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::system_clock::duration>(system));
  std::tm local{};
  if (localtime_r(&seconds, &local) == nullptr) return {};
  char text[64];
  if (std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local) == 0) return {};
  return text;
}

std::vector<Place> make_places(const fs::path& samples) {
  std::vector<Place> places;
  const auto add = [&](const char* id, const char* label, const fs::path& path) {
    std::error_code error;
    if (!path.empty() && fs::is_directory(path, error)) places.push_back({id, label, path});
  };
  places.push_back({"recent", "Recent", {}});
  add("home", "Home", home_folder());
  add("desktop", "Desktop", user_folder("XDG_DESKTOP_DIR", "Desktop"));
  add("pictures", "Pictures", user_folder("XDG_PICTURES_DIR", "Pictures"));
  add("samples", "Samples", samples);
  add("root", "Computer", "/");
  return places;
}

} // namespace oversketch
