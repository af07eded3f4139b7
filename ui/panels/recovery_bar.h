#pragma once

#include "ui/panels/window_layout.h"
#include "ui/state/editor_state.h"
#include "ui/widgets/draw_context.h"

#include <string>

namespace oversketch {

struct RecoveryBarModel {
  /// "Not saved when the program last ended: puffer (today 14:03)"; empty where nothing is offered.
  std::string text;
  /// How many documents the button opens.
  std::size_t documents = 0;
};

/// Nothing is offered beside an empty state, which offers it itself, nor once it was left for another time.
/// @param beside_work  a document is shown.
RecoveryBarModel make_recovery_bar_model(const EditorState& state, bool beside_work);

/// Work that an earlier run left behind, in a line over the canvases: "recovery.take" opens all of it, "recovery.later"
/// leaves it for the next start.
void draw_recovery_bar(const RecoveryBarModel& model, const Area& area, const DrawContext& context);

/// Design pixels of the bar that says what could not be opened: a line a file, up to five, the last of
/// which counts those that have none; 0 where all went well.
float notice_height(const std::string& notice);
/// "panel.notice", and "notice.close", which takes it away.
void draw_notice_bar(const std::string& notice, const Area& area, const DrawContext& context);

} // namespace oversketch
