#include "app/gui/termination.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace oversketch::gui {
namespace {

constexpr int kSignals[] = {SIGTERM, SIGINT, SIGHUP};
constexpr char kTold = 't', kOver = 'o';

/// Where a signal is passed on: all else that a handler may not do is done by who reads it.
std::atomic<int> write_end = -1;

void pass_on(int) {
  const int before = errno;
  [[maybe_unused]] const auto written = write(write_end, &kTold, 1);
  errno = before;
}

void handle(void (*handler)(int), int flags) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  for (const int signal : kSignals)
    sigaction(signal, &action, nullptr);
}

/// @returns what was read; kOver where nothing will come.
char read_one(int descriptor) {
  char what = kOver;
  while (read(descriptor, &what, 1) < 0 && errno == EINTR) {
  }
  return what;
}

} // namespace

Termination::Termination(std::function<void()> told) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  read_end_ = ends[0];
  write_end = ends[1];
  listener_ = std::jthread([told = std::move(told), from = read_end_] {
    if (read_one(from) == kTold) told();
  });
  handle(pass_on, SA_RESTART | static_cast<int>(SA_RESETHAND));
}

Termination::~Termination() {
  if (read_end_ < 0) return;
  handle(SIG_DFL, 0);
  [[maybe_unused]] const auto written = write(write_end, &kOver, 1);
  listener_.join();
  close(write_end.exchange(-1));
  close(read_end_);
}

} // namespace oversketch::gui
