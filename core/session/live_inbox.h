#pragma once

#include "core/session/live_session.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <variant>

namespace oversketch {

/// What a LiveSession may be asked for, as data.
namespace live {

struct Execute {
  Command command;
};
struct Preview {
  Command command;
};
struct Commit {};
struct Abandon {};
struct Undo {
  std::size_t steps = 1;
};
struct Redo {
  std::size_t steps = 1;
};
struct Jump {
  std::size_t entry = 0;
};
struct Run {
  std::string label;
  LiveSession::Job job;
  std::function<void(const Result<void>&)> done;
};
struct LimitHistory {
  History::Limits limits;
};
/// What is shown besides the document.
struct View {
  LiveSession::Compare compare = LiveSession::Compare::kOff;
  bool alternatives = false;

  bool operator==(const View&) const = default;
};

using Request = std::variant<Execute, Preview, Commit, Abandon, Undo, Redo, Jump, Run, LimitHistory, View>;

/// The requests that wait, newest previews first in their own turn, and the tokens that stop the work in hand.
/// @threads post(), cancel() and close() from any; the rest from the worker.
class Inbox {
public:
  void post(Request request);
  /// Stops what is being served, and what is being refined.
  void cancel();
  /// No more requests: next() ends the work in hand and gives none.
  void close();

  /// Waits for a request.
  std::optional<Request> next();
  bool empty() const;
  /// Of the request that next() gave last: cancel() and close() stop it, abandoning stops a preview.
  std::stop_token serving() const;
  /// Stopped by the next request of any kind; already stopped when one waits.
  std::stop_token refining();

private:
  mutable std::mutex mutex_;
  std::condition_variable waiting_;
  std::deque<Request> requests_;
  bool closed_ = false;
  bool serving_preview_ = false;
  std::stop_source serving_;
  std::stop_source refining_;
};

} // namespace live

} // namespace oversketch
