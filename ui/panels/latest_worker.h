#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace oversketch {

/// A thread that answers the newest question only: one that waits is replaced by the next, and an answer that is not
/// fetched by the next answer.
/// @threads ask() and take() from any thread; they return at once.
template <class Question, class Answer>
class LatestWorker {
public:
  /// @param answer  called on the worker.
  /// @param wake    called on the worker when there is an answer; may be empty.
  LatestWorker(std::function<Answer(const Question&)> answer, std::function<void()> wake)
      : answer_(std::move(answer)),
        wake_(std::move(wake)),
        thread_([this](const std::stop_token& stop) { work(stop); }) {}

  void ask(Question question) {
    {
      const std::lock_guard lock(mutex_);
      question_ = std::move(question);
      ready_.reset();
    }
    changed_.notify_one();
  }
  std::optional<Answer> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(ready_, std::nullopt);
  }

private:
  void work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return question_.has_value(); })) {
      const Question question = *std::exchange(question_, std::nullopt);
      lock.unlock();
      Answer answer = answer_(question);
      lock.lock();
      // Asked anew meanwhile: nobody waits for this one any more.
      if (question_) continue;
      ready_ = std::move(answer);
      lock.unlock();
      if (wake_) wake_();
      lock.lock();
    }
  }

  std::function<Answer(const Question&)> answer_;
  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Question> question_;
  std::optional<Answer> ready_;
  std::jthread thread_;
};

} // namespace oversketch
