#pragma once

#include "ui/canvas/input.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/draw_context.h"

#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

/// A question of the editor's, one button an answer: "question.save" ….  An answer is emitted as Dismiss and then its
/// actions; Enter gives the one that is chosen, at first the preferred one, Esc none; Tab and the arrows choose.
/// @param chosen  which answer; kept between frames.
void draw_question_dialog(const Question& question, std::size_t& chosen, const InputEvents& events,
                          const DrawContext& context);

/// What is typed about a new document.
struct NewDocumentState {
  int width = 1920;
  int height = 1080;
  float color[3] = {1, 1, 1};
};
/// "new.width", "new.height", "new.color", "new.create", "new.cancel".
void draw_new_document_dialog(NewDocumentState& state, const InputEvents& events, const DrawContext& context);

/// Takes effect at once.  "preferences.theme.dark" …, "preferences.scale", "preferences.wheel",
/// "preferences.smoothing.*", "preferences.tolerance", "preferences.pictures", "preferences.history",
/// "preferences.system_dialog", "preferences.close".
/// @param has_system_dialog  there is one to be preferred.
void draw_preferences_dialog(const Preferences& preferences, bool has_system_dialog, const InputEvents& events,
                             const DrawContext& context);

/// Version, licences.  "about.close".
void draw_about_dialog(const InputEvents& events, const DrawContext& context);

/// One line of the shortcut window.
struct ShortcutRow {
  std::string keys;
  std::string what;
  std::string help;
};
/// Those whose keys, names or meaning hold all the words searched for, in any case.
std::vector<ShortcutRow> find_shortcuts(std::string_view search);

/// "shortcuts.search", "shortcuts.close".
/// @param search  what is being typed.
void draw_shortcut_window(std::string& search, const InputEvents& events, const DrawContext& context);

} // namespace oversketch
