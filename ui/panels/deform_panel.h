#pragma once

#include "ui/panels/panel_parts.h"

#include <string>
#include <utility>
#include <vector>

namespace oversketch {

struct DeformModel {
  /// Of the selected layer; none without one.
  std::optional<LayerSettings> settings;
  bool has_region = false;
  /// "0 folded · σ 1.06 · 21 ms".
  std::string summary;
  std::vector<double> energies;
  std::optional<Metrics> metrics;
  int flipped = 0;
  StageTimes times;
  std::vector<AlternativeSnapshot> alternatives;
};

DeformModel make_deform_model(const Snapshot& snapshot);

/// What the panel keeps from frame to frame.
struct DeformPanelState {
  /// What was last asked of the session, and of which tab.
  bool alternatives_wanted = false;
  const void* asked = nullptr;
};

/// "deform.method.flipfree|paper|initial", "deform.follow", "deform.stiffness", "deform.cell", "deform.weight",
/// "deform.iterations", "deform.energy", "deform.numbers.flipped" …, "deform.alternative.0" ….
/// @param tab  whose document it is; only ever compared.
void draw_deform_panel(const DeformModel& model, DeformPanelState& state, const void* tab, Pictures& pictures,
                       const DrawContext& context);

} // namespace oversketch
