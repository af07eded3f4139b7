// The commands that change the document's pictures and its stack of layers.

#include "core/document/apply_parts.h"
#include "core/document/layer_settings.h"

#include <algorithm>
#include <filesystem>

namespace oversketch {
namespace {

Image make_canvas(int width, int height, const Color& color) {
  const auto level = [&](std::size_t i) { return static_cast<float>(color.rgb[i] / 255.0); };
  return Image(Raster<Rgba>(width, height, {level(0), level(1), level(2), 1}));
}

/// "@target" is a source alone: replayed, a target of that name would be nothing.
Result<void> check_target(const ImageRef& ref) {
  if (ref.name != kTargetName) return {};
  return Error{"target.itself",
               "\"@target\" names the target where a source is asked for; a target is a picture's path", ""};
}

const Image& loaded(const ImageRef& ref) {
  CHECK(ref.image.has_value(), "an image that was not loaded before the command was applied");
  return *ref.image;
}

} // namespace

Result<void> run(Document& document, const DocumentNew& c) {
  if (c.target && (c.width || c.height || c.color))
    return Error{"document.size", "a target picture has its own size and colours: leave width, height and color out",
                 ""};
  if (!c.target && (!c.width || !c.height))
    return Error{"document.size", "give a target picture, or width and height", ""};
  document = Document{};
  if (c.target) {
    if (auto other = check_target(*c.target); !other) return other;
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
  if (auto other = check_target(c.target); !other) return other;
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

Result<void> run(Document& document, const LayerSet& c) {
  const auto found = find_layer(document, c.layer);
  if (!found) return found.error();
  const int given = assign_settings((*found)->settings, c);
  if (given == 0) return Error{"command.nothing-to-do", "\"layer.set\" needs at least one setting", ""};
  return {};
}

} // namespace oversketch
