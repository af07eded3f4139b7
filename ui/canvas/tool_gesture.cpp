#include "ui/canvas/tool_gesture.h"

namespace oversketch {

Result<void> ToolGesture::preview(const Command& command, const Snapshot& snapshot, ActionSink& sink) {
  if (last_ == command) return {};
  const auto after = oversketch::apply(base(snapshot), command);
  if (!after) return after.error();
  if (!base_) base_ = snapshot.document;
  last_ = command;
  sink.emit(action::Preview{command});
  return {};
}

void ToolGesture::commit(ActionSink& sink) {
  if (begun()) sink.emit(action::Commit{});
  base_.reset();
  last_.reset();
}

void ToolGesture::abandon(ActionSink& sink) {
  if (begun()) sink.emit(action::Abandon{});
  base_.reset();
  last_.reset();
}

} // namespace oversketch
