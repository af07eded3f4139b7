#pragma once

#include <functional>
#include <thread>

namespace oversketch::gui {

/// Hears it when the program is told to end from outside: SIGTERM, SIGINT, SIGHUP.  One at a time.
class Termination {
public:
  /// @param told  called by a thread of its own, once; a second signal ends the program as if nobody had listened.
  explicit Termination(std::function<void()> told);
  ~Termination();
  Termination(const Termination&) = delete;
  Termination& operator=(const Termination&) = delete;

private:
  /// The end that is read; −1 when the system gave none.
  int read_end_ = -1;
  std::jthread listener_;
};

} // namespace oversketch::gui
