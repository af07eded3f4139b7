#pragma once

#include "ui/widgets/item.h"

#include <span>
#include <string_view>
#include <vector>

namespace oversketch {

struct PlotLook {
  std::string_view caption = {};
  PackedColor color = 0;
  /// Design pixels.
  float height = 48;
  /// The scale goes by factors, for energies that fall by orders of magnitude; values ≤ 0 stand at the bottom.
  bool logarithmic = false;
  /// The scale begins at 0 and not at the least value.
  bool from_zero = false;
};

/// Values as one small line across the panel, its caption above it; the tip tells the value under the pointer.
/// Fewer than two finite values are an empty box.
void draw_plot(const DrawContext& context, std::string_view id, const Tip& tip, std::span<const double> values,
               const PlotLook& plot);

/// Heights of the values in a plot, 0 at the bottom … 1 at the top; what is not finite counts as the least value.
std::vector<float> plot_heights(std::span<const double> values, const PlotLook& plot);

} // namespace oversketch
