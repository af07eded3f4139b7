#pragma once

#include "core/geometry/point.h"

#include <memory>
#include <string>
#include <vector>

namespace oversketch::testing {

/// A hand at mouse and keyboard: the X server takes what it does for the real thing (XTEST).
class Hand {
public:
  explicit Hand(const std::string& display);
  ~Hand();
  Hand(const Hand&) = delete;
  Hand& operator=(const Hand&) = delete;

  /// Looks for the window of the editor and takes its pixels for what the calls below mean.
  bool find_window();

  void move(Point to);
  void press(int button = 1);
  void release(int button = 1);
  /// Up is positive.
  void wheel(int steps);
  void click(Point at, int button = 1);
  /// Pressed at the first point, released at the last; every point is its own event, as fast as they go.
  void draw(const Points& points);
  /// "ctrl+shift+z", "Escape", "l": X's names of keys.
  void key(const std::string& chord);
  void hold(const std::string& key);
  void let_go(const std::string& key);
  void type(const std::string& text);
  Point place() const;
  /// As the window manager asks a window to close.
  void ask_to_close();
  /// Asks for a size of the window, and gets it.
  void resize(int width, int height);

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace oversketch::testing
