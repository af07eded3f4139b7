#include "ui/panels/dialogs.h"

#include "ui/panels/tool_panel.h"
#include "ui/widgets/buttons.h"
#include "ui/widgets/dialog.h"
#include "ui/widgets/slider.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oversketch {
namespace {

void give_answer(const Question::Answer& answer, const DrawContext& context) {
  context.sink.emit(action::Dismiss{});
  for (const Action& action : answer.actions)
    context.sink.emit(action);
}

/// Takes what a slider says at once; there is no gesture to a preference.
bool take(const SliderChange& change, double& value, const DrawContext& context) {
  using Kind = SliderChange::Kind;
  if (change.kind == Kind::kRefused) context.sink.emit(action::Say{change.text});
  const bool set = change.kind == Kind::kPreview || change.kind == Kind::kCommit || change.kind == Kind::kSet;
  if (set) value = change.value;
  return set;
}

bool draw_theme(Preferences& preferences, const DrawContext& context) {
  static constexpr std::array kThemes = {
      Option{"dark", "Dark", "Quiet dark greys: pictures look as they are."},
      Option{"light", "Light", "For bright rooms."},
  };
  const RowBox row = begin_row(context, "Theme");
  const int chosen = draw_segments(context, "preferences.theme", kThemes, static_cast<int>(preferences.theme));
  if (chosen >= 0) preferences.theme = static_cast<Theme>(chosen);
  end_row(context, row);
  return chosen >= 0;
}

/// The window changes its size under the hand with it, so that it is set when the hand lets go.
bool draw_scale(Preferences& preferences, const DrawContext& context) {
  const SliderSpec spec{.low = 0.5, .high = 3, .least = 0.5, .most = 3, .initial = 1, .factor = 100, .unit = "%"};
  const SliderChange change =
      draw_slider(context, "preferences.scale", "Interface size",
                  {"Of text and buttons, on top of what the display asks for, %.", {}}, preferences.ui_scale, spec);
  if (change.kind == SliderChange::Kind::kPreview) return false;
  return take(change, preferences.ui_scale, context);
}

/// The answer that Enter gives: at first the preferred one; the arrows and Tab go to others.
void choose_answer(const Question& question, std::size_t& chosen, bool appears, const InputEvents& events) {
  const std::size_t count = question.answers.size();
  if (appears || chosen >= count) {
    const auto preferred = std::ranges::find(question.answers, true, &Question::Answer::preferred);
    chosen = preferred == question.answers.end() ? 0 : static_cast<std::size_t>(preferred - question.answers.begin());
  }
  for (const InputEvent& event : events) {
    if (event.kind != InputEvent::Kind::kKeyDown && event.kind != InputEvent::Kind::kKeyRepeat) continue;
    // The first answer stands at the right.
    const bool back = event.key == Key::kRight || (event.key == Key::kTab && event.modifiers.shift);
    if (back)
      chosen = (chosen + count - 1) % count;
    else if (event.key == Key::kLeft || event.key == Key::kTab)
      chosen = (chosen + 1) % count;
  }
}

} // namespace

void draw_question_dialog(const Question& question, std::size_t& chosen, const InputEvents& events,
                          const DrawContext& context) {
  const Dialog dialog(context, "dialog.question", question.title, ImVec2(440, 0));
  choose_answer(question, chosen, dialog.appears(), events);
  draw_note(context, question.text);
  AnswerRow row(context);
  const Question::Answer* given = nullptr;
  // The first answer stands at the right, where the hand expects it.
  for (const Question::Answer& answer : question.answers)
    if (const bool is_chosen = &answer == &question.answers[chosen];
        row.draw("question." + answer.id, answer.label, {answer.label, is_chosen ? "Enter" : "Tab chooses"}, is_chosen))
      given = &answer;
  if (!dialog.appears() && given == nullptr) {
    if (is_pressed(events, Key::kEnter)) given = &question.answers[chosen];
    if (is_pressed(events, Key::kEscape)) return context.sink.emit(action::Dismiss{});
  }
  if (given != nullptr) give_answer(*given, context);
}

void draw_new_document_dialog(NewDocumentState& state, const InputEvents& events, const DrawContext& context) {
  const Dialog dialog(context, "dialog.new", "New document", ImVec2(380, 0));
  const auto draw_side = [&](const char* id, const char* label, const char* tip, int& side) {
    const IdScope scope(id);
    const RowBox row = begin_row(context, label);
    ImGui::SetNextItemWidth(row.width() - context.look.px(30));
    ImGui::InputInt("##side", &side, 0);
    finish_item(context, id, {tip, {}});
    draw_text(ImVec2(row.end.x - context.look.px(24), row.corner.y), row.end, context.look.ink_quiet, "px");
    end_row(context, row);
  };
  draw_side("new.width", "Width", "From 1 to 65535 pixels.", state.width);
  draw_side("new.height", "Height", "From 1 to 65535 pixels.", state.height);
  const RowBox row = begin_row(context, "Colour");
  ImGui::SetNextItemWidth(row.width());
  ImGui::ColorEdit3("##color", state.color, ImGuiColorEditFlags_NoLabel);
  finish_item(context, "new.color", {"What the picture is filled with: red, green and blue, 0 to 255.", {}});
  end_row(context, row);

  const auto valid = [](int side) { return side >= 1 && side <= 65535; };
  const bool possible = valid(state.width) && valid(state.height);
  if (!possible) draw_note(context, "Both sides must be between 1 and 65535 px.");
  AnswerRow answers(context);
  const bool typing = ImGui::GetIO().WantTextInput;
  const bool entered = is_pressed(events, Key::kEnter) && !typing && !dialog.appears();
  if ((answers.draw("new.create", "Create", {"Opens it in a tab of its own.", "Enter"}, true, possible) || entered) &&
      possible) {
    DocumentNew what;
    what.width = state.width;
    what.height = state.height;
    Color color;
    for (std::size_t i = 0; i < 3; ++i)
      color.rgb[i] = std::round(255.0 * std::clamp(state.color[i], 0.0F, 1.0F));
    what.color = color;
    context.sink.emit(action::Dismiss{});
    context.sink.emit(action::NewDocument{what});
  }
  if (answers.draw("new.cancel", "Cancel", {"Nothing is made.", "Esc"}) ||
      (is_pressed(events, Key::kEscape) && !dialog.appears()))
    context.sink.emit(action::Dismiss{});
}

void draw_preferences_dialog(const Preferences& preferences, bool has_system_dialog, const InputEvents& events,
                             const DrawContext& context) {
  const Dialog dialog(context, "dialog.preferences", "Preferences", ImVec2(460, 0));
  Preferences changed = preferences;
  bool any = draw_theme(changed, context);
  any |= draw_scale(changed, context);
  any |= draw_stroke_options(context, "preferences", changed);
  const auto draw_memory = [&](const char* id, const char* label, const char* tip, double initial, double& mib) {
    const SliderSpec spec{.low = 64,
                          .high = 65536,
                          .least = 16,
                          .most = 1048576,
                          .initial = initial,
                          .logarithmic = true,
                          .whole = true,
                          .unit = "MB"};
    any |= take(draw_slider(context, id, label, {tip, {}}, mib, spec), mib, context);
  };
  draw_memory("preferences.pictures", "Picture memory",
              "How much memory a document's pictures may take, MB; a million pixels take 15 MB. What asks for more is "
              "not opened.",
              Preferences().pictures_mib, changed.pictures_mib);
  draw_memory("preferences.history", "History memory",
              "How much memory pictures may take that only undo needs, MB. Fifty steps are always kept.",
              Preferences().history_mib, changed.history_mib);
  const auto toggle = [&](const char* id, const char* label, const char* tip, bool& on) {
    if (!draw_toggle(context, id, label, {tip, {}}, on)) return;
    on = !on;
    any = true;
  };
  toggle("preferences.wheel", "The wheel zooms", "Otherwise it scrolls, and Ctrl with the wheel zooms.",
         changed.wheel_zooms);
  if (has_system_dialog)
    toggle("preferences.system_dialog", "The desktop's file dialog", "Instead of this program's own browser.",
           changed.system_dialog);
  if (any) context.sink.emit(action::SetPreferences{changed});
  AnswerRow answers(context);
  if (answers.draw("preferences.close", "Close", {"Everything is kept already.", "Esc"}, true) ||
      (is_pressed(events, Key::kEscape) && !dialog.appears() && !ImGui::GetIO().WantTextInput))
    context.sink.emit(action::ShowWindow{action::Window::kPreferences, false});
}

void draw_about_dialog(const InputEvents& events, const DrawContext& context) {
  const Dialog dialog(context, "dialog.about", "Oversketch " OVERSKETCH_VERSION, ImVec2(460, 0));
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted("Takes part of a photograph, bends it to a shape that is drawn, and sets it into another "
                         "photograph so that no seam shows.");
  ImGui::PopTextWrapPos();
  ImGui::Dummy(ImVec2(1, context.look.px(4)));
  draw_note(context, "Built with Dear ImGui, GLFW, libepoxy, Eigen, JSON for Modern C++, CLI11, stb, xxHash, libspng, "
                     "libjpeg-turbo and libexif.\n\nInter by Rasmus Andersson and Fork Awesome: SIL Open Font License "
                     "1.1. Their licences lie in assets/fonts, those of the sample photographs in "
                     "assets/samples/LICENSES.md, this program's in LICENSE.");
  AnswerRow answers(context);
  if (answers.draw("about.close", "Close", {"Back to the pictures.", "Esc"}, true) ||
      ((is_pressed(events, Key::kEscape) || is_pressed(events, Key::kEnter)) && !dialog.appears()))
    context.sink.emit(action::ShowWindow{action::Window::kAbout, false});
}

} // namespace oversketch
