#include "core/base/temporary_name.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

std::string print_name(unsigned long process, unsigned long long time, unsigned attempt) {
  char name[80];
  std::snprintf(name, sizeof name, ".oversketch-%lx-%llx-%x.tmp", process, time, attempt);
  return name;
}

/// The process that made a file of that name, if it is one of ours.
std::optional<pid_t> maker_of(const std::string& name) {
  unsigned long process = 0;
  unsigned long long time = 0;
  unsigned attempt = 0;
  if (std::sscanf(name.c_str(), ".oversketch-%lx-%llx-%x.tmp", &process, &time, &attempt) != 3) return std::nullopt;
  const auto id = static_cast<pid_t>(process);
  // Signs, blanks, other digits: read as well, but never written.
  if (print_name(process, time, attempt) != name || id <= 0 || static_cast<unsigned long>(id) != process)
    return std::nullopt;
  return id;
}

bool is_running(pid_t process) {
  return ::kill(process, 0) == 0 || errno != ESRCH;
}

/// Whether the open file is one that its dead maker left, and still has that name.
bool is_left_behind(int file, const fs::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && S_ISREG(opened.st_mode) && opened.st_uid == ::geteuid() &&
         ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::lstat(path.c_str(), &named) == 0 && named.st_ino == opened.st_ino &&
         named.st_dev == opened.st_dev;
}

} // namespace

fs::path temporary_name(const fs::path& folder, int attempt) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  return folder / print_name(static_cast<unsigned long>(::getpid()), static_cast<unsigned long long>(now),
                             static_cast<unsigned>(attempt));
}

bool lock_temporary(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
  struct stat info {};
  return ::fstat(descriptor, &info) == 0 && info.st_nlink > 0;
}

int remove_stale_temporaries(const fs::path& folder) {
  std::error_code failure;
  std::vector<fs::path> left;
  fs::directory_iterator entry(folder, failure);
  for (; !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
    const auto maker = maker_of(entry->path().filename().string());
    if (maker && !is_running(*maker)) left.push_back(entry->path());
  }
  int removed = 0;
  for (const fs::path& path : left) {
    // Not blocked by a pipe of that name, nor led elsewhere by a link.
    const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) continue;
    if (is_left_behind(file, path) && ::unlink(path.c_str()) == 0) ++removed;
    ::close(file);
  }
  return removed;
}

} // namespace oversketch
