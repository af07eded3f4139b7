#pragma once

#include "ui/state/shortcuts.h"
#include "ui/widgets/buttons.h"
#include "ui/widgets/pictures.h"
#include "ui/widgets/slider.h"

#include <memory>
#include <string_view>

namespace oversketch {

/// What the slider of one of `layer.set`'s numbers may be: its bounds and its start as the command table and a new
/// layer have them, the bar's ends and the unit as a hand wants them.
/// @param field  "cell_px", "stiffness", "follow", "handle_weight", "iterations", "strength", "opacity", "feather_px",
///   "screening".
SliderSpec setting_slider(std::string_view field);

/// That setting's slider; a drag is one step of the history.
/// @param put  puts the number into the command.
void draw_setting(const DrawContext& context, const char* id, const char* label, const char* tip, const char* field,
                  double value, void (*put)(LayerSet&, double));

/// A button that does what an entry of the menus does; pale where the entry is.
void draw_entry_button(const EntryContext& entries, std::string_view entry, std::string_view id, const char* icon,
                       const DrawContext& context);

/// A picture fitted into a box, in its middle, with round corners; an empty box where there is none.
void draw_picture_in(Pictures& pictures, const std::shared_ptr<const Raster<Rgba8>>& picture, ImVec2 corner, ImVec2 end,
                     const DrawContext& context);

/// Numbers two to a row, each a quiet label with its value at the right.
class NumberGrid {
public:
  explicit NumberGrid(const DrawContext& context);
  ~NumberGrid();
  NumberGrid(const NumberGrid&) = delete;
  NumberGrid& operator=(const NumberGrid&) = delete;

  void draw(std::string_view id, std::string_view label, std::string_view value, const Tip& tip, bool alarming = false);

private:
  const DrawContext& context_;
  ImVec2 corner_;
  float column_width_ = 0;
  int count_ = 0;
};

} // namespace oversketch
