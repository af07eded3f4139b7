#include "core/io/file_claim.h"

#include "core/base/hash.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

/// Whether the name still leads to the open file: its last owner may have removed it just before it was locked here.
bool is_still_there(const OpenFile& file, const fs::path& path) {
  struct stat open {
  }, named{};
  return ::fstat(file.number(), &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

} // namespace

Result<std::optional<FileClaim>> FileClaim::take(const fs::path& state_folder, const fs::path& project) {
  const fs::path folder = state_folder / "open";
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) return journal_write_error(failure.value(), folder);
  fs::path real = fs::weakly_canonical(project, failure);
  if (failure) real = project;
  const fs::path path = folder / (to_string(Hasher().add(real.string()).finish()) + ".lock");
  for (int attempt = 0; attempt < 100; ++attempt) {
    OpenFile file(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_CREAT, 0600));
    if (!file.open()) return journal_write_error(errno, path);
    if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return journal_write_error(errno, path);
      return std::optional<FileClaim>();
    }
    if (is_still_there(file, path)) return std::optional(FileClaim(std::move(file), path));
  }
  return journal_write_error(EAGAIN, path);
}

FileClaim::~FileClaim() {
  release();
}

FileClaim& FileClaim::operator=(FileClaim&& other) noexcept {
  std::swap(lock_, other.lock_);
  std::swap(path_, other.path_);
  return *this;
}

void FileClaim::release() {
  // While it is still locked, so that nobody else's is removed.
  if (lock_.open()) ::unlink(path_.c_str());
}

} // namespace oversketch
