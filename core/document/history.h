#pragma once

#include "core/base/result.h"
#include "core/document/command.h"
#include "core/document/document.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// The documents a person has been through, and which of them is shown.  No inverse is ever made: undo and redo move
/// the cursor.
///
/// The first entry is the document as it was opened; `document.new` begins a new history, so undo never crosses it.
/// @threads one thread at a time.
class History {
public:
  struct Entry {
    /// Increases from entry to entry and is never used again.
    std::uint64_t id = 0;
    Document document;
    /// What led here from the entry before.
    Command command;
    std::string label;
    /// Of its document without images, and of the images that the entry before does not have.
    std::size_t new_bytes = 0;
  };

  struct Limits {
    /// Never fewer undo steps than this…
    std::size_t least_steps = 50;
    /// …and beyond them only while the documents, and images that the present one does not share, take no more than
    /// this.
    std::size_t bytes = std::size_t{2} << 30;
    /// Never more steps than this.
    std::size_t most_steps = 10'000;
  };

  History() = default;
  explicit History(Limits limits) : limits_(limits) {}

  const Limits& limits() const { return limits_; }
  /// From the next step on.
  void set_limits(const Limits& limits) { limits_ = limits; }

  /// The document at the cursor; an empty one before the first command.
  const Document& present() const;
  const std::vector<Entry>& entries() const { return entries_; }
  /// Index of the present entry; 0 when there is none.
  std::size_t cursor() const { return cursor_; }

  /// Applies the command and puts the result behind the cursor, dropping what was undone.
  /// @errors those of apply(); nothing is changed then.
  Result<void> execute(const Command& command);
  /// Pushes a document that apply() made of the present one.
  void push(Document after, const Command& command, std::string label);

  bool can_undo() const { return cursor_ > 0; }
  bool can_redo() const { return cursor_ + 1 < entries_.size(); }
  /// @errors history.nothing-to-undo, history.nothing-to-redo: when fewer steps are there; the cursor stays.
  Result<void> undo(std::size_t steps = 1);
  Result<void> redo(std::size_t steps = 1);
  /// @errors history.index.
  Result<void> jump(std::size_t index);

  /// Takes over entries that were saved, their ids and bytes counted anew; the present one is what the file holds.
  /// @param cursor  of an entry, 0 when there are none (CHECK).
  void restore(std::vector<Entry> entries, std::size_t cursor);

  /// The present entry is what the file holds.
  void mark_saved();
  /// Whether the present document is another one than the file's, or than the one just begun.
  bool modified() const;

private:
  void trim();
  std::size_t count_kept() const;

  Limits limits_;
  std::uint64_t next_id_ = 1;
  std::vector<Entry> entries_;
  std::size_t cursor_ = 0;
  /// Sum of the entries' new_bytes: never less than what the budget counts.
  std::size_t bytes_ = 0;
  /// Index of the saved entry, 0 in a new document; none when it was dropped.
  std::optional<std::size_t> saved_;
};

/// One drag: previews replace each other, commit makes one history step, anything else leaves no trace.
///
///     Gesture gesture(history, "Move");
///     gesture.preview(LayerMove{…});      // as often as the pointer moves
///     gesture.commit();
///
/// Each preview is applied to the document that stood when the gesture began.  Leaving the scope cancels.
class Gesture {
public:
  explicit Gesture(History& history) : history_(&history), base_(history.present()) {}

  /// What is shown while the gesture goes on.
  const Document& pending() const { return pending_ ? *pending_ : base_; }
  /// @errors those of apply(); the pending document stays as the last preview left it.
  Result<void> preview(const Command& command);
  /// One history step from the last preview; none when there was no preview.
  void commit();
  void cancel();

private:
  History* history_;
  Document base_;
  std::optional<Document> pending_;
  std::optional<Command> command_;
};

} // namespace oversketch
