#include "ui/canvas/canvas_input.h"

#include "tests/unit/ui/hand.h"

#include <limits>
#include <random>

namespace oversketch {
namespace {

using namespace testing;

/// Two canvases side by side, source 0…197, splitter 197…202, target from there to 500; both views at 100 %.  The
/// actions that concern the window's own state are carried out between frames, as the editor would.
class CanvasHand {
public:
  explicit CanvasHand(Document document) {
    snapshot.document = std::move(document);
    view.split = 0.4;
  }

  EditorState state;
  DocumentView view;
  Snapshot snapshot;
  CanvasInput input;
  bool two = true;
  bool mouse_free = true;
  bool keys_free = true;
  bool covered = false;
  Modifiers modifiers;

  CanvasFrame frame() const {
    return {state,      view,       snapshot,   lay_out_canvases({{0, 0}, {500, 300}}, view.split, two, 5),
            {200, 160}, {300, 200}, mouse_free, keys_free,
            covered,    1};
  }
  void send(InputEvents events) {
    for (InputEvent& event : events) {
      event.modifiers = modifiers;
      event.time_s = time_s_ += 0.01;
    }
    ActionSink sink;
    input.update(events, frame(), sink);
    for (const Action& action : sink.pending()) {
      if (const auto* it = std::get_if<action::PickTool>(&action)) state.tool = it->tool;
      if (const auto* it = std::get_if<action::SetView>(&action)) view.canvas(it->side).view = it->view;
      if (const auto* it = std::get_if<action::SetSplit>(&action)) view.split = it->split;
      if (const auto* it = std::get_if<action::SetPreferences>(&action)) state.preferences = it->preferences;
      if (const auto* it = std::get_if<action::SetCompare>(&action)) view.compare_split = it->split;
      seen_.push_back(action);
    }
  }
  static InputEvent move(Point at) { return {.kind = InputEvent::Kind::kMove, .position = at}; }
  static InputEvent press(Point at, MouseButton button = MouseButton::kLeft) {
    return {.kind = InputEvent::Kind::kPress, .position = at, .button = button};
  }
  static InputEvent release(Point at, MouseButton button = MouseButton::kLeft) {
    return {.kind = InputEvent::Kind::kRelease, .position = at, .button = button};
  }
  static InputEvent down(Key key) { return {.kind = InputEvent::Kind::kKeyDown, .key = key}; }
  static InputEvent up(Key key) { return {.kind = InputEvent::Kind::kKeyUp, .key = key}; }
  static InputEvent wheel(Point at, Point by) {
    return {.kind = InputEvent::Kind::kWheel, .position = at, .scroll = by};
  }
  void drag(Point from, Point to, MouseButton button = MouseButton::kLeft) {
    send({move(from), press(from, button), move(lerp(from, to, 0.5)), move(to), release(to, button)});
  }
  std::vector<Action> take() { return std::exchange(seen_, {}); }

private:
  std::vector<Action> seen_;
  double time_s_ = 0;
};

using H = CanvasHand;

TEST(CanvasInput, takes_no_harm_from_nonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  H hand({});
  hand.send({H::release({5, 5}),
             H::up(Key::kSpace),
             H::move({nan, nan}),
             H::wheel({5, 5}, {nan, 1e300}),
             H::press({-500, 1e9}),
             H::down(Key::kNone),
             {.kind = InputEvent::Kind::kFocusLost}});
  hand.send({H::wheel({300, 5}, {0, 1e300}), H::wheel({300, 5}, {0, -1e300})});
  hand.drag({300, 100}, {320, 120});
  for (const Action& action : hand.take())
    EXPECT_TRUE(std::holds_alternative<action::SetView>(action) || std::holds_alternative<action::Say>(action));
  EXPECT_FALSE(hand.input.held());
}

TEST(CanvasInput, random_events_leave_nothing_held_and_every_command_valid) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    H hand(one_layer());
    const Key keys[] = {key_of('L'), key_of('S'), key_of('P'),  key_of('V'),  key_of('H'), key_of('X'),
                        Key::kSpace, Key::kEnter, Key::kEscape, Key::kDelete, Key::kLeft,  key_of('0'),
                        key_of('+'), key_of('-'), key_of('\\'), key_of(']'),  Key::kAlt,   Key::kBackspace};
    const MouseButton buttons[] = {MouseButton::kLeft, MouseButton::kLeft, MouseButton::kRight, MouseButton::kMiddle};
    for (int step = 0; step < 3000; ++step) {
      InputEvent event;
      event.kind = static_cast<InputEvent::Kind>(below(8));
      if (event.kind == InputEvent::Kind::kFocusLost && below(10) > 0) event.kind = InputEvent::Kind::kMove;
      event.position = {static_cast<double>(below(560) - 30), static_cast<double>(below(360) - 30)};
      event.button = buttons[below(4)];
      event.key = keys[below(18)];
      event.scroll = {0, static_cast<double>(below(3) - 1)};
      hand.modifiers = {below(8) == 0, below(8) == 0, below(8) == 0};
      hand.send({event});
      for (const Action& action : hand.take()) {
        const auto* execute = std::get_if<action::Execute>(&action);
        if (execute == nullptr) continue;
        auto after = apply(std::as_const(hand.snapshot.document), std::as_const(execute->command));
        EXPECT_TRUE(after.ok()) << to_string(after.error());
        if (after.ok()) hand.snapshot.document = *after;
      }
    }
    hand.send({{.kind = InputEvent::Kind::kFocusLost}});
    EXPECT_FALSE(hand.input.held());
  }
}

TEST(CanvasInput, all_points_of_a_stroke_within_one_frame_arrive) {
  H hand(one_layer());
  hand.state.tool = Tool::kSketch;
  hand.state.preferences.smoothing = Smoothing::kNone;
  InputEvents events;
  const Points way = arc({282, 80}, 46, -60, 60, 199);
  events.push_back(H::press(way.front()));
  for (const Point p : way)
    events.push_back(H::move(p));
  events.push_back(H::release(way.back()));
  hand.send(events);
  const auto edit = executed<SketchEdit>(hand.take());
  EXPECT_LT(distance(edit.stroke.front(), way.front() - Point{202, 0}), 1e-9);
  EXPECT_LT(distance(edit.stroke.back(), way.back() - Point{202, 0}), 1e-9);
  EXPECT_GT(edit.stroke.size(), 8U);
}

TEST(CanvasInput, the_wheel_zooms_about_the_pointer_or_scrolls) {
  H hand(one_layer());
  const Point at{304, 80};
  const Point under = hand.view.target.view.to_picture(at - Point{202, 0});
  hand.send({H::wheel(at, {0, 1})});
  EXPECT_GT(hand.view.target.view.zoom, 1);
  EXPECT_LT(distance(hand.view.target.view.to_picture(at - Point{202, 0}), under), 1e-9);
  EXPECT_EQ(hand.view.source.view, View{}) << "the other canvas stays";

  hand.state.preferences.wheel_zooms = false;
  const View before = hand.view.target.view;
  hand.send({H::wheel(at, {0, 1})});
  EXPECT_EQ(hand.view.target.view.zoom, before.zoom);
  EXPECT_LT(hand.view.target.view.origin.y, before.origin.y);
  hand.modifiers.ctrl = true;
  hand.send({H::wheel(at, {0, -1})});
  EXPECT_LT(hand.view.target.view.zoom, before.zoom);
}

TEST(CanvasInput, space_middle_button_and_the_pan_tool_pan) {
  for (const int way : {0, 1, 2}) {
    H hand(one_layer());
    if (way == 0) hand.send({H::down(Key::kSpace)});
    if (way == 2) hand.state.tool = Tool::kPan;
    hand.drag({20, 20}, {50, 40}, way == 1 ? MouseButton::kMiddle : MouseButton::kLeft);
    EXPECT_EQ(hand.view.source.view.origin, (Point{-30, -20}));
    expect_no_change(hand.take());
  }
}

TEST(CanvasInput, keys_zoom) {
  H hand(one_layer());
  hand.send({H::move({300, 50}), H::down(key_of('+'))});
  EXPECT_EQ(hand.view.target.view.zoom, 1.25);
  hand.modifiers.ctrl = true;
  hand.send({H::down(key_of('1'))});
  EXPECT_EQ(hand.view.target.view.zoom, 1);
  hand.send({H::down(key_of('0'))});
  EXPECT_EQ(hand.view.target.view, fitted({300, 200}, hand.frame().layout.target.size()));
  EXPECT_EQ(hand.view.source.view, fitted({200, 160}, hand.frame().layout.source->size()));
  hand.keys_free = false;
  hand.send({H::down(key_of('+'))});
  EXPECT_EQ(hand.view.target.view, fitted({300, 200}, hand.frame().layout.target.size())) << "somebody is typing";
}

TEST(CanvasInput, a_tools_key_switches_for_good_or_for_a_drag) {
  H hand(one_layer());
  hand.state.tool = Tool::kSketch;
  hand.send({H::down(key_of('V')), H::up(key_of('V'))});
  EXPECT_EQ(hand.state.tool, Tool::kMove);

  hand.state.tool = Tool::kSketch;
  hand.take();
  hand.send({H::down(key_of('V'))});
  EXPECT_EQ(hand.state.tool, Tool::kMove);
  hand.drag({282, 80}, {294, 80});
  EXPECT_EQ(committed<LayerMove>(hand.take()).by, (WholeOffset{12, 0}));
  hand.send({H::up(key_of('V'))});
  EXPECT_EQ(hand.state.tool, Tool::kSketch);

  // The key comes up first: the drag is brought to its end.
  hand.send({H::down(key_of('V'))});
  hand.send({H::press({282, 80}), H::move({290, 80})});
  hand.send({H::up(key_of('V')), H::move({300, 80})});
  EXPECT_EQ(hand.state.tool, Tool::kMove);
  hand.send({H::release({300, 80})});
  EXPECT_EQ(hand.state.tool, Tool::kSketch);
  EXPECT_EQ(committed<LayerMove>(hand.take()).by, (WholeOffset{18, 0}));
}

TEST(CanvasInput, key_and_drag_within_one_frame) {
  H hand(one_layer());
  hand.state.tool = Tool::kSketch;
  hand.send({H::down(key_of('V')), H::press({282, 80}), H::move({299, 80}), H::release({299, 80}), H::up(key_of('V'))});
  const auto actions = hand.take();
  EXPECT_EQ(all_of<action::Commit>(actions).size() + all_of<action::Execute>(actions).size(), 1U);
  EXPECT_EQ(hand.state.tool, Tool::kSketch);
}

TEST(CanvasInput, a_drag_belongs_to_where_it_began) {
  H hand(one_layer());
  hand.state.tool = Tool::kMove;
  hand.send({H::press({282, 80}), H::move({400, 80}), H::move({20, 900}), H::release({20, 900})});
  EXPECT_EQ(committed<LayerMove>(hand.take()).by, (WholeOffset{-262, 820}));
  EXPECT_FALSE(hand.input.held());
}

TEST(CanvasInput, nothing_is_pressed_through_what_lies_over_the_canvas) {
  H hand(one_layer());
  hand.state.tool = Tool::kMove;
  hand.mouse_free = false;
  hand.drag({282, 80}, {300, 80});
  hand.send({H::wheel({282, 80}, {0, 1})});
  EXPECT_TRUE(hand.take().empty());
}

TEST(CanvasInput, a_dialog_ends_what_is_held) {
  H hand(one_layer());
  hand.state.tool = Tool::kMove;
  hand.send({H::press({282, 80}), H::move({300, 80})});
  hand.covered = true;
  hand.send({});
  EXPECT_FALSE(hand.input.held());
  hand.covered = false;
  hand.send({H::move({330, 80})});
  expect_no_change(hand.take());
}

TEST(CanvasInput, the_splitter_and_the_slider_are_dragged) {
  H hand(one_layer());
  hand.drag({200, 100}, {300, 100});
  EXPECT_NEAR(hand.view.split, 0.6, 1e-9);
  hand.view.split = 0.4;
  hand.view.compare = LiveSession::Compare::kPaper;
  hand.view.compare_split = 0.5;
  const Box target = hand.frame().layout.target;
  hand.drag({target.centre().x, 200}, {target.low.x + 0.75 * target.size().x, 220});
  EXPECT_NEAR(hand.view.compare_split, 0.75, 1e-9);
  hand.drag({target.low.x + 0.75 * target.size().x, 220}, {5000, 220});
  EXPECT_EQ(hand.view.compare_split, 1);
}

TEST(CanvasInput, the_backslash_is_held) {
  H hand(one_layer());
  hand.send({H::down(key_of('\\'))});
  hand.send({{.kind = InputEvent::Kind::kKeyRepeat, .key = key_of('\\')}});
  hand.send({H::up(key_of('\\'))});
  const auto held = all_of<action::HoldBefore>(hand.take());
  ASSERT_EQ(held.size(), 2U);
  EXPECT_TRUE(held[0].held);
  EXPECT_FALSE(held[1].held);
  hand.send({H::down(key_of('\\'))});
  hand.send({{.kind = InputEvent::Kind::kFocusLost}});
  EXPECT_EQ(all_of<action::HoldBefore>(hand.take()).size(), 2U) << "never stuck";
}

TEST(CanvasInput, brackets_change_the_tolerance) {
  H hand(one_layer());
  hand.send({H::down(key_of(']')), H::down(key_of(']'))});
  EXPECT_EQ(hand.state.preferences.tolerance_px, 16);
  for (int i = 0; i < 90; ++i)
    hand.send({H::down(key_of('['))});
  EXPECT_EQ(hand.state.preferences.tolerance_px, 1);
}

TEST(CanvasInput, alts_own_press_counts) {
  H hand(one_layer());
  hand.state.tool = Tool::kSketch;
  const Points way = arc({282, 80}, 46, -60, 60);
  hand.send({H::press(way.front())});
  for (const Point p : way)
    hand.send({H::move(p)});
  hand.take();
  hand.send({H::down(Key::kAlt)});
  const auto previews = all_of<action::Preview>(hand.take());
  ASSERT_EQ(previews.size(), 1U);
  EXPECT_TRUE(std::get<SketchEdit>(previews.front().command).sharp);
}

TEST(CanvasInput, another_tool_picked_elsewhere_ends_what_is_in_hand) {
  H hand(one_layer());
  hand.state.tool = Tool::kMove;
  hand.send({H::press({282, 80}), H::move({300, 80})});
  hand.state.tool = Tool::kPin;
  hand.send({H::move({310, 80}), H::release({310, 80})});
  expect_no_change(hand.take());
  EXPECT_FALSE(hand.input.held());
}

TEST(CanvasInput, one_canvas_takes_both_curves) {
  H hand(one_layer(false));
  hand.two = false;
  hand.state.tool = Tool::kOutline;
  InputEvents events{H::press({120, 80})};
  for (const Point p : arc({80, 80}, 40, 0, 340))
    events.push_back(H::move(p));
  events.push_back(H::release({118, 66}));
  hand.send(events);
  executed<RegionSet>(hand.take());
}

TEST(CanvasLayout, shares_the_width_and_never_vanishes) {
  const CanvasLayout two = lay_out_canvases({{10, 20}, {510, 320}}, 0.4, true, 5);
  ASSERT_TRUE(two.source && two.splitter);
  EXPECT_EQ(two.source->low, (Point{10, 20}));
  EXPECT_EQ(two.source->high.x, two.splitter->low.x);
  EXPECT_EQ(two.splitter->high.x, two.target.low.x);
  EXPECT_EQ(two.target.high, (Point{510, 320}));
  EXPECT_EQ(two.side_at({11, 30}), Side::kSource);
  EXPECT_EQ(two.side_at({509, 30}), Side::kTarget);
  EXPECT_FALSE(two.side_at(two.splitter->centre()));
  for (const double width : {0.0, 1.0, 4.0, 7.0, 8.0, 20.0})
    for (const double split : {-1.0, 0.0, 0.5, 1.0, 7.0}) {
      const CanvasLayout layout = lay_out_canvases({{0, 0}, {width, 0}}, split, true, 5);
      EXPECT_GE(layout.target.size().x, 1);
      EXPECT_GE(layout.target.size().y, 1);
      if (layout.source) {
        EXPECT_GE(layout.source->size().x, 0);
      }
    }
}

} // namespace
} // namespace oversketch
