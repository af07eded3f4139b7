#include "app/gui/termination.h"

#include <csignal>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

namespace oversketch::gui {
namespace {

sigset_t end_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP})
    sigaddset(&set, signal);
  return set;
}

/// @param how  SIG_BLOCK or SIG_UNBLOCK, for this thread.
void mask_end_signals(int how) {
  const sigset_t set = end_signals();
  pthread_sigmask(how, &set, nullptr);
}

/// Until one of them can be read.
void wait(pollfd* wanted, nfds_t count) {
  while (poll(wanted, count, -1) < 0) {
  }
}

void listen(int signals, int over, const std::function<void()>& told) {
  pollfd both[] = {{signals, POLLIN, 0}, {over, POLLIN, 0}};
  wait(both, 2);
  signalfd_siginfo signal;
  if (both[1].revents != 0 || read(signals, &signal, sizeof signal) < 0) return;
  told();
  // From here on this thread takes what comes, and the program ends.
  mask_end_signals(SIG_UNBLOCK);
  wait(both + 1, 1);
}

} // namespace

void hold_end_signals() {
  mask_end_signals(SIG_BLOCK);
}

Termination::Termination(std::function<void()> told) {
  const sigset_t set = end_signals();
  signals_ = signalfd(-1, &set, SFD_CLOEXEC);
  over_ = eventfd(0, EFD_CLOEXEC);
  if (signals_ >= 0 && over_ >= 0)
    listener_ = std::jthread([this, told = std::move(told)] { listen(signals_, over_, told); });
  else
    mask_end_signals(SIG_UNBLOCK);
}

Termination::~Termination() {
  if (listener_.joinable()) {
    eventfd_write(over_, 1);
    listener_.join();
  }
  for (const int descriptor : {signals_, over_})
    if (descriptor >= 0) close(descriptor);
  // What comes now nobody hears: it ends the program.
  mask_end_signals(SIG_UNBLOCK);
}

} // namespace oversketch::gui
