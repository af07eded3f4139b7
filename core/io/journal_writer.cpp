#include "core/io/journal_writer.h"

#include <exception>

namespace oversketch {

JournalWriter::JournalWriter(Journal journal, std::function<void(const Error&)> on_problem)
    : journal_(std::move(journal)),
      on_problem_(std::move(on_problem)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

JournalWriter::~JournalWriter() = default;

void JournalWriter::append(Step step) {
  post(std::move(step));
}

void JournalWriter::mark_saved(std::string project) {
  post(std::move(project));
}

void JournalWriter::post(Line line) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(std::move(line));
  changed_.notify_all();
}

void JournalWriter::flush() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.empty() && !writing_; });
}

std::optional<Error> JournalWriter::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void JournalWriter::discard() {
  thread_.request_stop();
  thread_.join();
  journal_.discard();
}

void JournalWriter::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    // Asked to stop, it still writes what waits.
    changed_.wait(lock, stop, [&] { return !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Line line = std::move(waiting_.front());
    waiting_.pop_front();
    writing_ = true;
    lock.unlock();
    Result<void> done;
    try {
      done = std::holds_alternative<Step>(line) ? journal_.append(std::get<Step>(line))
                                                : journal_.mark_saved(std::get<std::string>(line));
    } catch (const std::exception& problem) {
      done = Error{"memory", problem.what(), ""};
    }
    lock.lock();
    if (!done && !problem_ && on_problem_) {
      lock.unlock();
      on_problem_(done.error());
      lock.lock();
    }
    problem_ = done.ok() ? std::nullopt : std::optional(done.error());
    writing_ = false;
    changed_.notify_all();
  }
}

} // namespace oversketch
