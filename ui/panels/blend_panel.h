#pragma once

#include "ui/panels/panel_parts.h"

#include <string>
#include <vector>

namespace oversketch {

struct BlendModel {
  /// Of the selected layer; none without one.
  std::optional<LayerSettings> settings;
  /// "0.6 ms a move".
  std::string summary;
  /// How far the colours differ along the boundary, 8-bit levels; empty while it is not known.
  std::vector<double> mismatch;
};

BlendModel make_blend_model(const Snapshot& snapshot);

/// "blend.mode", "blend.mode.import" …, "blend.strength", "blend.domain", "blend.feather", "blend.mismatch".
void draw_blend_panel(const BlendModel& model, const DrawContext& context);

} // namespace oversketch
