#pragma once

#include "ui/widgets/item.h"

#include <span>
#include <string_view>

namespace oversketch {

struct ButtonLook {
  /// Filled with the accent: the tool in hand, the answer that Enter gives.
  bool on = false;
  bool enabled = true;
  /// Without a ground until the pointer is over it.
  bool quiet = false;
  /// Design pixels; 0 is as wide as the text needs.
  float width = 0;
  float height = 0;
  /// Draws the icon in the theme's large icons.
  bool large = false;
};

/// A button with a text or with an icon alone.  True when it was clicked.
bool draw_button(const DrawContext& context, std::string_view id, std::string_view text, const Tip& tip,
                 const ButtonLook& button = {});
bool draw_icon_button(const DrawContext& context, std::string_view id, std::string_view icon, const Tip& tip,
                      const ButtonLook& button = {});

/// A row with a label and a switch at the right.  True when it was clicked.
bool draw_toggle(const DrawContext& context, std::string_view id, std::string_view label, const Tip& tip, bool on);

/// One of a few choices side by side: what `options` call themselves, the chosen one filled.
struct Option {
  /// The widget is registered as `id` + "." + this.
  std::string_view id;
  std::string_view label;
  std::string_view tip;
};
/// @returns the option that was clicked, or −1.
int draw_segments(const DrawContext& context, std::string_view id, std::span<const Option> options, int chosen);

/// A row with its label and a list that opens; entries are registered while it is open.
/// @returns the option that was clicked, or −1.
int draw_choice(const DrawContext& context, std::string_view id, std::string_view label, const Tip& tip,
                std::span<const Option> options, int chosen);

} // namespace oversketch
