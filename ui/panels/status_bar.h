#pragma once

#include "ui/panels/window_layout.h"
#include "ui/state/editor_state.h"
#include "ui/widgets/draw_context.h"

#include <optional>
#include <string>
#include <string_view>

namespace oversketch {

/// Where the pointer is on a picture.
struct PointerPlace {
  Side side = Side::kTarget;
  Point picture;
};

struct StatusModel {
  /// "812, 508", the pixel under the pointer; empty beside the pictures.
  std::string position;
  std::string zoom;
  /// "1440 × 1080", of the picture under the pointer, else the target.
  std::string size;
  /// What was said last, or what the tool in hand does.
  std::string line;
  /// The line was said, and is no hint.
  bool said = false;
  /// "980 vertices · match 8 · solve 18 · blend 2 ms".
  std::string solve;
  LiveSession::Activity activity;
};

/// @param hint  of the tool in hand.
StatusModel make_status_model(const EditorState& state, const Snapshot* snapshot, const LiveSession::Activity& activity,
                              const std::optional<PointerPlace>& pointer, std::string_view hint, double now_s);

/// Times of the last solve and painting of a layer; empty while nothing was solved.
std::string describe_solve(const LayerSnapshot& layer);

/// "status.position", "status.zoom" (click fits), "status.size", "status.line", "status.solve", "status.cancel".
void draw_status_bar(const StatusModel& model, const Area& area, const DrawContext& context);

} // namespace oversketch
