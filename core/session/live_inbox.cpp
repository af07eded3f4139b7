#include "core/session/live_inbox.h"

#include <utility>

namespace oversketch::live {

namespace {

template <class Kind>
bool is(const Request& request) {
  return std::holds_alternative<Kind>(request);
}

} // namespace

void Inbox::post(Request request) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  refining_.request_stop();
  // What a newer one replaces is never seen: a preview by a preview or by giving up the gesture, a view by a view.
  const bool replaces = !requests_.empty() && ((is<Preview>(requests_.back()) && is<Preview>(request)) ||
                                               (is<View>(requests_.back()) && is<View>(request)));
  if (is<Abandon>(request)) {
    while (!requests_.empty() && is<Preview>(requests_.back()))
      requests_.pop_back();
    if (requests_.empty() && serving_preview_) serving_.request_stop();
  }
  if (replaces)
    requests_.back() = std::move(request);
  else
    requests_.push_back(std::move(request));
  waiting_.notify_one();
}

void Inbox::cancel() {
  const std::lock_guard lock(mutex_);
  serving_.request_stop();
  refining_.request_stop();
}

void Inbox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  requests_.clear();
  serving_.request_stop();
  refining_.request_stop();
  waiting_.notify_one();
}

std::optional<Request> Inbox::next() {
  std::unique_lock lock(mutex_);
  waiting_.wait(lock, [&] { return closed_ || !requests_.empty(); });
  if (closed_) return std::nullopt;
  Request request = std::move(requests_.front());
  requests_.pop_front();
  serving_ = std::stop_source();
  serving_preview_ = is<Preview>(request);
  return request;
}

bool Inbox::empty() const {
  const std::lock_guard lock(mutex_);
  return requests_.empty();
}

std::stop_token Inbox::serving() const {
  const std::lock_guard lock(mutex_);
  return serving_.get_token();
}

std::stop_token Inbox::refining() {
  const std::lock_guard lock(mutex_);
  refining_ = std::stop_source();
  if (closed_ || !requests_.empty()) refining_.request_stop();
  return refining_.get_token();
}

} // namespace oversketch::live
