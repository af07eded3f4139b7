#pragma once

#include "core/session/snapshot.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace oversketch {

/// A Session on a thread of its own: requests go in, snapshots and changed pixels come out, and nobody waits.
///
/// Requests are served in the order in which they came.  Of previews only the newest counts: one that waits is
/// replaced, one that is being solved is stopped when the next is there.  After each request the picture is shown at
/// the quality that is at hand; it is brought to full quality as soon as nothing else is asked for.
///
/// @threads all calls may be made from any thread and return at once, wait_until_idle() and the destructor apart.
class LiveSession {
public:
  /// @param on_change  called from the worker when there is something new to show; must be quick and call nothing here.
  /// @param on_served  called from the worker after each request that can have changed the document or its log.
  explicit LiveSession(std::function<void()> on_change = {}, std::function<void(const Session&)> on_served = {});
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  /// One step of history.  Pictures that are not loaded yet are read from the paths their names say.
  void execute(Command command);
  /// What the gesture in hand would do; the first preview begins a gesture.  Solved and shown, not in the history.
  void preview(Command command);
  /// The last preview becomes one step of history.  Nothing happens without one; when it was refused, the document is
  /// again as it was before the gesture.
  void commit();
  /// The document is again as it was before the gesture.
  void abandon();
  void undo(int steps = 1);
  void redo(int steps = 1);
  /// To that entry of the history.
  void jump(std::size_t entry);

  /// Any work on the session: opening, saving, exporting, replaying.  Its error becomes the snapshot's problem; `done`
  /// (may be empty) is called on the worker with what came out.
  using Job = std::function<Result<void>(Session&, const Watch&)>;
  void run(std::string label, Job job, std::function<void(const Result<void>&)> done = {});

  /// See Session.
  void limit_history(const History::Limits& limits);

  /// Stops the work in hand; the document stays as it was before it.
  void cancel();

  /// How the comparison takes the selected layer.
  enum class Compare { kOff, kHidden, kPaste, kInitial, kPaper, kFlipfree };
  void show_compare(Compare compare);
  /// Whether the matcher's other answers are wanted for the selected layer.
  void want_alternatives(bool wanted);

  std::shared_ptr<const Snapshot> snapshot() const;
  /// Moves out what has changed in the picture since the last call.
  PictureUpdate take_picture_update();

  struct Activity {
    bool busy = false;
    /// 0…1, negative when not known.
    double done = -1;
    std::string label;
  };
  Activity activity() const;
  void wait_until_idle();

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace oversketch
