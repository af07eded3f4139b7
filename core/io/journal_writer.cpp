#include "core/io/journal_writer.h"

#include <exception>

namespace oversketch {

JournalWriter::JournalWriter(Journal journal, std::function<void(const std::optional<Error>&)> on_news,
                             std::chrono::milliseconds pause)
    : journal_(std::move(journal)),
      on_news_(std::move(on_news)),
      pause_(pause),
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
  const auto is_asked = [this] { return !waiting_.empty(); };
  std::unique_lock lock(mutex_);
  for (;;) {
    if (problem_)
      changed_.wait_for(lock, stop, pause_, is_asked);
    else
      changed_.wait(lock, stop, is_asked);
    // Asked to stop, it still writes what waits.
    std::optional<Line> line;
    if (is_asked()) {
      line = std::move(waiting_.front());
      waiting_.pop_front();
    } else if (stop.stop_requested()) {
      return;
    }
    writing_ = true;
    lock.unlock();
    const Result<void> done = write(line);
    lock.lock();
    const bool is_news = done.ok() == problem_.has_value();
    problem_ = done.ok() ? std::nullopt : std::optional(done.error());
    if (is_news && on_news_) {
      const std::optional<Error> news = problem_;
      lock.unlock();
      on_news_(news);
      lock.lock();
    }
    writing_ = false;
    changed_.notify_all();
  }
}

/// None: what could not be written before.
Result<void> JournalWriter::write(const std::optional<Line>& line) {
  try {
    if (!line) return journal_.catch_up();
    if (const auto* step = std::get_if<Step>(&*line)) return journal_.append(*step);
    return journal_.mark_saved(std::get<std::string>(*line));
  } catch (const std::exception& problem) {
    return Error{"memory", problem.what(), ""};
  }
}

} // namespace oversketch
