#pragma once

#include <functional>
#include <thread>

namespace oversketch::gui {

/// SIGTERM, SIGINT and SIGHUP wait, in this thread and all that it starts, for a Termination to hear them.
void hold_end_signals();

/// Hears it when the program is told to end from outside; when this is over, a signal ends the program at once.
class Termination {
public:
  /// @param told  called by a thread of its own, once; a second signal ends the program as if nobody had listened.
  explicit Termination(std::function<void()> told);
  ~Termination();
  Termination(const Termination&) = delete;
  Termination& operator=(const Termination&) = delete;

private:
  /// What is read when a signal came, and what is written when this is over; −1 when the system gave none.
  int signals_ = -1;
  int over_ = -1;
  std::jthread listener_;
};

} // namespace oversketch::gui
