#pragma once

#include "ui/canvas/input.h"
#include "ui/state/editor_state.h"
#include "ui/widgets/draw_context.h"
#include "ui/widgets/pictures.h"
#include "ui/window_state.h"

namespace oversketch {

/// Draws the whole window into the present ImGui frame and reads the keys: menu bar, tabs, tool strip, canvases, side
/// panel, status bar, and whatever is asked or shown on top.
///
/// Nothing of the editor is changed here: what a person wants goes into `context.sink`.  Every widget puts its place
/// into `context.widgets`, which the caller clears before.
///
/// @param window  what the window itself keeps from frame to frame.
/// @param events  what happened since the last frame, in order.
/// @threads the window's.
void draw_editor_window(const EditorState& state, WindowState& window, Pictures& pictures, const InputEvents& events,
                        const DrawContext& context);

} // namespace oversketch
