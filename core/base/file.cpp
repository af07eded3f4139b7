#include "core/base/file.h"

#include "core/base/temporary_name.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace oversketch {

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

int write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return errno;
    bytes = bytes.subspan(static_cast<std::size_t>(put));
  }
  return 0;
}

namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// Owns a file descriptor.
class Descriptor {
public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool open() const { return number_ >= 0; }
  int number() const { return number_; }
  /// 0, or the error that closing brought to light (a full disk on some network file systems).
  int close() {
    if (number_ < 0) return 0;
    return ::close(std::exchange(number_, -1)) == 0 ? 0 : errno;
  }

private:
  int number_;
};

/// Reads until the end, appending; stops with file.too-large beyond `most`.
template <class Container>
Result<Container> read_all(const fs::path& path, std::uintmax_t most) {
  const auto unreadable = [&](const std::string& why) {
    return Error{"file.unreadable", "the file cannot be read: " + why, path.string()};
  };
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.open()) {
    const int error = errno;
    if (error == ENOENT || error == ENOTDIR) return Error{"file.missing", "there is no such file", path.string()};
    return unreadable(reason(error));
  }
  struct stat info {};
  if (::fstat(file.number(), &info) != 0) return unreadable(reason(errno));
  if (S_ISDIR(info.st_mode)) return unreadable("it is a folder");
  const Error too_large{"file.too-large", "the file has more than " + std::to_string(most) + " bytes", path.string()};
  if (S_ISREG(info.st_mode) && static_cast<std::uintmax_t>(info.st_size) > most) return too_large;
  Container bytes(static_cast<std::size_t>(S_ISREG(info.st_mode) ? info.st_size : 0), {});
  std::size_t filled = 0;
  for (;;) {
    // Room for one byte more than told shows a file that grew, or a pipe, whose size nobody tells.
    constexpr std::size_t step = 1 << 16;
    if (filled == bytes.size()) bytes.resize(filled + (filled == 0 || filled >= step ? step : filled + 1));
    const ssize_t got = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return unreadable(reason(errno));
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
    if (filled > most) return too_large;
  }
  bytes.resize(filled);
  return bytes;
}

/// A file beside the one to be replaced; gone with this object unless it took the other's place.
class TemporaryFile {
public:
  explicit TemporaryFile(const fs::path& folder) : file_(create(folder)) {}
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// 0 or the system's error, as below.
  int error() const { return error_; }
  int fill(std::span<const std::byte> bytes, const struct stat* old, const Watch& watch = {}) {
    // The owner stays where this user may give files away; permissions after it, which it would take from them.
    if (old != nullptr) (void)!::fchown(file_.number(), old->st_uid, old->st_gid);
    if (old != nullptr && ::fchmod(file_.number(), old->st_mode & 07777) != 0) return errno;
    constexpr std::size_t kPiece = 4 << 20;
    for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
      if (watch.stopped()) return ECANCELED;
      watch.report(static_cast<double>(at) / static_cast<double>(bytes.size()), "writing");
      if (const int error = write_all(file_.number(), bytes.subspan(at, std::min(kPiece, bytes.size() - at))))
        return error;
    }
    if (watch.stopped()) return ECANCELED;
    if (::fsync(file_.number()) != 0) return errno;
    return file_.close();
  }
  int take_place_of(const fs::path& path) {
    if (::rename(path_.c_str(), path.c_str()) != 0) return errno;
    path_.clear();
    return 0;
  }

private:
  int create(const fs::path& folder) {
    for (int attempt = 0; attempt < 100; ++attempt) {
      path_ = temporary_name(folder, attempt);
      const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0 && lock_temporary(descriptor)) return error_ = 0, descriptor;
      error_ = descriptor >= 0 ? EEXIST : errno;
      if (descriptor >= 0) ::close(descriptor);
      if (error_ != EEXIST) break;
    }
    path_.clear();
    return -1;
  }

  fs::path path_;
  int error_ = 0;
  Descriptor file_;
  /// Holds the lock until the file has its name, when `file_` is closed already.
  Descriptor lock_{::fcntl(file_.number(), F_DUPFD_CLOEXEC, 0)};
};

int write_in_place(const fs::path& path, std::span<const std::byte> bytes) {
  // A pipe that nobody reads would never open: whoever is to read it has a while to come.
  constexpr int kTries = 200;
  const timespec pause{0, 10'000'000};
  int number = -1;
  for (int i = 0; i < kTries && number < 0; ++i) {
    if (i > 0) ::nanosleep(&pause, nullptr);
    number = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (number < 0 && errno != ENXIO) return errno;
  }
  Descriptor file(number);
  if (!file.open()) return EPIPE;
  if (::fcntl(file.number(), F_SETFL, ::fcntl(file.number(), F_GETFL) & ~O_NONBLOCK) != 0) return errno;
  if (const int error = write_all(file.number(), bytes)) return error;
  return file.close();
}

/// A second name for the file, at a fresh name beside it; 0 or the system's error.
int link_beside(const fs::path& path, const fs::path& folder, fs::path& link) {
  int error = EEXIST;
  for (int attempt = 0; attempt < 100 && error == EEXIST; ++attempt) {
    link = temporary_name(folder, attempt);
    error = ::link(path.c_str(), link.c_str()) == 0 ? 0 : errno;
  }
  return error;
}

/// Gives the file the name NAME~ besides its own.
int keep_previous(const fs::path& path, const fs::path& folder, const struct stat& old) {
  const fs::path backup = path.string() + "~";
  fs::path link;
  if (link_beside(path, folder, link) == 0) {
    const int error = ::rename(link.c_str(), backup.c_str()) == 0 ? 0 : errno;
    // Where both are the same file already, renaming does nothing.
    ::unlink(link.c_str());
    return error;
  }
  // A file system without links.
  const auto bytes = read_all<std::vector<std::byte>>(path, static_cast<std::uintmax_t>(old.st_size));
  if (!bytes) return EIO;
  TemporaryFile copy(folder);
  if (copy.error() != 0) return copy.error();
  if (const int error = copy.fill(*bytes, &old)) return error;
  return copy.take_place_of(backup);
}

int replace(const fs::path& path, std::span<const std::byte> bytes, const WriteOptions& options) {
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) return EISDIR;
  if (exists && !S_ISREG(old.st_mode)) return write_in_place(path, bytes);
  // Asked here because taking the place of a write-protected file needs leave of its folder only.
  if (exists && ::access(path.c_str(), W_OK) != 0) return errno;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  TemporaryFile temporary(folder);
  if (temporary.error() != 0) return temporary.error();
  if (const int error = temporary.fill(bytes, exists ? &old : nullptr, options.watch)) return error;
  if (exists && options.keep_previous)
    if (const int error = keep_previous(path, folder, old)) return error;
  if (const int error = temporary.take_place_of(path)) return error;
  // The new name itself is synced with the folder.  Some file systems cannot; the file is whole there either way.
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.open()) ::fsync(opened.number());
  if (options.clean_folder) remove_stale_temporaries(folder);
  return 0;
}

} // namespace

Result<std::vector<std::byte>> read_file(const fs::path& path, std::uintmax_t most_bytes) {
  return read_all<std::vector<std::byte>>(path, most_bytes);
}

Result<std::string> read_text_file(const fs::path& path, std::uintmax_t most_bytes) {
  return read_all<std::string>(path, most_bytes);
}

std::optional<FileStamp> stamp_of(const fs::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
  constexpr std::int64_t kSecond = 1'000'000'000;
  return FileStamp{static_cast<std::uintmax_t>(info.st_size), info.st_mtim.tv_sec * kSecond + info.st_mtim.tv_nsec};
}

bool lies_below(const fs::path& folder, const fs::path& path) {
  std::error_code failure;
  const fs::path root = fs::weakly_canonical(fs::absolute(folder), failure);
  if (failure) return false;
  // A link to nothing would be followed when it is written.
  fs::path full = fs::absolute(path);
  for (int links = 0; fs::is_symlink(full, failure); ++links) {
    if (links == 40) return false;
    const fs::path to = fs::read_symlink(full, failure);
    if (failure) return false;
    full = to.is_absolute() ? to : full.parent_path() / to;
  }
  const fs::path real = fs::weakly_canonical(full, failure);
  return !failure && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
}

Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes) {
  return write_file(path, bytes, WriteOptions{});
}

Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes, const WriteOptions& options) {
  std::error_code ignored;
  fs::path real = path;
  if (fs::is_symlink(path, ignored)) {
    std::error_code broken;
    real = fs::weakly_canonical(path, broken);
    if (broken) return Error{"file.write", "the file cannot be written: " + broken.message(), path.string()};
  }
  const int error = replace(real, bytes, options);
  if (error == ECANCELED) return cancelled();
  if (error != 0) return Error{"file.write", "the file cannot be written: " + reason(error), path.string()};
  return {};
}

Result<void> write_file(const fs::path& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

} // namespace oversketch
