#pragma once

#include "ui/panels/panel_parts.h"

#include <string>
#include <vector>

namespace oversketch {

/// A key and what it does with the tool in hand.
struct ToolKey {
  std::string_view key;
  std::string_view what;
};

struct ToolModel {
  Tool tool = Tool::kSketch;
  std::string title;
  /// Strokes are drawn with it, so that smoothing and tolerance matter.
  bool draws = false;
  Preferences preferences;
  std::vector<ToolKey> keys;
  std::size_t pins = 0;
};

ToolModel make_tool_model(const EditorState& state, const Snapshot& snapshot);

/// "tool.smoothing.none", "tool.smoothing.basic", "tool.smoothing.stabiliser", "tool.tolerance", "tool.reset_sketch",
/// "tool.remove_pin".
void draw_tool_panel(const ToolModel& model, const EntryContext& entries, const DrawContext& context);

/// The choice of smoothing and the slider of the tolerance: here and among the preferences.
/// @param prefix  of the widgets' names.
/// @returns whether something was changed.
bool draw_stroke_options(const DrawContext& context, std::string_view prefix, Preferences& preferences);

} // namespace oversketch
