#pragma once

#include "ui/canvas/canvas_input.h"
#include "ui/canvas/overlays.h"
#include "ui/state/editor_state.h"
#include "ui/widgets/draw_context.h"
#include "ui/widgets/pictures.h"

#include <imgui.h>

#include <string_view>

namespace oversketch {

/// What the canvases keep from frame to frame.
struct CanvasesState {
  CanvasInput input;
  OverlayCache overlays;
  /// Names the comparison's pixels for the textures.
  ShownPicture compared;
};

/// The canvases: source, splitter and target, or the target alone when it is its own source or nothing is selected;
/// with the result, what is compared with it, the overlays, the tool in hand, and how both are looked at.
///
/// Takes the events that belong to the canvases, and the keys L S P V H (held: for the while), Space, X, [, ], Esc,
/// Enter, Delete, arrows, Ctrl+0, Ctrl+1, +, − and \; asks for everything by actions.  Draws in a child of the present
/// ImGui window, between `corner` and `end`, window pixels.
/// @threads the window's.
void draw_canvases(const EditorState& state, CanvasesState& canvases, Pictures& pictures, const InputEvents& events,
                   ImVec2 corner, ImVec2 end, const DrawContext& context);

/// What a tool does, in a line: "Sketch: draw the boundary the region shall take; draw over a part to change it".
std::string_view tool_summary(Tool tool);

} // namespace oversketch
