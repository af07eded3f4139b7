#include "core/io/session_journal.h"

#include <algorithm>
#include <span>
#include <utility>

namespace oversketch {
namespace {

/// Whether the log can be replayed from nothing.
bool reaches_beginning(const std::vector<Step>& log) {
  return !log.empty() && std::holds_alternative<Command>(log.front()) &&
         std::holds_alternative<DocumentNew>(std::get<Command>(log.front()));
}

} // namespace

SessionJournal::SessionJournal(std::filesystem::path state_folder, std::string name, std::function<void()> on_news)
    : state_folder_(std::move(state_folder)), on_news_(std::move(on_news)), name_(std::move(name)) {}

SessionJournal::~SessionJournal() = default;

void SessionJournal::begin(const Session& session, const std::string& name, const std::filesystem::path& base) {
  const std::lock_guard lock(mutex_);
  if (ended_ || state_folder_.empty()) return;
  forget(session);
  name_ = name;
  base_ = base;
  if (base.empty()) return;
  steps_ = session.log().size();
  start(session);
}

void SessionJournal::resume(const Session& session, Journal journal) {
  const std::lock_guard lock(mutex_);
  if (ended_ || state_folder_.empty()) return;
  forget(session);
  steps_ = session.log().size();
  adopt(std::move(journal));
}

void SessionJournal::follow(const Session& session) {
  const std::lock_guard lock(mutex_);
  if (ended_ || state_folder_.empty()) return;
  // Another document in its place, begun or opened by a script.
  if (session.log_number() != log_number_) forget(session);
  const std::vector<Step>& log = session.log();
  if (writer_ == nullptr) {
    // Nothing is lost with a document that is as it was opened.
    if (!session.history().modified()) return;
    if (base_.empty() && !reaches_beginning(log))
      return publish(
          Error{"journal.no-beginning", "the history of this document does not reach back to its beginning", name_});
    // Each step tries again where it could not be begun.
    start(session);
    if (writer_ == nullptr) return;
  }
  for (const Step& step : std::span(log).subspan(std::min(steps_, log.size())))
    writer_->append(step);
  steps_ = log.size();
}

void SessionJournal::mark_saved(const Session& session, const std::filesystem::path& project) {
  follow(session);
  const std::lock_guard lock(mutex_);
  if (ended_ || state_folder_.empty()) return;
  name_ = project.string();
  if (writer_ != nullptr) return writer_->mark_saved(name_);
  base_ = project;
  steps_ = session.log().size();
  start(session);
}

void SessionJournal::discard() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  if (writer_ != nullptr) writer_->discard();
  writer_.reset();
}

void SessionJournal::flush() {
  const std::lock_guard lock(mutex_);
  if (writer_ != nullptr) writer_->flush();
}

std::optional<Error> SessionJournal::problem() const {
  const std::lock_guard lock(problem_mutex_);
  return problem_;
}

void SessionJournal::start(const Session& session) {
  auto journal = Journal::begin(state_folder_, name_, base_);
  // The project may be gone by now: then everything is written down from the beginning.
  if (!journal && !base_.empty() && reaches_beginning(session.log())) {
    base_.clear();
    steps_ = 0;
    journal = Journal::begin(state_folder_, name_);
  }
  if (!journal) return publish(journal.error());
  publish(std::nullopt);
  adopt(std::move(*journal));
}

void SessionJournal::adopt(Journal journal) {
  writer_ = std::make_unique<JournalWriter>(std::move(journal),
                                            [this](const std::optional<Error>& problem) { publish(problem); });
}

void SessionJournal::publish(std::optional<Error> problem) {
  {
    const std::lock_guard lock(problem_mutex_);
    if (problem == problem_) return;
    problem_ = std::move(problem);
  }
  if (on_news_) on_news_();
}

/// What was followed so far is nobody's any more.
void SessionJournal::forget(const Session& session) {
  if (writer_ != nullptr) writer_->discard();
  writer_.reset();
  base_.clear();
  log_number_ = session.log_number();
  steps_ = 0;
  publish(std::nullopt);
}

} // namespace oversketch
