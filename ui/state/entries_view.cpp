#include "ui/state/entry_row.h"

#include <array>

namespace oversketch {
namespace {

using C = const EntryContext&;

constexpr EntryRow view(std::string_view id, std::string_view label, void (*act)(C), std::string_view help) {
  return make_row(Menu::kView, id, label, act, help);
}
constexpr EntryRow help(std::string_view id, std::string_view label, void (*act)(C), std::string_view text) {
  return make_row(Menu::kHelp, id, label, act, text);
}

Side side_of(C c) {
  return c.flags.under_pointer.value_or(Side::kTarget);
}
void fit(C c) {
  c.sink.emit(action::Fit{Side::kSource});
  c.sink.emit(action::Fit{Side::kTarget});
}
void show_actual(C c) {
  c.sink.emit(action::ZoomTo{side_of(c), 1});
}
void zoom_in(C c) {
  c.sink.emit(action::ZoomBy{side_of(c), 1.25});
}
void zoom_out(C c) {
  c.sink.emit(action::ZoomBy{side_of(c), 0.8});
}

void toggle_overlays(C c) {
  Overlays overlays = c.state.overlays;
  overlays.shown = !overlays.shown;
  c.sink.emit(action::SetOverlays{overlays});
}
bool overlays_shown(C c) {
  return c.state.overlays.shown;
}
void toggle_side_panel(C c) {
  c.flags.side_shown() = !c.flags.side_shown();
}
bool side_panel_shown(C c) {
  return c.flags.side_shown();
}
bool several_tabs(C c) {
  return c.state.tabs.size() > 1;
}
void next_tab(C c) {
  c.sink.emit(action::SelectTab{(c.state.front + 1) % c.state.tabs.size()});
}
void previous_tab(C c) {
  c.sink.emit(action::SelectTab{(c.state.front + c.state.tabs.size() - 1) % c.state.tabs.size()});
}

void toggle_shortcuts(C c) {
  c.sink.emit(action::ShowWindow{action::Window::kShortcuts, !c.state.show_shortcuts});
}
void show_about(C c) {
  c.sink.emit(action::ShowWindow{action::Window::kAbout, true});
}

template <Tool tool>
void pick(C c) {
  c.sink.emit(action::PickTool{tool});
}
template <Tool tool>
constexpr EntryRow pick_row(std::string_view id, std::string_view label, char key, std::string_view text) {
  return make_row(Menu::kTool, id, label, pick<tool>, text).keys(plain(key)).on_canvas();
}

} // namespace

std::span<const EntryRow> view_entries() {
  static constexpr std::array kRows = {
      view("view.fit", "Fit", fit, "The whole picture, on both canvases.").keys(ctrl('0')).when(has_tab).on_canvas(),
      view("view.actual", "100 %", show_actual, "One pixel of the picture is one pixel of the screen.")
          .keys(ctrl('1'))
          .when(has_tab)
          .on_canvas(),
      view("view.zoom_in", "Zoom in", zoom_in, "The canvas under the pointer, else the target.")
          .keys(plain('+'), plain('='))
          .when(has_tab)
          .on_canvas(),
      view("view.zoom_out", "Zoom out", zoom_out, "The canvas under the pointer, else the target.")
          .keys(plain('-'))
          .when(has_tab)
          .on_canvas(),
      view("view.overlays", "Show overlays", toggle_overlays, "Curves, pins and meshes over the pictures, all at once.")
          .keys(plain(Key::kTab), ctrl('H'))
          .mark(overlays_shown)
          .below_line(),
      view("view.side_panel", "Side panel", toggle_side_panel, "Layers, deformation, blending, history.")
          .keys(plain(Key::kF4))
          .mark(side_panel_shown),
      view("view.next_tab", "Next document", next_tab, "The tab to the right.")
          .keys({Key::kTab, {.ctrl = true}})
          .when(several_tabs)
          .below_line(),
      view("view.previous_tab", "Previous document", previous_tab, "The tab to the left.")
          .keys({Key::kTab, {.shift = true, .ctrl = true}})
          .when(several_tabs),

      help("help.shortcuts", "Shortcuts", toggle_shortcuts, "All keys, to be searched.").keys(plain(Key::kF1)),
      help("help.about", "About Oversketch", show_about, "Version and licences."),

      pick_row<Tool::kOutline>("tool.outline", "Outline", 'L', "Draw round the part in the source."),
      pick_row<Tool::kSketch>("tool.sketch", "Sketch", 'S',
                              "Draw the boundary that the part shall take in the target."),
      pick_row<Tool::kPin>("tool.pin", "Pin", 'P', "Fix a point of the outline to a point of the sketch."),
      pick_row<Tool::kMove>("tool.move", "Move", 'V', "Move, turn and scale the pasted part."),
      pick_row<Tool::kPan>("tool.pan", "Pan", 'H', "Move the picture under the window; Space does so with any tool."),
  };
  return kRows;
}

} // namespace oversketch
