#pragma once

#include "ui/panels/panel_parts.h"

#include <string>
#include <vector>

namespace oversketch {

struct HistoryModel {
  std::vector<std::string> labels;
  std::size_t cursor = 0;
};

HistoryModel make_history_model(const Snapshot& snapshot);

/// What the panel keeps from frame to frame: where the list has been scrolled to.
struct HistoryPanelState {
  std::size_t shown_cursor = 0;
  std::size_t shown_count = 0;
};

/// The steps, the first at the top; a click jumps.  What was undone is quiet.  "history.0", "history.1" ….
void draw_history_panel(const HistoryModel& model, HistoryPanelState& state, const DrawContext& context);

} // namespace oversketch
