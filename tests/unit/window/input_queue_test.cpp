#include "app/gui/input_queue.h"

#include <gtest/gtest.h>

namespace oversketch::gui {
namespace {

RawEvent make(RawEvent::Kind kind, int code, bool down, Key key = Key::kNone) {
  RawEvent raw;
  raw.kind = kind;
  raw.code = code;
  raw.action = down ? 1 : 0;
  raw.event.key = key;
  if (kind == RawEvent::Kind::kButton) raw.event.kind = down ? InputEvent::Kind::kPress : InputEvent::Kind::kRelease;
  if (kind == RawEvent::Kind::kKey) raw.event.kind = down ? InputEvent::Kind::kKeyDown : InputEvent::Kind::kKeyUp;
  if (kind == RawEvent::Kind::kFocus) raw.event.kind = InputEvent::Kind::kFocusLost;
  return raw;
}
RawEvent move(double x) {
  RawEvent raw = make(RawEvent::Kind::kMove, 0, false);
  raw.event.position = {x, 0};
  return raw;
}
RawEvent button(bool down) {
  return make(RawEvent::Kind::kButton, 0, down);
}
RawEvent key(Key which, bool down, bool ctrl = false) {
  RawEvent raw = make(RawEvent::Kind::kKey, static_cast<int>(which), down, which);
  raw.event.modifiers.ctrl = ctrl;
  return raw;
}
RawEvent text(char character) {
  return make(RawEvent::Kind::kText, character, false);
}

/// How many events each batch has.
std::vector<std::size_t> batches(const std::vector<RawEvent>& events) {
  InputQueue queue;
  for (const RawEvent& event : events)
    queue.push(event);
  std::vector<std::size_t> sizes;
  while (!queue.empty())
    sizes.push_back(queue.take_batch().size());
  EXPECT_TRUE(queue.take_batch().empty());
  return sizes;
}

using Sizes = std::vector<std::size_t>;

TEST(InputQueue, nothing_gives_nothing) {
  EXPECT_EQ(batches({}), Sizes{});
}

TEST(InputQueue, a_whole_stroke_needs_two_frames_at_any_speed) {
  std::vector<RawEvent> stroke = {move(1), button(true)};
  for (int i = 0; i < 200; ++i)
    stroke.push_back(move(i));
  stroke.push_back(button(false));
  EXPECT_EQ(batches(stroke), (Sizes{2, 201}));
}

TEST(InputQueue, a_click_is_seen_down_and_up_and_where_it_was) {
  EXPECT_EQ(batches({move(5), button(true), button(false), move(99)}), (Sizes{2, 1, 1}));
}

TEST(InputQueue, what_was_typed_before_a_chord_keeps_its_own_frame) {
  EXPECT_EQ(batches({key(key_of('A'), true), text('a'), key(key_of('A'), false), key(Key::kCtrl, true, true),
                     key(key_of('S'), true, true)}),
            (Sizes{3, 2}));
}

TEST(InputQueue, a_chord_is_seen_whichever_key_is_let_go_first) {
  EXPECT_EQ(batches({key(key_of('A'), true, true), key(Key::kCtrl, false), key(key_of('A'), false)}), (Sizes{1, 1, 1}));
  EXPECT_EQ(batches({key(Key::kCtrl, true, true), key(key_of('A'), true, true), key(Key::kCtrl, false)}),
            (Sizes{2, 1}));
}

TEST(InputQueue, typed_letters_share_a_frame_and_keys_do_not) {
  EXPECT_EQ(batches({key(key_of('A'), true), text('a'), key(key_of('A'), false), key(key_of('B'), true), text('b'),
                     key(key_of('B'), false)}),
            Sizes{6});
  EXPECT_EQ(batches({key(Key::kDelete, true), key(Key::kDelete, false), key(Key::kDelete, true)}), (Sizes{1, 1, 1}));
  EXPECT_EQ(batches({key(Key::kCtrl, true, true), key(key_of('S'), true, true), key(key_of('S'), false, true),
                     key(Key::kCtrl, false)}),
            (Sizes{2, 2}));
}

TEST(InputQueue, letters_wait_for_the_keys_before_them) {
  EXPECT_EQ(batches({key(Key::kBackspace, true), text('x')}), (Sizes{1, 1}));
  EXPECT_EQ(batches({text('x'), key(Key::kBackspace, true)}), Sizes{2});
  EXPECT_EQ(batches({button(true), text('x')}), (Sizes{1, 1}));
}

TEST(InputQueue, the_editor_sees_no_text_and_only_the_loss_of_focus) {
  const auto events = to_events({move(3), text('x'), make(RawEvent::Kind::kEnter, 0, true),
                                 make(RawEvent::Kind::kFocus, 0, true), make(RawEvent::Kind::kFocus, 0, false)});
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].position.x, 3);
  EXPECT_EQ(events[1].kind, InputEvent::Kind::kFocusLost);
}

} // namespace
} // namespace oversketch::gui
