#include "core/document/command.h"

#include "core/document/command_table.h"
#include "core/document/pins.h"

#include "core/geometry/curve.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace oversketch {
namespace {

/// Largest shift of a layer, target px: far beyond any picture, well within an int.
constexpr int kFurthest = 1 << 20;
/// Smallest and largest scale that a placement may reach.
constexpr double kLeastScale = 1e-3, kMostScale = 1e3;

std::string coordinates(Point p) {
  const auto number = [](double x) {
    std::string text = std::to_string(std::round(x * 10) / 10);
    return text.substr(0, text.find('.') + 2);
  };
  return "(" + number(p.x) + ", " + number(p.y) + ")";
}

/// The layer a command speaks of, in a document that may be changed.
Result<Layer*> find_layer(Document& document, const LayerRef& ref) {
  if (!ref && !document.selected)
    return Error{"layer.none-selected", "no layer is selected: add one with layer.add, or name one with \"layer\"", ""};
  const LayerId id = ref ? *ref : *document.selected;
  for (Layer& layer : document.layers)
    if (layer.id == id) return &layer;
  return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
}

Error no_region(const Layer& layer) {
  return {"layer.no-region", "set the region's outline first", "layer " + to_string(layer.id)};
}

Image make_canvas(int width, int height, const Color& color) {
  const auto level = [&](std::size_t i) { return static_cast<float>(color.rgb[i] / 255.0); };
  return Image(Raster<Rgba>(width, height, {level(0), level(1), level(2), 1}));
}

const Image& loaded(const ImageRef& ref) {
  CHECK(ref.image.has_value(), "an image that was not loaded before the command was applied");
  return *ref.image;
}

Result<void> run(Document& document, const DocumentNew& c) {
  if (c.target && (c.width || c.height || c.color))
    return Error{"document.size", "give a target picture, or width and height, not both", ""};
  if (!c.target && (!c.width || !c.height))
    return Error{"document.size", "give a target picture, or width and height", ""};
  document = Document{};
  if (c.target) {
    document.target = {c.target->name, loaded(*c.target)};
    return {};
  }
  constexpr std::int64_t kMostPixels = 200'000'000;
  if (std::int64_t{*c.width} * *c.height > kMostPixels)
    return Error{"document.size", "a canvas may have at most 200 megapixels", ""};
  document.target = {"", make_canvas(*c.width, *c.height, c.color.value_or(Color{{255, 255, 255}}))};
  return {};
}

Result<void> run(Document& document, const TargetSet& c) {
  document.target = {c.target.name, loaded(c.target)};
  return {};
}

Result<void> run(Document& document, const LayerAdd& c) {
  Layer layer;
  layer.id = {document.next_layer++};
  const bool from_target = c.source.name == kTargetName;
  layer.source = {c.source.name, from_target ? document.target.image : loaded(c.source)};
  layer.name = c.name.value_or(from_target ? "target" : std::filesystem::path(c.source.name).stem().string());
  document.selected = layer.id;
  document.layers.push_back(std::move(layer));
  return {};
}

Result<void> run(Document& document, const LayerRemove& c) {
  const auto layer = find_layer(document, c.layer);
  if (!layer) return layer.error();
  const auto index = *layer - document.layers.data();
  const bool was_selected = document.selected == (*layer)->id;
  document.layers.erase(document.layers.begin() + index);
  if (was_selected) {
    document.selected.reset();
    if (!document.layers.empty())
      document.selected = document.layers[static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, index - 1))].id;
  }
  return {};
}

Result<void> run(Document& document, const LayerSelect& c) {
  const auto layer = find_layer(document, c.layer);
  if (!layer) return layer.error();
  document.selected = (*layer)->id;
  return {};
}

Result<void> run(Document& document, const LayerRename& c) {
  const auto layer = find_layer(document, c.layer);
  if (!layer) return layer.error();
  (*layer)->name = c.name;
  return {};
}

Result<void> run(Document& document, const LayerOrder& c) {
  const auto layer = find_layer(document, c.layer);
  if (!layer) return layer.error();
  if (c.to < 0 || c.to >= static_cast<int>(document.layers.size()))
    return Error{"layer.index", "\"to\" must be from 0 to " + std::to_string(document.layers.size() - 1), ""};
  const auto from = document.layers.begin() + (*layer - document.layers.data());
  const auto to = document.layers.begin() + c.to;
  if (from < to)
    std::rotate(from, from + 1, to + 1);
  else
    std::rotate(to, from, from + 1);
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

Result<void> run(Document& document, const RegionSet& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  Layer& layer = **found;
  auto outline = check_closed_curve(c.outline, "outline");
  if (!outline) return outline.error();
  const Image& source = layer.source.image;
  for (const Point p : *outline)
    if (p.x < 0 || p.y < 0 || p.x > source.width() || p.y > source.height())
      return Error{"region.outside-source",
                   "the outline leaves its picture at " + coordinates(p) + ": the picture is " +
                       std::to_string(source.width()) + " × " + std::to_string(source.height()) + " px",
                   ""};
  const bool first = layer.outline.empty();
  const bool sketch_is_outline = layer.sketch == layer.outline;
  if (first) layer.placement = first_placement(*outline, document.target.image);
  layer.outline = std::move(*outline);
  if (sketch_is_outline) layer.sketch = layer.outline;
  carry_pins(layer);
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

template <class T>
int assign(T& setting, const std::optional<T>& value) {
  if (!value) return 0;
  setting = *value;
  return 1;
}

Result<void> run(Document& document, const LayerSet& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  LayerSettings& s = (*found)->settings;
  const int given = assign(s.method, c.method) + assign(s.cell_px, c.cell_px) + assign(s.stiffness, c.stiffness) +
                    assign(s.follow, c.follow) + assign(s.handle_weight, c.handle_weight) +
                    assign(s.iterations, c.iterations) + assign(s.mode, c.mode) + assign(s.strength, c.strength) +
                    assign(s.domain, c.domain) + assign(s.visible, c.visible) + assign(s.opacity, c.opacity) +
                    assign(s.feather_px, c.feather_px);
  if (given == 0) return Error{"command.nothing-to-do", "\"layer.set\" needs at least one setting", ""};
  return {};
}

} // namespace

Result<Document> apply(const Document& document, const Command& command) {
  if (auto in_range = check_values(command); !in_range) return in_range.error();
  if (document.empty() && !std::holds_alternative<DocumentNew>(command))
    return Error{"document.none", "there is no document yet: begin with document.new", ""};
  Document changed = document;
  const Result<void> done = std::visit([&](const auto& c) { return run(changed, c); }, command);
  if (!done) return done.error();
  return changed;
}

std::vector<ImageRef*> images_to_load(Command& command) {
  std::vector<ImageRef*> refs;
  const auto ask = [&](ImageRef& ref) {
    if (!ref.image && ref.name != kTargetName) refs.push_back(&ref);
  };
  if (auto* c = std::get_if<DocumentNew>(&command); c && c->target) ask(*c->target);
  if (auto* c = std::get_if<TargetSet>(&command)) ask(c->target);
  if (auto* c = std::get_if<LayerAdd>(&command)) ask(c->source);
  return refs;
}

} // namespace oversketch
