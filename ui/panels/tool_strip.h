#pragma once

#include "ui/panels/window_layout.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/draw_context.h"

namespace oversketch {

/// The tools, and below them what the canvases show besides the picture: overlays, comparison; in a narrow window the
/// side panel's button too.  To be called within the strip's own window.
/// @param columns  of buttons, 1 or 2.
void draw_tool_strip(const EntryContext& entries, const Area& area, int columns, const DrawContext& context);

} // namespace oversketch
