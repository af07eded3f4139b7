#pragma once

#include "ui/panels/panel_parts.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

struct LayerRow {
  LayerId id;
  std::string name;
  /// Index in the document: 0 the lowest.
  int index = 0;
  bool selected = false;
  bool visible = true;
  /// What is still to be done for it: "no outline yet"; empty when it is complete.
  std::string note;
  std::shared_ptr<const Raster<Rgba8>> thumbnail;
};

struct LayersModel {
  /// The highest first, as they are drawn.
  std::vector<LayerRow> rows;
  std::string target_name;
  ShownPicture target;
  /// Of the selected layer.
  std::optional<double> opacity;
};

LayersModel make_layers_model(const Snapshot& snapshot);

/// What the panel keeps from frame to frame.
struct LayersPanelState {
  std::string name;
  std::optional<LayerId> dragged;
  Hash target_content;
  std::shared_ptr<const Raster<Rgba8>> target_thumbnail;
};

/// Where a row that is dropped goes: the index it gets in the document.
/// @param place  rows from the top, 0 … rows.size(): between which two it is let go.
int order_after_drop(const LayersModel& model, int dragged_index, int place);

/// "layer.L1", "layer.L1.visible", "layer.L1.name", "layer.target", "layer.opacity", "layer.add", "layer.add_target",
/// "layer.raise", "layer.lower", "layer.remove".
void draw_layers_panel(const LayersModel& model, LayersPanelState& state, const EntryContext& entries,
                       Pictures& pictures, const DrawContext& context);

} // namespace oversketch
