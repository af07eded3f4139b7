#pragma once

#include "ui/canvas/paint.h"
#include "ui/canvas/tool.h"

#include <string_view>

namespace oversketch {

/// Draws what the tool in hand shows on one side.
void draw_tool(const CanvasPaint& paint, Side side, const ToolDrawing& drawing);

/// "Source · pufferfish.png · 162 %" on a dark plate at the canvas's upper left corner; shortened where it does not
/// fit.
void draw_caption(const CanvasPaint& paint, std::string_view text);

/// The hint at the canvas's lower edge, keys in brackets as key caps; nothing where it does not fit.
/// @param text  "Draw over a part to change it  [X] other side".
void draw_hint(const CanvasPaint& paint, std::string_view text);

} // namespace oversketch
