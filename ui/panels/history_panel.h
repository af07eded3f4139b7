#pragma once

#include "ui/panels/panel_parts.h"

#include <span>
#include <string>

namespace oversketch {

struct HistoryModel {
  /// The snapshot's own.
  std::span<const std::string> labels;
  std::size_t cursor = 0;
};

/// @param snapshot  must outlive the model.
HistoryModel make_history_model(const Snapshot& snapshot);

/// What the panel keeps from frame to frame: whether it is unfolded, and where the list has been scrolled to.
struct HistoryPanelState {
  bool open = true;
  std::size_t shown_cursor = 0;
  std::size_t shown_count = 0;
  float shown_rows = 0;
};

/// In which the title and, unfolded, a few steps can be seen, screen pixels.
float least_history_height(const HistoryModel& model, const HistoryPanelState& state, const ThemeLook& look);

/// The steps, the first at the top; a click jumps.  What was undone is quiet.  "history.0", "history.1" ….
void draw_history_panel(const HistoryModel& model, HistoryPanelState& state, const DrawContext& context);

} // namespace oversketch
