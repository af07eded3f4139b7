// The commands that change a layer's curves, pins and place.

#include "core/document/apply_parts.h"

#include "core/document/pins.h"
#include "core/document/redraw.h"

#include "core/geometry/curve.h"
#include "core/geometry/point_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oversketch {
namespace {

/// Largest shift of a layer, target px: far beyond any picture, well within an int.
constexpr int kFurthest = 1 << 20;

/// Smallest and largest scale that a placement may reach.
constexpr double kLeastScale = 1e-3, kMostScale = 1e3;

Error no_region(const Layer& layer) {
  return {"layer.no-region", "set the region's outline first", "layer " + to_string(layer.id)};
}

/// The outline within the source picture.
Result<void> check_inside(const Layer& layer) {
  const Image& source = layer.source.image;
  for (const Point p : layer.outline)
    if (p.x < 0 || p.y < 0 || p.x > source.width() || p.y > source.height())
      return Error{"region.outside-source",
                   "the outline leaves its picture at " + point_text(p) + ": the picture is " +
                       std::to_string(source.width()) + " × " + std::to_string(source.height()) + " px",
                   ""};
  return {};
}

/// Where a region is first shown: where it lies in its source when that is wholly inside the target, else in the
/// middle.
Placement first_placement(const Points& outline, const Image& target) {
  const Box box = bounds(outline);
  if (box.low.x >= 0 && box.low.y >= 0 && box.high.x <= target.width() && box.high.y <= target.height()) return {};
  const Point shift = Point{target.width() / 2.0, target.height() / 2.0} - box.centre();
  return make_placement({1.0, {std::floor(shift.x), std::floor(shift.y)}});
}

OversketchOptions stroke_options(StrokeSide side, double tolerance_px, bool sharp) {
  OversketchOptions options;
  options.tolerance_px = tolerance_px;
  options.side = side == StrokeSide::kOther ? OversketchSide::kOther : OversketchSide::kAuto;
  options.sharp = sharp;
  return options;
}

} // namespace

Result<void> run(Document& document, const RegionSet& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  auto outline = check_closed_curve(c.outline, "outline");
  if (!outline) return outline.error();
  const bool first = layer.outline.empty();
  const bool sketch_is_outline = layer.sketch == layer.outline;
  if (first) layer.placement = first_placement(*outline, document.target.image);
  layer.outline = std::move(*outline);
  if (auto inside = check_inside(layer); !inside) return inside;
  if (sketch_is_outline) layer.sketch = layer.outline;
  carry_pins(layer);
  return check_pin_order(layer);
}

Result<void> run(Document& document, const RegionEdit& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (layer.outline.empty()) return no_region(layer);
  const bool sketch_is_outline = layer.sketch == layer.outline;
  const auto done =
      redraw(layer, &Layer::outline, &Pin::outline, c.stroke, stroke_options(c.side, c.tolerance_px, c.sharp));
  if (!done) return done;
  if (auto inside = check_inside(layer); !inside) return inside;
  if (sketch_is_outline) layer.sketch = layer.outline, carry_pins(layer);
  return check_pin_order(layer);
}

Result<void> run(Document& document, const SketchSet& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (layer.outline.empty()) return no_region(layer);
  auto curve = check_closed_curve(c.curve, "sketch");
  if (!curve) return curve.error();
  layer.sketch = transformed(*curve, layer.placement.to_target().inverse());
  carry_pins(layer);
  return check_pin_order(layer);
}

Result<void> run(Document& document, const SketchEdit& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (layer.outline.empty()) return no_region(layer);
  const Rect picture = document.target.image.rect();
  const bool outside = std::none_of(c.stroke.begin(), c.stroke.end(), [&](Point p) {
    return p.x >= 0 && p.y >= 0 && p.x <= picture.width && p.y <= picture.height;
  });
  if (outside && !c.stroke.empty())
    return Error{"sketch.outside-target", "the stroke lies outside the picture: nothing was changed", ""};
  const Similarity from_target = layer.placement.to_target().inverse();
  const double tolerance = c.tolerance_px * std::abs(from_target.factor);
  return redraw(layer, &Layer::sketch, &Pin::sketch, transformed(c.stroke, from_target),
                stroke_options(c.side, tolerance, c.sharp));
}

Result<void> run(Document& document, const SketchReset& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (layer.outline.empty()) return no_region(layer);
  layer.sketch = layer.outline;
  carry_pins(layer);
  return check_pin_order(layer);
}

Result<void> run(Document& document, const PinAdd& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (layer.outline.empty()) return no_region(layer);
  const PinId id{document.next_pin++};
  layer.pins.push_back(
      {id, snap_to(layer.outline, c.outline), snap_to(layer.sketch, layer.placement.to_target().inverse()(c.sketch))});
  return check_pin_order(layer);
}

Result<void> run(Document& document, const PinMove& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (!c.outline && !c.sketch) return Error{"pin.nothing-to-move", "give \"outline\", \"sketch\" or both", ""};
  const auto pin = std::find_if(layer.pins.begin(), layer.pins.end(), [&](const Pin& p) { return p.id == c.pin; });
  if (pin == layer.pins.end()) return unknown_pin(layer, c.pin);
  if (c.outline) pin->outline = snap_to(layer.outline, *c.outline);
  if (c.sketch) pin->sketch = snap_to(layer.sketch, layer.placement.to_target().inverse()(*c.sketch));
  return check_pin_order(layer);
}

Result<void> run(Document& document, const PinRemove& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (std::erase_if(layer.pins, [&](const Pin& p) { return p.id == c.pin; }) == 0) return unknown_pin(layer, c.pin);
  return {};
}

Result<void> run(Document& document, const LayerMove& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Placement& placement = (*found)->placement;
  const std::int64_t x = std::int64_t{placement.dx} + c.by.x, y = std::int64_t{placement.dy} + c.by.y;
  if (std::abs(x) > kFurthest || std::abs(y) > kFurthest)
    return Error{"transform.range", "that would put the layer more than a million pixels away", ""};
  placement.dx = static_cast<int>(x);
  placement.dy = static_cast<int>(y);
  return {};
}

Result<void> run(Document& document, const LayerTransform& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  if (layer.outline.empty()) return no_region(layer);
  const std::complex<double> about = to_complex(c.about.value_or(bounds(layer.sketch_in_target()).centre()));
  const std::complex<double> factor = std::polar(c.scale, c.rotate_deg * std::numbers::pi / 180);
  const Similarity placed = Similarity{factor, about - factor * about}.after(layer.placement.to_target());
  const double scale = std::abs(placed.factor);
  if (!(scale >= kLeastScale && scale <= kMostScale))
    return Error{"transform.range", "the layer's scale must stay between 0.001 and 1000", ""};
  if (!(std::abs(placed.offset.real()) <= kFurthest && std::abs(placed.offset.imag()) <= kFurthest))
    return Error{"transform.range", "that would put the layer more than a million pixels away", ""};
  layer.placement = make_placement(placed);
  return {};
}

} // namespace oversketch
