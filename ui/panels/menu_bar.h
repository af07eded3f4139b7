#pragma once

#include "ui/panels/window_layout.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/draw_context.h"

#include <string>

namespace oversketch {

/// "puffer-in-the-sea.ora *": the document in front, with a star while it is not saved.
std::string document_title(const EditorState& state, const Snapshot* snapshot);

/// The menus, between the program's name and the document's.  To be called within a window that has a menu bar.
/// @param area  of the bar.
void draw_menu_bar(const EntryContext& entries, const Area& area, const DrawContext& context);

/// The switches of all overlays, and the choices of what is compared with, as menu entries: for the View menu and for
/// the tool strip's popups.
/// @param prefix  of the widgets' names.
void draw_overlay_entries(const EntryContext& entries, std::string_view prefix, const DrawContext& context);
void draw_compare_entries(const EntryContext& entries, std::string_view prefix, const DrawContext& context);

} // namespace oversketch
