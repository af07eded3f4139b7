#pragma once

#include "core/io/journal.h"
#include "core/io/journal_writer.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

namespace oversketch {

/// Keeps the journal of one Session: begins it with the first change that is nowhere on the disk yet, and writes down
/// every step from then on.
///
/// A journal that cannot be begun or written is a problem to be told, and stops nothing.
/// @threads begin(), resume(), follow() and mark_saved() from the thread that has the session; the rest from any.
class SessionJournal {
public:
  /// @param state_folder  see default_state_folder(); empty: nothing is ever written.
  /// @param name          see Journal::begin(); begin() may give another.
  /// @param on_news       called from any thread when problem() has come or gone; must be quick.
  SessionJournal(std::filesystem::path state_folder, std::string name, std::function<void()> on_news = {});
  ~SessionJournal();
  SessionJournal(const SessionJournal&) = delete;
  SessionJournal& operator=(const SessionJournal&) = delete;

  /// The session holds a document of that name from now on.
  /// @param base  the project that it was opened from and that holds all of it, copied now, before anybody saves over
  ///   it; empty for a document whose log reaches back to its beginning.
  void begin(const Session& session, const std::string& name, const std::filesystem::path& base = {});
  /// The session is what that journal was replayed to.
  void resume(const Session& session, Journal journal);
  /// Writes down what was done since the last call.  @cost nothing is waited for, the beginning of a journal apart.
  void follow(const Session& session);
  /// All of it is in that file now, which is copied where there is no journal yet: what becomes of the file later is
  /// nobody's concern.
  void mark_saved(const Session& session, const std::filesystem::path& project);

  /// After a clean end: everything is removed, and nothing written any more.  Waits for a line that is being written.
  void discard();
  /// Waits until everything is synced, or could not be.
  void flush();
  /// Why not all that was done is kept; none while it is.
  std::optional<Error> problem() const;

private:
  void start(const Session& session);
  void adopt(Journal journal);
  void publish(std::optional<Error> problem);
  void forget(const Session& session);

  std::filesystem::path state_folder_;
  std::function<void()> on_news_;

  /// Guards what follows it.
  std::mutex mutex_;
  std::string name_;
  std::filesystem::path base_;
  /// Which log is followed, and how much of it is written down or lies in the base.
  std::uint64_t log_number_ = 0;
  std::size_t steps_ = 0;
  bool ended_ = false;
  std::unique_ptr<JournalWriter> writer_;

  mutable std::mutex problem_mutex_;
  std::optional<Error> problem_;
};

} // namespace oversketch
