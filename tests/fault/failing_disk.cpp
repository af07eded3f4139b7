// The C library's calls that write to a disk, put in front of it: this program's own symbols are found first.

#include "tests/fault/failing_disk.h"

#include <atomic>
#include <cerrno>
#include <cstdarg>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace oversketch::testing {
namespace {

std::atomic<bool> armed = false;
std::atomic<int> calls = 0;
std::atomic<int> failing_call = 0;
std::atomic<int> failure = 0;

/// Counts a call; whether it is the one that fails.
bool fails_now() {
  if (!armed) return false;
  if (++calls != failing_call) return false;
  errno = failure;
  return true;
}

/// Terminals, pipes and the like are no disk.
bool on_disk(int descriptor) {
  struct stat info {};
  return syscall(SYS_fstat, descriptor, &info) == 0 && (S_ISREG(info.st_mode) || S_ISDIR(info.st_mode));
}

template <class... Args>
int call(long number, Args... args) {
  return static_cast<int>(syscall(number, args...));
}

} // namespace

void fail_disk_call(int nth, int error) {
  calls = 0;
  failing_call = nth;
  failure = error;
  armed = true;
}

int mend_disk() {
  armed = false;
  return calls;
}

} // namespace oversketch::testing

extern "C" {

using namespace oversketch::testing;

ssize_t write(int descriptor, const void* bytes, size_t count) {
  if (on_disk(descriptor) && fails_now()) {
    if (failure == ENOSPC && count > 1) syscall(SYS_write, descriptor, bytes, count / 2);
    errno = failure;
    return -1;
  }
  return syscall(SYS_write, descriptor, bytes, count);
}
int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & O_CREAT) {
    va_list list;
    va_start(list, flags);
    mode = va_arg(list, mode_t);
    va_end(list);
    if (fails_now()) return -1;
  }
  return call(SYS_openat, AT_FDCWD, path, flags, mode);
}
int fsync(int descriptor) {
  return fails_now() ? -1 : call(SYS_fsync, descriptor);
}
int fdatasync(int descriptor) {
  return fails_now() ? -1 : call(SYS_fdatasync, descriptor);
}
int ftruncate(int descriptor, off_t size) noexcept {
  return fails_now() ? -1 : call(SYS_ftruncate, descriptor, size);
}
int rename(const char* from, const char* to) noexcept {
  return fails_now() ? -1 : call(SYS_rename, from, to);
}
int link(const char* from, const char* to) noexcept {
  return fails_now() ? -1 : call(SYS_link, from, to);
}
int mkdir(const char* path, mode_t mode) noexcept {
  return fails_now() ? -1 : call(SYS_mkdir, path, mode);
}
}
