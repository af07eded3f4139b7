#pragma once

#include "core/geometry/point.h"
#include "core/image/image.h"
#include "core/image/raster.h"

#include <cstdint>
#include <span>
#include <vector>

namespace oversketch::cli {

/// An opaque colour from its usual notation, 0xRRGGBB; `alpha` 0…1.
Rgba color_of(std::uint32_t rgb, double alpha = 1);

/// A picture that is drawn on with antialiasing; the same calls give the same bits.  Pixels; colours are mixed as they
/// are encoded.
class Canvas {
public:
  Canvas(int width, int height, Rgba paper);

  int width() const { return pixels_.width(); }
  int height() const { return pixels_.height(); }
  const Raster<Rgba>& pixels() const { return pixels_; }
  Raster<Rgba> take() && { return std::move(pixels_); }

  /// What keeps alpha as it is: what is drawn shows only where something is already.
  enum class Mix { kOver, kAtop };

  /// The inside of all rings together by the nonzero-winding rule.  A pixel takes the part of its area that is inside:
  /// exact along x, from 16 lines along y.
  /// @cost about 50 ns for each crossing of an edge with one of those lines.
  void fill(std::span<const Points> rings, Rgba color, Mix mix = Mix::kOver);
  void fill(const Points& ring, Rgba color, Mix mix = Mix::kOver);

  /// A line with round joins and ends; overlaps of it with itself are not drawn twice.
  void stroke(const Points& line, double width, bool closed, Rgba color, Mix mix = Mix::kOver);
  /// Many separate lines with square ends, overlaps drawn once.
  void stroke_segments(std::span<const Points> segments, double width, Rgba color, Mix mix = Mix::kOver);
  void disc(Point centre, double radius, Rgba color);
  /// An upright cross with arms of that length.
  void cross(Point centre, double arm, double width, Rgba color);
  /// From `tail` to `head`, with a filled point.
  void arrow(Point tail, Point head, double width, Rgba color);
  void rectangle(double x, double y, double width, double height, Rgba color);

  /// A picture with its top left pixel at (x, y), over what is there; what hangs out is left off.
  void draw(const Raster<Rgba>& picture, int x, int y);

private:
  void mix(int x, int y, const Rgba& color, float coverage, Mix mix);

  Raster<Rgba> pixels_;
};

/// A regular polygon that stands for a circle, wound like the segments of a stroke.
Points circle_ring(Point centre, double radius);

} // namespace oversketch::cli
