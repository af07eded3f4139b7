#include "ui/state/entry_row.h"
#include "ui/state/settings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oversketch {
namespace {

using C = const EntryContext&;

constexpr EntryRow file(std::string_view id, std::string_view label, void (*act)(C), std::string_view help) {
  return make_row(Menu::kFile, id, label, act, help);
}
constexpr EntryRow edit(std::string_view id, std::string_view label, void (*act)(C), std::string_view help) {
  return make_row(Menu::kEdit, id, label, act, help);
}

void close_tab(C c) {
  c.sink.emit(action::CloseTab{c.state.front});
}
bool has_any_tab(C c) {
  return c.state.tab() != nullptr;
}

bool can_undo(C c) {
  return has_tab(c) && c.snapshot->cursor > 0;
}
bool can_redo(C c) {
  return has_tab(c) && c.snapshot->cursor + 1 < c.snapshot->history.size();
}
std::string undo_label(C c) {
  return can_undo(c) ? "Undo " + c.snapshot->history[c.snapshot->cursor] : "Undo";
}
std::string redo_label(C c) {
  return can_redo(c) ? "Redo " + c.snapshot->history[c.snapshot->cursor + 1] : "Redo";
}

void step_tolerance(C c, bool greater) {
  Preferences preferences = c.state.preferences;
  preferences.tolerance_px = stepped_tolerance(preferences.tolerance_px, greater);
  c.sink.emit(action::SetPreferences{preferences});
}
void shrink_tolerance(C c) {
  step_tolerance(c, false);
}
void grow_tolerance(C c) {
  step_tolerance(c, true);
}

bool is_busy(C c) {
  const Tab* tab = c.state.tab();
  return tab != nullptr && tab->session != nullptr && tab->session->activity().busy;
}
void show_preferences(C c) {
  c.sink.emit(action::ShowWindow{action::Window::kPreferences, true});
}

constexpr std::string_view kToleranceHelp = "How near to a curve a stroke must begin and end to replace a part of it.";

} // namespace

std::span<const EntryRow> file_entries() {
  static constexpr std::array kRows = {
      file("file.new", "New…", emit<action::NewDocument>, "An empty picture of a size and a colour.").keys(ctrl('N')),
      file("file.open", "Open…", emit<action::Open>, "A picture to paste into, a project or a script.").keys(ctrl('O')),
      file("file.sample", "Open the sample", emit<action::OpenSample>, "A puffer fish in the sea, to try things on."),
      file("file.target", "Change target…", emit<action::SetTarget>, "Another picture under the same layers.")
          .when(has_target)
          .below_line(),
      file("file.save", "Save", emit<action::Save>, "The project, with its history.")
          .keys(ctrl('S'))
          .when(has_target)
          .below_line(),
      file("file.save_as", "Save as…", emit<action::SaveAs>, "The project under another name.")
          .keys(ctrl_shift('S'))
          .when(has_target),
      file("file.export_again", "Export again", emit<action::ExportAgain>, "The picture to where it went before.")
          .keys(ctrl('E'))
          .when(has_target),
      file("file.export", "Export…", emit<action::Export>, "The picture as PNG or JPEG.")
          .keys(ctrl_shift('E'))
          .when(has_target),
      file("file.close", "Close", close_tab, "The document in front; asks when it is not saved.")
          .keys(ctrl('W'))
          .when(has_any_tab)
          .below_line(),
      file("file.quit", "Quit", emit<action::Quit>, "Asks when something is not saved.").keys(ctrl('Q')),

      edit("edit.undo", "Undo", emit<action::Undo>, "Takes back the last step.")
          .keys(ctrl('Z'))
          .when(can_undo)
          .named(undo_label),
      edit("edit.redo", "Redo", emit<action::Redo>, "Does again what was taken back.")
          .keys(ctrl('Y'), ctrl_shift('Z'))
          .when(can_redo)
          .named(redo_label),
      edit("edit.tolerance_less", "Smaller tolerance", shrink_tolerance, kToleranceHelp)
          .keys(plain('['))
          .on_canvas()
          .below_line(),
      edit("edit.tolerance_more", "Greater tolerance", grow_tolerance, kToleranceHelp).keys(plain(']')).on_canvas(),
      edit("edit.cancel", "Stop the work in hand", emit<action::CancelWork>,
           "What is being computed or saved is given up.")
          .when(is_busy)
          .below_line(),
      edit("edit.preferences", "Preferences…", show_preferences, "Colours, size, wheel, smoothing, memory.")
          .keys(ctrl(','))
          .below_line(),
  };
  return kRows;
}

} // namespace oversketch
