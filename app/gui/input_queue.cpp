#include "app/gui/input_queue.h"

#include <algorithm>

namespace oversketch::gui {
namespace {

/// Keys whose letter arrives as text: the text tells all, so that key down and up may share a frame.
bool writes(const RawEvent& event) {
  return event.event.key < Key::kEscape && event.event.key != Key::kNone && !event.event.modifiers.ctrl &&
         !event.event.modifiers.alt;
}

bool is_modifier(const RawEvent& event) {
  return event.event.key == Key::kShift || event.event.key == Key::kCtrl || event.event.key == Key::kAlt;
}

/// What a batch holds so far.
struct Contents {
  bool button = false;
  bool wheel = false;
  bool text_or_letter = false;
  bool text = false;
  bool key_of_chord = false;
  std::vector<int> keys;

  bool hides(const RawEvent& next) const {
    using Kind = RawEvent::Kind;
    switch (next.kind) {
    case Kind::kMove:
      return button;
    case Kind::kButton:
      return button || wheel || text_or_letter || !keys.empty();
    case Kind::kWheel:
      return button || !keys.empty();
    case Kind::kText:
      return button || !keys.empty();
    case Kind::kKey:
      if (button || wheel) return true;
      // Dear ImGui knows of one state of Ctrl in a frame: a key pressed before it was let go is no chord there, and
      // text typed before it was pressed is dropped.
      if (is_modifier(next) && key_of_chord) return true;
      if (text && (next.event.key == Key::kCtrl || next.event.modifiers.ctrl)) return true;
      return writes(next) ? !keys.empty() : std::ranges::find(keys, next.code) != keys.end();
    case Kind::kEnter:
      return button;
    case Kind::kFocus:
      return button || text_or_letter || !keys.empty();
    }
    return false;
  }

  void add(const RawEvent& event) {
    using Kind = RawEvent::Kind;
    if (event.kind == Kind::kButton || event.kind == Kind::kFocus) button = true;
    if (event.kind == Kind::kWheel) wheel = true;
    if (event.kind == Kind::kText) text = text_or_letter = true;
    if (event.kind != Kind::kKey) return;
    if (writes(event))
      text_or_letter = true;
    else
      keys.push_back(event.code);
    key_of_chord |= event.is_down() && !writes(event) && !is_modifier(event);
  }
};

} // namespace

std::vector<RawEvent> InputQueue::take_batch() {
  std::vector<RawEvent> batch;
  Contents contents;
  while (!events_.empty() && !contents.hides(events_.front())) {
    contents.add(events_.front());
    batch.push_back(events_.front());
    events_.pop_front();
  }
  return batch;
}

InputEvents to_events(const std::vector<RawEvent>& batch) {
  InputEvents events;
  for (const RawEvent& raw : batch) {
    const bool unseen = raw.kind == RawEvent::Kind::kText || raw.kind == RawEvent::Kind::kEnter ||
                        (raw.kind == RawEvent::Kind::kFocus && raw.is_down());
    if (!unseen) events.push_back(raw.event);
  }
  return events;
}

} // namespace oversketch::gui
