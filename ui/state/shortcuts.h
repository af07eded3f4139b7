#pragma once

#include "ui/canvas/input.h"
#include "ui/state/editor_state.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

enum class Menu { kFile, kEdit, kLayer, kView, kHelp, kTool };

/// What the window itself shows or hides; neither the editor's nor a document's.
struct WindowFlags {
  /// Beside the canvases where the window is wide enough; in a narrow one over them, and only when asked for.
  bool side_panel = true;
  bool side_over = false;
  bool narrow = false;
  /// The layer whose name is being typed.
  std::optional<LayerId> renaming;
  bool rename_starts = false;
  /// The menu that the keyboard opens.
  std::optional<Menu> menu_wanted;
  /// The canvas under the pointer.
  std::optional<Side> under_pointer;

  bool& side_shown() { return narrow ? side_over : side_panel; }
};

/// What an entry decides by, and where it puts what it wants.
struct EntryContext {
  const EditorState& state;
  /// Of the tab in front; null without one.
  const Snapshot* snapshot = nullptr;
  WindowFlags& flags;
  ActionSink& sink;
};

/// Keys that do something; a second chord does the same.
struct Chord {
  Key key = Key::kNone;
  Modifiers modifiers;
  bool operator==(const Chord&) const = default;
};

/// One thing that a menu, a key or both can ask for.  This table is all there is: menus, keys, tips and the shortcut
/// window read it.
struct Entry {
  /// Its widget is "menu." + id, of a tool "tool." + the rest.
  std::string_view id;
  Menu menu = Menu::kFile;
  std::string_view label;
  std::string_view help;
  Chord chord = {};
  Chord other = {};
  /// A line is drawn above it.
  bool begins_group = false;
  void (*act)(const EntryContext&) = nullptr;
  bool (*enabled)(const EntryContext&) = nullptr;
  bool (*checked)(const EntryContext&) = nullptr;
  /// The label where it depends on what there is: "Undo Move 40, 12".
  std::string (*full_label)(const EntryContext&) = nullptr;
  /// The canvases read its keys themselves: they know what is under the pointer and what is in hand.
  bool canvas_key = false;
};

std::span<const Entry> entries();
/// CHECKs that there is one.
const Entry& entry_of(std::string_view id);
/// The entry of those keys; null when none has them.
const Entry* find_entry(Key key, Modifiers modifiers);

bool is_enabled(const Entry& entry, const EntryContext& context);
std::string label_of(const Entry& entry, const EntryContext& context);
/// "Ctrl+Shift+S"; empty without keys.
std::string keys_of(const Entry& entry);
std::string to_string(const Chord& chord);

/// Keys that work on canvases alone, for the shortcut window: {"Space", "Pan while it is held"}.
struct KeyHelp {
  std::string_view keys;
  std::string_view what;
};
std::span<const KeyHelp> canvas_keys();

/// Reads the keys of a frame, those apart that the canvases read themselves.
/// @param keyboard_taken  a text field has the keyboard, or a dialog is open: nothing is read.
void read_keys(const InputEvents& events, bool keyboard_taken, const EntryContext& context);

/// The overlays as rows: what menus, the strip's popup and tests read.
struct OverlayRow {
  std::string_view id;
  std::string_view label;
  std::string_view help;
  bool Overlays::*on;
};
std::span<const OverlayRow> overlay_rows();

/// The comparisons as rows.
struct CompareRow {
  std::string_view id;
  std::string_view label;
  std::string_view help;
  LiveSession::Compare compare;
};
std::span<const CompareRow> compare_rows();

/// The tools as rows, in the strip's order.
struct ToolRow {
  std::string_view id;
  Tool tool;
};
std::span<const ToolRow> tool_rows();

} // namespace oversketch
