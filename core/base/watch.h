#pragma once

#include "core/base/result.h"

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oversketch {

/// Milliseconds by stage, in the order in which the stages first ran.
struct StageTimes {
  std::vector<std::pair<std::string, double>> stages_ms;

  void add(std::string_view stage, double ms);
  double total_ms() const;
};

/// How long work is watched over: it can be stopped, says how far it is, leaves its times, and is held to some threads.
///
/// A default-made Watch never stops, tells nobody and uses all cores.  Copies share the stop token.
/// @threads stopped() may be asked from any thread; the rest by the thread that does the work.
struct Watch {
  std::stop_token stop;
  /// Called now and then with the part done, 0…1, and what is being done; may be empty.
  std::function<void(double done, std::string_view stage)> progress;
  /// Where stage times are added; may be null.
  StageTimes* times = nullptr;
  /// How many threads the work may use, the calling one included; 0: as many as there are cores.  The results are the
  /// same bits with any number.
  int threads = 0;

  /// How many to use where more than `most` would not pay: at least 1.
  int threads_up_to(int most) const;
  bool stopped() const { return stop.stop_requested(); }
  void report(double done, std::string_view stage) const {
    if (progress) progress(done, stage);
  }
};

/// The error of work that was asked to stop.
Error cancelled();

/// Adds the time from its making to its end (or to `stop()`) to a stage of `times`, which may be null.
class StageTimer {
public:
  StageTimer(StageTimes* times, std::string_view stage) : times_(times), stage_(stage), start_(Clock::now()) {}
  ~StageTimer() { stop(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

  void stop();

private:
  using Clock = std::chrono::steady_clock;
  StageTimes* times_;
  std::string stage_;
  Clock::time_point start_;
};

} // namespace oversketch
