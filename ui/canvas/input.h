#pragma once

#include "core/geometry/point.h"

#include <vector>

namespace oversketch {

/// Keys that mean something here; letters and digits by their character in upper case.
enum class Key : int {
  kNone = 0,
  kEscape = 256,
  kEnter,
  kTab,
  kBackspace,
  kDelete,
  kLeft,
  kRight,
  kUp,
  kDown,
  kHome,
  kEnd,
  kPageUp,
  kPageDown,
  kSpace,
  kShift,
  kCtrl,
  kAlt,
  kF1,
  kF2,
  kF3,
  kF4,
  kF5,
  kF6,
  kF7,
  kF8,
  kF9,
  kF10,
  kF11,
  kF12,
};

constexpr Key key_of(char upper_case) {
  return static_cast<Key>(upper_case);
}

enum class MouseButton { kLeft, kRight, kMiddle };

struct Modifiers {
  bool shift = false;
  bool ctrl = false;
  bool alt = false;
  bool operator==(const Modifiers&) const = default;
};

/// One thing that a hand did, in the order in which it happened: queued when the system tells of it, drained once a
/// frame, so that no point of a fast stroke is lost at any frame rate.
struct InputEvent {
  enum class Kind { kMove, kPress, kRelease, kWheel, kKeyDown, kKeyRepeat, kKeyUp, kFocusLost };
  Kind kind = Kind::kMove;
  /// Window pixels, of the last cursor event before it.
  Point position = {};
  double time_s = 0;
  MouseButton button = MouseButton::kLeft;
  Key key = Key::kNone;
  Modifiers modifiers = {};
  /// Of the wheel.
  Point scroll = {};
};

using InputEvents = std::vector<InputEvent>;

} // namespace oversketch
