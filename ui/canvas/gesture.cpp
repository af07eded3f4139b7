#include "ui/canvas/gesture.h"

namespace oversketch {

Result<void> Gesture::preview(const Command& command, const Snapshot& snapshot, ActionSink& sink) {
  if (last_ == command) return {};
  const auto after = apply(base(snapshot), command);
  if (!after) return after.error();
  if (!base_) base_ = snapshot.document;
  last_ = command;
  sink.emit(action::Preview{command});
  return {};
}

void Gesture::commit(ActionSink& sink) {
  if (begun()) sink.emit(action::Commit{});
  base_.reset();
  last_.reset();
}

void Gesture::abandon(ActionSink& sink) {
  if (begun()) sink.emit(action::Abandon{});
  base_.reset();
  last_.reset();
}

} // namespace oversketch
