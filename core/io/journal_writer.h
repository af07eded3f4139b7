#pragma once

#include "core/io/journal.h"

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
  /// @param on_problem  called from that thread when a line could not be written, once until one could; must be quick.
  explicit JournalWriter(Journal journal, std::function<void(const Error&)> on_problem = {});
  /// Writes what waits first.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// See Journal.
  void append(Step step);
  void mark_saved(std::string project);
  /// Waits until everything that was appended is synced, or could not be.
  void flush();
  /// Why the last line could not be written; none while all is well.  It is tried again with the next one.
  std::optional<Error> problem() const;
  /// After a clean exit: nothing waits any more, everything is removed.
  void discard();

private:
  using Line = std::variant<Step, std::string>;

  void post(Line line);
  void work(const std::stop_token& stop);

  Journal journal_;
  std::function<void(const Error&)> on_problem_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Line> waiting_;
  bool writing_ = false;
  std::optional<Error> problem_;
  /// Last: it uses all of the above.
  std::jthread thread_;
};

} // namespace oversketch
