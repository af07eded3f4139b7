#pragma once

#include "ui/canvas/paint.h"
#include "ui/canvas/tool.h"

#include <span>
#include <string>
#include <string_view>

namespace oversketch {

/// Draws what the tool in hand shows on one side.
void draw_tool(const CanvasPaint& paint, Side side, const ToolDrawing& drawing);

/// "Source · 162 % · pufferfish.png" on a dark plate at the canvas's upper left corner; the last parts are left out
/// where they do not fit.
void draw_caption(const CanvasPaint& paint, std::span<const std::string> parts);

/// The hint at the canvas's lower edge, keys in brackets as key caps; nothing where it does not fit.
/// @param text  "Draw over a part to change it  [X] other side".
void draw_hint(const CanvasPaint& paint, std::string_view text);

/// Letters on pictures: a dark plate and light letters on it, in either theme.
void draw_plate(const CanvasPaint& paint, ImVec2 low, ImVec2 high);
void draw_plate_text(const CanvasPaint& paint, ImVec2 at, std::string_view text);

} // namespace oversketch
