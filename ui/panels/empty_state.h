#pragma once

#include "ui/panels/window_layout.h"
#include "ui/state/editor_state.h"
#include "ui/widgets/draw_context.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oversketch {

struct EmptyStateModel {
  std::vector<RecoveredWork> recovered;
  std::vector<std::filesystem::path> recent;
};

EmptyStateModel make_empty_state_model(const EditorState& state);

/// What stands where the canvases would: what to do, a button that opens, the sample, what was open before, and work
/// that an earlier run left behind.  "empty.open", "empty.sample", "empty.recent.0", "empty.recovered.0.take",
/// "empty.recovered.0.discard".
void draw_empty_state(const EmptyStateModel& model, const Area& area, const DrawContext& context);

} // namespace oversketch
