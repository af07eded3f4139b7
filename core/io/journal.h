#pragma once

#include "core/base/file.h"
#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/io/limits.h"
#include "core/session/script.h"
#include "core/session/session.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// Where the system wants what programs remember between starts: $XDG_STATE_HOME/oversketch, or
/// ~/.local/state/oversketch where that is not set to an absolute path.
/// @errors journal.no-home.
Result<std::filesystem::path> default_state_folder();

/// The steps of one document in one process, written down as they are made, so that a crash loses at most the one in
/// hand.
///
/// STATE/journals/NAME/ holds journal.jsonl, a script like any other; the pictures that its commands name, each content
/// once and as the file that it was read from, under images/; base.ora, the project that the document was opened from,
/// if it was; and `lock`, held by the process as long as it lives.  Lines are only ever appended, each synced before
/// append() returns.
///
/// When a line cannot be written (a full disk) it waits, and the next append() or catch_up() tries again, in order: a
/// journal never has a gap.
/// @threads safe from several threads: meant to be called from another than the user interface's, in the order of the
///   steps.
class Journal {
public:
  /// @param name  what the person calls the document: a file's name, or "Untitled".
  /// @param base  the project the document was opened from, copied; empty for a new one.
  /// @errors journal.write, with the system's reason.
  static Result<Journal> begin(const std::filesystem::path& state_folder, const std::string& name,
                               const std::filesystem::path& base = {});
  /// Lets the lock go and leaves the files: as good as a crash.
  ~Journal();
  Journal(Journal&&) noexcept;
  Journal& operator=(Journal&&) noexcept;

  const std::filesystem::path& folder() const;

  /// @param step  a command with its pictures loaded, an undo or a redo (CHECK).
  /// @errors journal.write; those of PictureFolder.
  /// @cost a few milliseconds, what the disk takes to sync; for each new picture its content hash, and its file's bytes
  ///   (one that was read from no file is packed: 22 ns a pixel).
  Result<void> append(const Step& step);
  /// Writes what could not be written before.
  Result<void> catch_up();
  /// The steps so far are in a file of their own now.
  Result<void> mark_saved(const std::string& project);
  /// After a clean exit: everything is removed.
  void discard();

private:
  friend struct JournalRecovery;
  struct Data;
  explicit Journal(std::unique_ptr<Data> data);
  static Result<Journal> begin_in(const std::filesystem::path& folder, const std::string& name,
                                  const std::filesystem::path& base);
  std::unique_ptr<Data> data_;
};

/// A journal whose process is gone.
struct AbandonedJournal {
  std::filesystem::path folder;
  std::string name;
  std::chrono::system_clock::time_point last_change;
  /// The project's file as it was opened or saved last; none where it was neither.
  std::optional<FileStamp> stamp;
  /// Commands, undos and redos; and those since the last save.
  int steps = 0;
  int unsaved_steps = 0;
};

/// Youngest first; empty ones are left out.  Those of living processes are not among them.
std::vector<AbandonedJournal> list_abandoned_journals(const std::filesystem::path& state_folder);

struct RecoveredJournal {
  Session session;
  /// Goes on where it ended; discard() it when the person does not want it.
  Journal journal;
  int steps = 0;
  /// For the person, when not every line could be replayed: which, and why; or when a picture is not the one that it
  /// was.  The last line alone, cut short, is not worth a word.
  std::string message;
};

/// Replays an abandoned journal.  Nothing outside its folder is read, whatever it says.
///
/// Stops at the first line that fails; what was before it is recovered, the rest is added to
/// journal.jsonl~ beside it.
/// @errors journal.in-use (its process lives), journal.unreadable, project.* (of base.ora), cancelled.
Result<RecoveredJournal> recover_journal(const std::filesystem::path& folder, const IoLimits& limits = {},
                                         const Watch& watch = {});

/// Removes one that nobody wants; nothing where its process lives.
void discard_abandoned_journal(const std::filesystem::path& folder);

/// Removes journals of dead processes that were last changed more than `age` before `now`; returns how many.
int remove_old_journals(const std::filesystem::path& state_folder, std::chrono::system_clock::time_point now,
                        std::chrono::hours age = std::chrono::hours(7 * 24));

} // namespace oversketch
