#pragma once

#include "core/io/journal.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

namespace oversketch {

/// A Journal on a thread of its own: append() returns at once, the disk is waited for elsewhere.
/// @threads calls may be made from any thread, in the order of the steps.
class JournalWriter {
public:
  /// @param on_news  called from that thread with problem() when one has come or gone; must be quick.
  /// @param pause    after which what could not be written is tried again.
  explicit JournalWriter(Journal journal, std::function<void(const std::optional<Error>&)> on_news = {},
                         std::chrono::milliseconds pause = std::chrono::seconds(3));
  /// Writes what waits first.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// See Journal.
  void append(Step step);
  void mark_saved(std::string project);
  /// Waits until everything that was appended is synced, or could not be.
  void flush();
  /// Why not all is written; none while all is well.  It is tried again with the next line, and after a pause.
  std::optional<Error> problem() const;
  /// After a clean exit: nothing waits any more, everything is removed.
  void discard();

private:
  using Line = std::variant<Step, std::string>;

  void post(Line line);
  void work(const std::stop_token& stop);
  Result<void> write(const std::optional<Line>& line);

  Journal journal_;
  std::function<void(const std::optional<Error>&)> on_news_;
  std::chrono::milliseconds pause_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Line> waiting_;
  bool writing_ = false;
  std::optional<Error> problem_;
  /// Last: it uses all of the above.
  std::jthread thread_;
};

} // namespace oversketch
