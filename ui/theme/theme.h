#pragma once

#include "ui/state/preferences.h"

#include <cstdint>

struct ImFont;

namespace oversketch {

/// A colour as Dear ImGui packs it (IM_COL32).
using PackedColor = std::uint32_t;

/// Fonts, colours and measures of the window, for one theme and one scale.  Quiet greys, one accent.
struct ThemeLook {
  Theme theme = Theme::kDark;
  /// Screen pixels per design pixel: the display's scale times the preference.
  float scale = 1;

  ImFont* text = nullptr;
  ImFont* bold = nullptr;
  /// Text and icons share fonts: icons are the code points in icons.h, merged into `text` and, larger, on their own.
  ImFont* icons_large = nullptr;

  /// Behind panels and in rows of tabs; panels and bars; fields and buttons; plots and lists; lines between panels;
  /// behind pictures.
  PackedColor window = 0;
  PackedColor panel = 0;
  PackedColor raised = 0;
  PackedColor sunken = 0;
  PackedColor line = 0;
  PackedColor canvas = 0;
  /// A field under the pointer; the filled part of a slider; the chosen row of a list.
  PackedColor hovered = 0;
  PackedColor filled = 0;
  PackedColor selected = 0;
  PackedColor ink = 0;
  PackedColor ink_quiet = 0;
  PackedColor accent = 0;
  /// What is written on the accent.
  PackedColor accent_ink = 0;
  /// The line of a plot.
  PackedColor plot = 0;
  PackedColor warning = 0;
  PackedColor danger = 0;
  /// Curves on pictures: a light core in a dark halo, visible on everything.
  PackedColor curve = 0;
  PackedColor curve_halo = 0;
  /// The stroke in hand, and the part it would replace.
  PackedColor stroke = 0;
  PackedColor ghost = 0;

  float px(float design_px) const { return design_px * scale; }
};

/// Design pixels.
inline constexpr float kTextSize = 14, kIconSize = 17;

/// Colours and measures; fonts are still to be loaded (fonts.h).
/// @param scale  positive.
ThemeLook make_look(Theme theme, float scale);

/// Sets Dear ImGui's style of the present context to that look.
void apply_style(const ThemeLook& look);

/// The same colour, `alpha` 0…1 times as opaque.
PackedColor faded(PackedColor color, float alpha);

} // namespace oversketch
