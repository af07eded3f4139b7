#include "ui/state/shortcuts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oversketch {
namespace {

using C = const EntryContext&;

constexpr Chord plain(Key key) {
  return {key, {}};
}
constexpr Chord ctrl(char key) {
  return {key_of(key), {.ctrl = true}};
}
constexpr Chord ctrl_shift(char key) {
  return {key_of(key), {.shift = true, .ctrl = true}};
}

template <class A>
void emit(C c) {
  c.sink.emit(A{});
}

bool has_tab(C c) {
  return c.snapshot != nullptr;
}
const Layer* selected(C c) {
  const Document* document = c.snapshot == nullptr ? nullptr : &c.snapshot->document;
  return document == nullptr || !document->selected ? nullptr : document->find(*document->selected);
}
bool has_layer(C c) {
  return selected(c) != nullptr;
}
bool has_target(C c) {
  return has_tab(c) && !c.snapshot->document.empty();
}
bool has_pin(C c) {
  return has_tab(c) && c.state.tab() != nullptr && c.state.tab()->view.selected_pin.has_value();
}

int index_of(C c) {
  const auto& layers = c.snapshot->document.layers;
  const auto found = std::ranges::find(layers, *c.snapshot->document.selected, &Layer::id);
  return static_cast<int>(found - layers.begin());
}
bool can_raise(C c) {
  return has_layer(c) && index_of(c) + 1 < static_cast<int>(c.snapshot->document.layers.size());
}
bool can_lower(C c) {
  return has_layer(c) && index_of(c) > 0;
}
void raise(C c) {
  c.sink.emit(action::Execute{LayerOrder{{}, index_of(c) + 1}});
}
void lower(C c) {
  c.sink.emit(action::Execute{LayerOrder{{}, index_of(c) - 1}});
}
void toggle_visible(C c) {
  LayerSet set;
  set.visible = !selected(c)->settings.visible;
  c.sink.emit(action::Execute{set});
}
bool is_visible(C c) {
  return has_layer(c) && selected(c)->settings.visible;
}
void rename(C c) {
  c.flags.renaming = selected(c)->id;
  c.flags.rename_starts = true;
  c.flags.side_shown() = true;
}
void remove_pin(C c) {
  c.sink.emit(action::Execute{PinRemove{{}, *c.state.tab()->view.selected_pin}});
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
/// Steps that a hand can feel, whatever the tolerance is now.
void scale_tolerance(C c, double factor) {
  Preferences preferences = c.state.preferences;
  preferences.tolerance_px = std::clamp(std::round(preferences.tolerance_px * factor), 1.0, 100.0);
  if (preferences.tolerance_px == c.state.preferences.tolerance_px)
    preferences.tolerance_px = std::clamp(preferences.tolerance_px + (factor > 1 ? 1 : -1), 1.0, 100.0);
  c.sink.emit(action::SetPreferences{preferences});
}

Side side_of(C c) {
  return c.flags.under_pointer.value_or(Side::kTarget);
}
void fit(C c) {
  if (c.flags.under_pointer) return c.sink.emit(action::Fit{*c.flags.under_pointer});
  c.sink.emit(action::Fit{Side::kSource});
  c.sink.emit(action::Fit{Side::kTarget});
}
void toggle_overlays(C c) {
  Overlays overlays = c.state.overlays;
  overlays.shown = !overlays.shown;
  c.sink.emit(action::SetOverlays{overlays});
}
bool several_tabs(C c) {
  return c.state.tabs.size() > 1;
}
void next_tab(C c) {
  c.sink.emit(action::SelectTab{(c.state.front + 1) % c.state.tabs.size()});
}
void close_tab(C c) {
  c.sink.emit(action::CloseTab{c.state.front});
}
void show(C c, action::Window window) {
  c.sink.emit(action::ShowWindow{window, true});
}
constexpr Entry on_canvas(Entry entry) {
  entry.canvas_key = true;
  return entry;
}
template <Tool tool>
void pick(C c) {
  c.sink.emit(action::PickTool{tool});
}

} // namespace

std::span<const Entry> entries() {
  static constexpr std::array kEntries = {
      Entry{"file.new",
            Menu::kFile,
            "New…",
            "An empty picture of a size and a colour.",
            ctrl('N'),
            {},
            false,
            emit<action::NewDocument>},
      Entry{"file.open",
            Menu::kFile,
            "Open…",
            "A picture to paste into, a project or a script.",
            ctrl('O'),
            {},
            false,
            emit<action::Open>},
      Entry{"file.sample",
            Menu::kFile,
            "Open the sample",
            "A puffer fish in the sea, to try things on.",
            {},
            {},
            false,
            emit<action::OpenSample>},
      Entry{"file.target",
            Menu::kFile,
            "Change target…",
            "Another picture under the same layers.",
            {},
            {},
            true,
            emit<action::SetTarget>,
            has_target},
      Entry{"file.save",
            Menu::kFile,
            "Save",
            "The project, with its history.",
            ctrl('S'),
            {},
            true,
            emit<action::Save>,
            has_target},
      Entry{"file.save_as",
            Menu::kFile,
            "Save as…",
            "The project under another name.",
            ctrl_shift('S'),
            {},
            false,
            emit<action::SaveAs>,
            has_target},
      Entry{"file.export_again",
            Menu::kFile,
            "Export again",
            "The picture to where it went before.",
            ctrl('E'),
            {},
            false,
            emit<action::ExportAgain>,
            has_target},
      Entry{"file.export",
            Menu::kFile,
            "Export…",
            "The picture as PNG or JPEG.",
            ctrl_shift('E'),
            {},
            false,
            emit<action::Export>,
            has_target},
      Entry{"file.close",
            Menu::kFile,
            "Close",
            "The document in front; asks when it is not saved.",
            ctrl('W'),
            {},
            true,
            close_tab,
            [](C c) { return c.state.tab() != nullptr; }},
      Entry{"file.quit",
            Menu::kFile,
            "Quit",
            "Asks when something is not saved.",
            ctrl('Q'),
            {},
            false,
            emit<action::Quit>},

      Entry{"edit.undo",
            Menu::kEdit,
            "Undo",
            "Takes back the last step.",
            ctrl('Z'),
            {},
            false,
            emit<action::Undo>,
            can_undo,
            nullptr,
            undo_label},
      Entry{"edit.redo", Menu::kEdit, "Redo", "Does again what was taken back.", ctrl('Y'), ctrl_shift('Z'), false,
            emit<action::Redo>, can_redo, nullptr, redo_label},
      on_canvas(Entry{"edit.tolerance_less",
                      Menu::kEdit,
                      "Smaller tolerance",
                      "How near to a curve a stroke must begin and end to replace a part of it.",
                      plain(key_of('[')),
                      {},
                      true,
                      [](C c) { scale_tolerance(c, 1 / 1.25); }}),
      on_canvas(Entry{"edit.tolerance_more",
                      Menu::kEdit,
                      "Greater tolerance",
                      "How near to a curve a stroke must begin and end to replace a part of it.",
                      plain(key_of(']')),
                      {},
                      false,
                      [](C c) { scale_tolerance(c, 1.25); }}),
      Entry{"edit.cancel",
            Menu::kEdit,
            "Stop the work in hand",
            "What is being computed or saved is given up.",
            {},
            {},
            true,
            emit<action::CancelWork>,
            [](C c) { return c.state.tab() != nullptr && c.state.tab()->session->activity().busy; }},
      Entry{"edit.preferences",
            Menu::kEdit,
            "Preferences…",
            "Colours, size, wheel, smoothing, memory.",
            ctrl(','),
            {},
            true,
            [](C c) { show(c, action::Window::kPreferences); }},

      Entry{"layer.add",
            Menu::kLayer,
            "Add source image…",
            "A picture to take a part from: a new layer.",
            ctrl_shift('O'),
            {},
            false,
            emit<action::AddSource>,
            has_target},
      Entry{"layer.add_target",
            Menu::kLayer,
            "Add layer from the target",
            "A new layer that takes its part from the target itself.",
            {},
            {},
            false,
            [](C c) { c.sink.emit(action::AddSource{"@target"}); },
            has_target},
      Entry{
          "layer.rename", Menu::kLayer, "Rename", "The selected layer.", plain(Key::kF2), {}, true, rename, has_layer},
      Entry{"layer.visible",
            Menu::kLayer,
            "Visible",
            "Whether the selected layer is drawn.",
            {},
            {},
            false,
            toggle_visible,
            has_layer,
            is_visible},
      Entry{"layer.raise", Menu::kLayer, "Raise", "Over the layer above it.", ctrl(']'), {}, false, raise, can_raise},
      Entry{"layer.lower", Menu::kLayer, "Lower", "Under the layer below it.", ctrl('['), {}, false, lower, can_lower},
      Entry{"layer.reset_sketch",
            Menu::kLayer,
            "Reset sketch",
            "Makes the sketch the outline again, where the layer stands.",
            {},
            {},
            true,
            [](C c) { c.sink.emit(action::Execute{SketchReset{}}); },
            [](C c) { return has_layer(c) && !selected(c)->outline.empty(); }},
      Entry{"layer.remove_pin", Menu::kLayer, "Remove pin", "The selected pin.", {}, {}, false, remove_pin, has_pin},
      Entry{"layer.remove",
            Menu::kLayer,
            "Remove layer",
            "The selected layer; undo brings it back.",
            {},
            {},
            true,
            [](C c) { c.sink.emit(action::Execute{LayerRemove{}}); },
            has_layer},

      on_canvas(Entry{"view.fit",
                      Menu::kView,
                      "Fit",
                      "The whole picture: on the canvas under the pointer, else on both.",
                      ctrl('0'),
                      {},
                      false,
                      fit,
                      has_tab}),
      on_canvas(Entry{"view.actual",
                      Menu::kView,
                      "100 %",
                      "One pixel of the picture is one pixel of the screen.",
                      ctrl('1'),
                      {},
                      false,
                      [](C c) {
                        c.sink.emit(action::ZoomTo{side_of(c), 1});
                      },
                      has_tab}),
      on_canvas(Entry{"view.zoom_in", Menu::kView, "Zoom in", "The canvas under the pointer, else the target.",
                      plain(key_of('+')), plain(key_of('=')), false,
                      [](C c) {
                        c.sink.emit(action::ZoomBy{side_of(c), 1.25});
                      },
                      has_tab}),
      on_canvas(Entry{"view.zoom_out",
                      Menu::kView,
                      "Zoom out",
                      "The canvas under the pointer, else the target.",
                      plain(key_of('-')),
                      {},
                      false,
                      [](C c) {
                        c.sink.emit(action::ZoomBy{side_of(c), 0.8});
                      },
                      has_tab}),
      Entry{"view.overlays", Menu::kView, "Show overlays", "Curves, pins and meshes over the pictures, all at once.",
            plain(Key::kTab), ctrl('H'), true, toggle_overlays, nullptr, [](C c) { return c.state.overlays.shown; }},
      Entry{"view.side_panel",
            Menu::kView,
            "Side panel",
            "Layers, deformation, blending, history.",
            plain(Key::kF4),
            {},
            false,
            [](C c) { c.flags.side_shown() = !c.flags.side_shown(); },
            nullptr,
            [](C c) { return c.flags.side_shown(); }},
      Entry{"view.next_tab",
            Menu::kView,
            "Next document",
            "The tab to the right.",
            {Key::kTab, {.ctrl = true}},
            {},
            true,
            next_tab,
            several_tabs},

      Entry{"help.shortcuts",
            Menu::kHelp,
            "Shortcuts",
            "All keys, to be searched.",
            plain(Key::kF1),
            {},
            false,
            [](C c) {
              c.sink.emit(action::ShowWindow{action::Window::kShortcuts, !c.state.show_shortcuts});
            }},
      Entry{"help.about",
            Menu::kHelp,
            "About Oversketch",
            "Version and licences.",
            {},
            {},
            false,
            [](C c) { show(c, action::Window::kAbout); }},

      on_canvas(Entry{"tool.outline",
                      Menu::kTool,
                      "Outline",
                      "Draw round the part in the source.",
                      plain(key_of('L')),
                      {},
                      false,
                      pick<Tool::kOutline>}),
      on_canvas(Entry{"tool.sketch",
                      Menu::kTool,
                      "Sketch",
                      "Draw the boundary that the part shall take in the target.",
                      plain(key_of('S')),
                      {},
                      false,
                      pick<Tool::kSketch>}),
      on_canvas(Entry{"tool.pin",
                      Menu::kTool,
                      "Pin",
                      "Fix a point of the outline to a point of the sketch.",
                      plain(key_of('P')),
                      {},
                      false,
                      pick<Tool::kPin>}),
      on_canvas(Entry{"tool.move",
                      Menu::kTool,
                      "Move",
                      "Move, turn and scale the pasted part.",
                      plain(key_of('V')),
                      {},
                      false,
                      pick<Tool::kMove>}),
      on_canvas(Entry{"tool.pan",
                      Menu::kTool,
                      "Pan",
                      "Move the picture under the window; Space does so with any tool.",
                      plain(key_of('H')),
                      {},
                      false,
                      pick<Tool::kPan>}),
  };
  return kEntries;
}

} // namespace oversketch
