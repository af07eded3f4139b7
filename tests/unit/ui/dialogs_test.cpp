#include "ui/panels/dialogs.h"

#include "tests/unit/ui/headless.h"

namespace oversketch {
namespace {

using testing::Headless;

class Dialogs : public Headless {
protected:
  Dialogs() : Headless(ImVec2(900, 700)) {
    question.title = "Save changes to sea?";
    question.text = "What was done since the last saving is lost otherwise.";
    question.answers = {{"save", "Save", {action::Save{}}, true},
                        {"discard", "Don't save", {action::Quit{true, false}}, false},
                        {"cancel", "Cancel", {}, false}};
  }
  void expect_dialog_tips() {
    for (const auto& [name, box] : widgets_.boxes())
      if (!name.starts_with("dialog.")) {
        EXPECT_TRUE(widgets_.tips().contains(name)) << name;
      }
  }
  void show_question() {
    show([this](const DrawContext& context) { draw_question_dialog(question, chosen, events, context); }, true);
  }
  Question question;
  std::size_t chosen = 0;
  Preferences preferences;
  NewDocumentState fresh;
  std::string search;
};

TEST_F(Dialogs, QuestionsAreAnsweredByButtons) {
  show_question();
  expect_dialog_tips();
  click("question.discard");
  const auto actions = take();
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<action::Dismiss>(actions[0])) << "the old question goes before the next can come";
  EXPECT_TRUE(std::get<action::Quit>(actions[1]).without_asking);
  click("question.cancel");
  const auto cancelled = take();
  ASSERT_EQ(cancelled.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<action::Dismiss>(cancelled[0]));
}

TEST_F(Dialogs, EnterGivesThePreferredAnswerAndEscapeNone) {
  show_question();
  events = {key_event(Key::kEnter)};
  frame();
  EXPECT_EQ(take_all<action::Save>().size(), 1U);
  events = {key_event(Key::kEscape)};
  frame();
  const auto actions = take();
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<action::Dismiss>(actions[0]));
}

TEST_F(Dialogs, TabAndTheArrowsChooseAnAnswer) {
  show_question();
  events = {key_event(Key::kTab)};
  frame();
  events = {key_event(Key::kEnter)};
  frame();
  EXPECT_EQ(take_all<action::Quit>().size(), 1U) << "the second answer, at the left of the first";
  events = {key_event(Key::kRight), key_event(Key::kRight), key_event(Key::kEnter)};
  frame();
  EXPECT_EQ(take().size(), 1U) << "once round: the last one, which does nothing";
}

TEST_F(Dialogs, TheKeyThatOpenedItDoesNotAnswerIt) {
  events = {key_event(Key::kEnter)};
  show_question();
  EXPECT_TRUE(take().empty());
}

TEST_F(Dialogs, NewDocumentsHaveSizeAndColour) {
  fresh.width = 640;
  fresh.height = 480;
  fresh.color[0] = 0.5F;
  show([this](const DrawContext& context) { draw_new_document_dialog(fresh, events, context); }, true);
  expect_dialog_tips();
  click("new.create");
  const auto what = take_one<action::NewDocument>().what;
  ASSERT_TRUE(what.has_value());
  EXPECT_EQ(what->width, 640);
  EXPECT_EQ(what->height, 480);
  EXPECT_EQ(what->color->rgb, (std::array<double, 3>{128, 255, 255}));
}

TEST_F(Dialogs, NewDocumentsOfImpossibleSizeAreNotMade) {
  for (const int width : {0, -4, 65536}) {
    fresh.width = width;
    show([this](const DrawContext& context) { draw_new_document_dialog(fresh, events, context); }, true);
    click("new.create");
    events = {key_event(Key::kEnter)};
    frame();
    EXPECT_TRUE(take().empty()) << width;
  }
}

TEST_F(Dialogs, PreferencesTakeEffectAtOnce) {
  show([this](const DrawContext& context) { draw_preferences_dialog(preferences, true, events, context); }, true);
  frame();
  expect_dialog_tips();
  click("preferences.theme.light");
  EXPECT_EQ(take_one<action::SetPreferences>().preferences.theme, Theme::kLight);
  click("preferences.smoothing.none");
  EXPECT_EQ(take_one<action::SetPreferences>().preferences.smoothing, Smoothing::kNone);
  click("preferences.wheel");
  EXPECT_FALSE(take_one<action::SetPreferences>().preferences.wheel_zooms);
  click("preferences.system_dialog");
  EXPECT_TRUE(take_one<action::SetPreferences>().preferences.system_dialog);
  click("preferences.close");
  EXPECT_FALSE(take_one<action::ShowWindow>().shown);
}

TEST_F(Dialogs, MemoryIsSetByItsSliders) {
  show([this](const DrawContext& context) { draw_preferences_dialog(preferences, false, events, context); }, true);
  frame();
  drag("preferences.pictures", 0.9F, 0.3F);
  wait();
  const auto first = take_all<action::SetPreferences>();
  ASSERT_FALSE(first.empty());
  EXPECT_NEAR(first.back().preferences.pictures_mib, 64 * std::pow(1024, 0.3), 64);
  EXPECT_EQ(first.back().preferences.history_mib, Preferences().history_mib);
  drag("preferences.history", 0.9F, 0.3F);
  wait();
  const auto history = take_all<action::SetPreferences>();
  ASSERT_FALSE(history.empty());
  EXPECT_NEAR(history.back().preferences.history_mib, 64 * std::pow(1024, 0.3), 64);
}

TEST_F(Dialogs, InterfaceSizeChangesWhenTheHandLetsGo) {
  show([this](const DrawContext& context) { draw_preferences_dialog(preferences, false, events, context); }, true);
  frame();
  EXPECT_FALSE(has("preferences.system_dialog")) << "there is none";
  drag("preferences.scale", 0.2F, 0.6F);
  wait();
  const auto sets = take_all<action::SetPreferences>();
  ASSERT_EQ(sets.size(), 1U) << "the window would run away under the hand";
  EXPECT_NEAR(sets[0].preferences.ui_scale, 2, 0.05);
}

TEST_F(Dialogs, KeysWaitForTheFieldThatIsToHaveThem) {
  int waited = 0;
  bool typing = true;
  const auto draw = [&](const DrawContext& context) {
    draw_shortcut_window(search, events, context);
    waited += context.reply.field_awaits_keys ? 1 : 0;
    typing = ImGui::GetIO().WantTextInput;
  };
  show(draw, true);
  EXPECT_EQ(waited, 1) << "the frame in which it appears, and no other";
  EXPECT_FALSE(typing);
  frame();
  EXPECT_TRUE(typing) << "the second frame after that is the first that is asked";
  EXPECT_EQ(waited, 1);
}

TEST_F(Dialogs, ShortcutsAreSearched) {
  show([this](const DrawContext& context) { draw_shortcut_window(search, events, context); }, true);
  frame();
  expect_dialog_tips();
  EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "one can type at once";
  type("undo");
  EXPECT_EQ(search, "undo");
  events = {key_event(Key::kEscape)};
  frame();
  EXPECT_FALSE(take_one<action::ShowWindow>().shown);
}

TEST_F(Dialogs, AboutCloses) {
  show([this](const DrawContext& context) { draw_about_dialog(events, context); }, true);
  frame();
  click("about.close");
  EXPECT_FALSE(take_one<action::ShowWindow>().shown);
}

} // namespace
} // namespace oversketch
