#pragma once

#include "ui/canvas/input.h"

#include <deque>
#include <vector>

namespace oversketch::gui {

/// One thing that the window system told, with what Dear ImGui's backend wants of it.
struct RawEvent {
  enum class Kind { kMove, kButton, kWheel, kKey, kText, kEnter, kFocus };
  Kind kind = Kind::kMove;
  /// The editor's own view of it; of text and of the pointer's coming there is none.
  InputEvent event;
  /// As GLFW names them.  `action` also tells whether the pointer has entered and the window is focused.
  int code = 0;
  int scancode = 0;
  int action = 0;
  int mods = 0;

  bool is_down() const { return action != 0; }
};

/// What hands did, in order, given out in batches of which each makes sense within one frame.
///
/// Frames ask where the pointer *is* and which buttons *are* down; a click that is shorter than a frame, or a press
/// that is followed by a move before the frame comes, would be lost or land elsewhere.  So a batch ends before an event
/// that would hide what came before it in the same batch; the rest is for the next frame, which follows at once.  A
/// stroke of any speed is one batch from its press on: moves do not hide each other.
class InputQueue {
public:
  void push(const RawEvent& event) { events_.push_back(event); }
  bool empty() const { return events_.empty(); }

  /// The next batch; empty when nothing has happened.
  std::vector<RawEvent> take_batch();

private:
  std::deque<RawEvent> events_;
};

/// What the editor sees of a batch.
InputEvents to_events(const std::vector<RawEvent>& batch);

} // namespace oversketch::gui
