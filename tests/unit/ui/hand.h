#pragma once

// A hand for tests: a document, views, and events made in picture pixels, handed to a tool as the canvases would.

#include "tests/support/documents.h"
#include "ui/canvas/tool.h"

#include <gtest/gtest.h>

#include <vector>

namespace oversketch::testing {

/// A blue square of a source, 200 × 160, a target of 300 × 200, and one layer, with or without its outline: a circle of
/// radius 40 round (80, 80).
inline Document one_layer(bool outlined = true) {
  Document document = applied({}, new_document(300, 200));
  document = applied(document, LayerAdd{loaded_ref("source.png", plain_image(200, 160)), std::nullopt});
  if (outlined) document = applied(document, RegionSet{{}, blob({80, 80}, 40, 0, 64)});
  return document;
}

class Hand {
public:
  Hand(CanvasTool& tool, Document document, Side side) : tool_(tool), side_(side) {
    snapshot.document = std::move(document);
  }

  Snapshot snapshot;
  Preferences preferences;
  View source_view;
  View target_view;
  std::optional<PinId> selected_pin;
  bool one_canvas = false;
  Modifiers modifiers;

  ToolContext context() const { return {snapshot, preferences, source_view, target_view, one_canvas, selected_pin, 1}; }
  void on(Side side) { side_ = side; }

  /// Each call is a frame of its own.
  void send(InputEvent event) {
    event.modifiers = modifiers;
    event.time_s = time_s_ += 0.01;
    const std::vector<ToolEvent> events{{event, side_}};
    tool_.update(events, context(), sink_);
  }
  void wait(double seconds) { time_s_ += seconds; }
  void move(Point at) { send({.kind = InputEvent::Kind::kMove, .position = at}); }
  void press(Point at, MouseButton button = MouseButton::kLeft) {
    send({.kind = InputEvent::Kind::kPress, .position = at, .button = button});
  }
  void release(Point at, MouseButton button = MouseButton::kLeft) {
    send({.kind = InputEvent::Kind::kRelease, .position = at, .button = button});
  }
  void click(Point at) {
    press(at);
    release(at);
    wait(1);
  }
  void drag(const Points& way) {
    press(way.front());
    for (const Point p : way)
      move(p);
    release(way.back());
  }
  void key(Key key) {
    send({.kind = InputEvent::Kind::kKeyDown, .key = key});
    send({.kind = InputEvent::Kind::kKeyUp, .key = key});
  }
  void lose_focus() { send({.kind = InputEvent::Kind::kFocusLost}); }

  /// What was asked for since the last call.
  std::vector<Action> take() { return sink_.take(); }

private:
  CanvasTool& tool_;
  Side side_;
  ActionSink sink_;
  double time_s_ = 0;
};

/// All actions of a kind, in order.
template <class A>
std::vector<A> all_of(const std::vector<Action>& actions) {
  std::vector<A> found;
  for (const Action& action : actions)
    if (const A* it = std::get_if<A>(&action)) found.push_back(*it);
  return found;
}

/// The one command that was executed; fails the test when there were none or several.
template <class C>
C executed(const std::vector<Action>& actions) {
  const auto found = all_of<action::Execute>(actions);
  EXPECT_EQ(found.size(), 1U);
  if (found.size() != 1 || !std::holds_alternative<C>(found.front().command)) {
    ADD_FAILURE() << "no such command was executed";
    return {};
  }
  return std::get<C>(found.front().command);
}

/// The last preview, which was committed, with nothing executed besides.
template <class C>
C committed(const std::vector<Action>& actions) {
  const auto previews = all_of<action::Preview>(actions);
  EXPECT_EQ(all_of<action::Commit>(actions).size(), 1U);
  EXPECT_TRUE(all_of<action::Execute>(actions).empty());
  if (previews.empty() || !std::holds_alternative<C>(previews.back().command)) {
    ADD_FAILURE() << "no such command was previewed";
    return {};
  }
  return std::get<C>(previews.back().command);
}

/// That nothing of the document would change, whatever was previewed meanwhile.
inline void expect_no_change(const std::vector<Action>& actions) {
  EXPECT_TRUE(all_of<action::Execute>(actions).empty());
  EXPECT_TRUE(all_of<action::Commit>(actions).empty());
  if (!all_of<action::Preview>(actions).empty()) {
    EXPECT_EQ(all_of<action::Abandon>(actions).size(), 1U);
  }
}

/// An arc round a centre, angles in degrees, clockwise on the screen.
inline Points arc(Point center, double radius, double from_deg, double to_deg, int steps = 60) {
  Points points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = (from_deg + (to_deg - from_deg) * i / steps) * std::numbers::pi / 180;
    points.push_back(center + radius * Point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

} // namespace oversketch::testing
