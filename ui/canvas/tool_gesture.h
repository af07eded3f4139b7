#pragma once

#include "core/session/snapshot.h"
#include "ui/state/action.h"

#include <optional>

namespace oversketch {

/// A tool's side of a gesture: begins at the first preview that is accepted, ends with one step of history or none.
class ToolGesture {
public:
  /// The document that the gesture changes: the one before its first preview.
  const Document& base(const Snapshot& snapshot) const { return base_ ? *base_ : snapshot.document; }

  /// Asks for the preview, unless it is the last one again.  What apply() refuses is not asked for: the last accepted
  /// preview stays.
  /// @errors those of apply().
  Result<void> preview(const Command& command, const Snapshot& snapshot, ActionSink& sink);

  bool begun() const { return last_.has_value(); }
  /// The last preview becomes a step; nothing happens without one.
  void commit(ActionSink& sink);
  void abandon(ActionSink& sink);

private:
  std::optional<Document> base_;
  std::optional<Command> last_;
};

} // namespace oversketch
