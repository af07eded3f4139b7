#pragma once

#include "ui/panels/window_parts.h"
#include "ui/widgets/draw_context.h"
#include "ui/widgets/pictures.h"

namespace oversketch {

/// Whether a dialog lies over the window, which then gets neither keys nor pointer.
bool has_dialog(const EditorState& state, const WindowState::Parts& parts);

/// Draws what is asked or shown on top, one thing at a time: a question before a file, a file before the rest.
void draw_dialogs(const EditorState& state, WindowState::Parts& parts, Pictures& pictures, const InputEvents& events,
                  const DrawContext& context);

} // namespace oversketch
