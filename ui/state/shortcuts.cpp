#include "ui/state/shortcuts.h"

#include "core/base/check.h"
#include "ui/state/entry_row.h"

#include <algorithm>
#include <array>

namespace oversketch {
namespace {

std::string name_of(Key key) {
  if (key >= Key::kF1 && key <= Key::kF12) {
    // Appended, not added: GCC 12 warns of a sum here without reason.
    std::string name = "F";
    return name += std::to_string(static_cast<int>(key) - static_cast<int>(Key::kF1) + 1);
  }
  switch (key) {
  case Key::kEscape:
    return "Esc";
  case Key::kEnter:
    return "Enter";
  case Key::kTab:
    return "Tab";
  case Key::kBackspace:
    return "Backspace";
  case Key::kDelete:
    return "Delete";
  case Key::kPageUp:
    return "Page Up";
  case Key::kPageDown:
    return "Page Down";
  default:
    return {static_cast<char>(key)};
  }
}

/// Shift makes a + of a = on many keyboards, and is no part of what is meant.
Modifiers meant(Key key, Modifiers modifiers) {
  if (key == key_of('+') || key == key_of('=')) modifiers.shift = false;
  return modifiers;
}

bool repeats(const Entry& entry) {
  return entry.id == "edit.undo" || entry.id == "edit.redo";
}

} // namespace

std::span<const Entry> entries() {
  static const std::vector<Entry> kEntries = [] {
    std::vector<Entry> all;
    for (const auto rows : {file_entries(), layer_entries(), view_entries()})
      all.insert(all.end(), rows.begin(), rows.end());
    return all;
  }();
  return kEntries;
}

const Entry& entry_of(std::string_view id) {
  const auto found = std::ranges::find(entries(), id, &Entry::id);
  CHECK(found != entries().end(), "an entry that is not in the table");
  return *found;
}

const Entry* find_entry(Key key, Modifiers modifiers) {
  if (key == Key::kNone) return nullptr;
  const Chord chord{key, meant(key, modifiers)};
  const auto found =
      std::ranges::find_if(entries(), [&](const Entry& entry) { return entry.chord == chord || entry.other == chord; });
  return found == entries().end() ? nullptr : &*found;
}

bool is_enabled(const Entry& entry, const EntryContext& context) {
  return entry.enabled == nullptr || entry.enabled(context);
}

std::string label_of(const Entry& entry, const EntryContext& context) {
  return entry.full_label == nullptr ? std::string(entry.label) : entry.full_label(context);
}

std::string to_string(const Chord& chord) {
  if (chord.key == Key::kNone) return {};
  std::string text;
  if (chord.modifiers.ctrl) text += "Ctrl+";
  if (chord.modifiers.shift) text += "Shift+";
  if (chord.modifiers.alt) text += "Alt+";
  return text + name_of(chord.key);
}

std::string keys_of(const Entry& entry) {
  const std::string first = to_string(entry.chord), second = to_string(entry.other);
  return second.empty() ? first : first + ", " + second;
}

void read_keys(const InputEvents& events, bool keyboard_taken, const EntryContext& context) {
  if (keyboard_taken) return;
  for (const InputEvent& event : events) {
    const bool repeat = event.kind == InputEvent::Kind::kKeyRepeat;
    if (event.kind != InputEvent::Kind::kKeyDown && !repeat) continue;
    if (event.key == Key::kF10 && event.modifiers == Modifiers()) context.flags.menu_wanted = Menu::kFile;
    const Entry* entry = find_entry(event.key, event.modifiers);
    if (entry == nullptr || entry->canvas_key || (repeat && !repeats(*entry))) continue;
    if (is_enabled(*entry, context)) entry->act(context);
  }
}

std::span<const OverlayRow> overlay_rows() {
  static constexpr std::array kRows = {
      OverlayRow{"curves", "Outline and sketch", "The outline on the source and the sketch on the target.",
                 &Overlays::curves},
      OverlayRow{"pins", "Pins", "Points of the outline that are fixed to points of the sketch.", &Overlays::pins},
      OverlayRow{"correspondence", "Correspondence",
                 "Colours round both curves: equal colours are points that belong together.",
                 &Overlays::correspondence},
      OverlayRow{"handles", "Handles", "The samples of the outline that pull the mesh along.", &Overlays::handles},
      OverlayRow{"control", "Control mesh", "The coarse mesh that the deformation is solved on.",
                 &Overlays::control_mesh},
      OverlayRow{"display", "Display mesh", "The fine mesh that the picture is drawn with.", &Overlays::display_mesh},
      OverlayRow{"gradients", "Gradients", "Which way the paper's method pulls each vertex, ten times as long.",
                 &Overlays::gradients},
      OverlayRow{"flipped", "Folded cells", "Cells that are turned inside out, in red; there should be none.",
                 &Overlays::flipped},
      OverlayRow{"sigma", "Distortion", "How far each cell is squeezed: longest side by shortest, σ1/σ2.",
                 &Overlays::heat_sigma},
      OverlayRow{"area", "Change of area", "How much each cell grew or shrank.", &Overlays::heat_area},
      OverlayRow{"bleed", "Bleed forecast",
                 "How far the colours differ along the boundary: where they do, blending will tint the part.",
                 &Overlays::bleed},
  };
  return kRows;
}

std::span<const CompareRow> compare_rows() {
  using Compare = LiveSession::Compare;
  static constexpr std::array kRows = {
      CompareRow{"off", "Off", "The result alone.", Compare::kOff},
      CompareRow{"hidden", "Target", "The target without the selected layer.", Compare::kHidden},
      CompareRow{"paste", "Paste", "The selected layer pasted without blending.", Compare::kPaste},
      CompareRow{"initial", "Initial", "The selected layer by the linear start of the paper's method.",
                 Compare::kInitial},
      CompareRow{"paper", "Paper", "The selected layer by the paper's method.", Compare::kPaper},
      CompareRow{"flipfree", "Flip-free", "The selected layer by the flip-free method.", Compare::kFlipfree},
  };
  return kRows;
}

std::span<const ToolRow> tool_rows() {
  static constexpr std::array kRows = {ToolRow{"outline", Tool::kOutline}, ToolRow{"sketch", Tool::kSketch},
                                       ToolRow{"pin", Tool::kPin}, ToolRow{"move", Tool::kMove},
                                       ToolRow{"pan", Tool::kPan}};
  return kRows;
}

std::span<const KeyHelp> canvas_keys() {
  static constexpr std::array kKeys = {
      KeyHelp{"Space, middle button", "Pan while it is held"},
      KeyHelp{"Wheel", "Zoom about the pointer (or scroll: Preferences)"},
      KeyHelp{"Esc", "Give up what is in hand"},
      KeyHelp{"F10", "Open the menus; arrows move, Enter chooses, Esc leaves"},
      KeyHelp{"Enter", "Finish what is in hand"},
      KeyHelp{"X", "While drawing over a curve: replace the other side"},
      KeyHelp{"Alt", "While drawing over a curve: sharp joins"},
      KeyHelp{"Arrows", "Move tool: one pixel; with Shift ten"},
      KeyHelp{"Shift", "Move tool: keep to one direction, turn by steps of 15°"},
      KeyHelp{"Delete", "Remove the selected pin"},
      KeyHelp{"\\", "While held: the target without the layer"},
      KeyHelp{"A tool's key, held", "That tool until the key is let go"},
  };
  return kKeys;
}

} // namespace oversketch
