#pragma once

#include "core/geometry/point.h"
#include "ui/canvas/view.h"
#include "ui/theme/theme.h"

#include <imgui.h>

#include <span>

namespace oversketch {

/// A canvas to paint on: takes pixels of its picture, leaves out what lies outside.
struct CanvasPaint {
  ImDrawList& list;
  const ThemeLook& look;
  View view;
  /// Window pixels.
  ImVec2 corner;
  ImVec2 end;

  ImVec2 at(Point picture) const {
    const Point p = view.to_canvas(picture);
    return {corner.x + static_cast<float>(p.x), corner.y + static_cast<float>(p.y)};
  }
  bool shows(ImVec2 p, float margin) const {
    return p.x >= corner.x - margin && p.y >= corner.y - margin && p.x <= end.x + margin && p.y <= end.y + margin;
  }

  /// Widths, lengths and radii are design pixels.
  void line(std::span<const Point> points, bool closed, PackedColor color, float width) const;
  /// A light core in a dark halo: visible on every picture.
  void haloed_line(std::span<const Point> points, bool closed, PackedColor color, float width) const;
  void dashed_line(std::span<const Point> points, bool closed, PackedColor color, float width, float dash) const;
  void dot(Point center, PackedColor color, float radius) const;
  void ring(Point center, PackedColor color, float radius, float width) const;
};

/// The colour of a place on the curves: a fraction of the outline's length, round the colour circle.
PackedColor fraction_color(double fraction);

/// The colour of a value in 0…1, from calm to alarming: blue, green, yellow, red.
PackedColor heat_color(double value);

} // namespace oversketch
