#pragma once

#include <imgui.h>

namespace oversketch {

/// A rectangle of the window, screen pixels.
struct Area {
  ImVec2 low;
  ImVec2 high;
  float width() const { return high.x - low.x; }
  float height() const { return high.y - low.y; }
  bool empty() const { return width() <= 0 || height() <= 0; }
};

/// Where everything stands.  The areas cover the window and do not overlap, the side panel over narrow canvases apart.
struct WindowLayout {
  Area menu;
  Area tabs;
  /// Over the canvases: what could not be opened, or what earlier runs left behind; empty where there is neither.
  Area offer;
  Area strip;
  Area canvases;
  Area side;
  Area status;
  /// Of the tool strip's buttons: two where the window is low.
  int strip_columns = 1;
  /// The window is too narrow for a side panel beside the canvases.
  bool narrow = false;
};

struct LayoutWish {
  ImVec2 size;
  /// Screen pixels per design pixel.
  float scale = 1;
  /// Design pixels.
  float side_width = 320;
  /// Wanted beside the canvases; and over them in a narrow window.
  bool side = true;
  bool side_over = false;
  bool tabs = true;
  /// Height of what stands over the canvases, design pixels.
  float offer = 0;
};

/// Below this width (design pixels) the side panel does not stand beside the canvases.
inline constexpr float kNarrow = 640;
/// Of the side panel, design pixels.
inline constexpr float kLeastSide = 240, kMostSide = 560;

WindowLayout lay_out_window(const LayoutWish& wish);

} // namespace oversketch
