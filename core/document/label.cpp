#include "core/document/command.h"

#include "core/document/command_table.h"

#include <filesystem>

namespace oversketch {
namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// A number as a label shows it: at most two decimals, no trailing zeros.
std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find('.') + 3);
  while (text.back() == '0')
    text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

const Layer* touched(const LayerRef& ref, const Document& document) {
  if (ref) return document.find(*ref);
  return document.selected ? document.find(*document.selected) : nullptr;
}

std::string name_of_layer(const LayerRef& ref, const Document& document) {
  const Layer* layer = touched(ref, document);
  return layer == nullptr ? "" : " " + layer->name;
}

std::string detail(const DocumentNew& c, const Document&) {
  return c.target ? " " + file_name(c.target->name)
                  : " canvas " + std::to_string(*c.width) + " × " + std::to_string(*c.height);
}
std::string detail(const TargetSet& c, const Document&) {
  return " to " + file_name(c.target.name);
}
std::string detail(const LayerAdd&, const Document& after) {
  return after.layers.empty() ? "" : " " + after.layers.back().name;
}
std::string detail(const LayerMove& c, const Document&) {
  return " " + std::to_string(c.by.x) + ", " + std::to_string(c.by.y);
}
std::string detail(const LayerSelect& c, const Document& after) {
  return name_of_layer(c.layer, after);
}
std::string detail(const LayerRename& c, const Document&) {
  return " to " + c.name;
}
std::string detail(const LayerTransform& c, const Document&) {
  std::string text;
  if (c.rotate_deg != 0) text += " " + number(c.rotate_deg) + "°";
  if (c.scale != 1) text += " × " + number(c.scale);
  return text;
}
template <class C>
std::string detail(const C&, const Document&) {
  return "";
}

std::string pins_dropped(const Document& before, const Document& after) {
  std::size_t had = 0, has = 0;
  for (const Layer& layer : before.layers)
    had += layer.pins.size();
  for (const Layer& layer : after.layers)
    has += layer.pins.size();
  const std::size_t lost = had > has ? had - has : 0;
  return lost == 0 ? "" : " (" + std::to_string(lost) + (lost == 1 ? " pin" : " pins") + " dropped)";
}

/// The setting a LayerSet changes, when it is one: "Settings: mode".
std::string settings_changed(const LayerSet& c) {
  const std::pair<bool, std::string_view> given[] = {
      {c.method.has_value(), "method"},       {c.cell_px.has_value(), "mesh cell"},
      {c.stiffness.has_value(), "stiffness"}, {c.follow.has_value(), "follow"},
      {c.handle_weight.has_value(), "ω"},     {c.iterations.has_value(), "iterations"},
      {c.sampling.has_value(), "sampling"},   {c.mode.has_value(), "blend mode"},
      {c.strength.has_value(), "strength"},   {c.domain.has_value(), "domain"},
      {c.visible.has_value(), "visibility"},  {c.opacity.has_value(), "opacity"},
      {c.feather_px.has_value(), "feather"},  {c.screening.has_value(), "screening"}};
  std::string text;
  for (const auto& [is, word] : given)
    if (is) text += (text.empty() ? ": " : ", ") + std::string(word);
  return text;
}

} // namespace

std::string label_of(const Command& command, const Document& before, const Document& after) {
  const auto compose = [&](const auto& c) {
    using C = std::remove_cvref_t<decltype(c)>;
    std::string text(label_word(command));
    if constexpr (std::is_same_v<C, PinAdd> || std::is_same_v<C, PinMove>)
      if (c.match) return std::string("Other match");
    if constexpr (std::is_same_v<C, LayerSet>)
      text += settings_changed(c);
    else if constexpr (std::is_same_v<C, LayerRemove>)
      text += name_of_layer(c.layer, before);
    else
      text += detail(c, after);
    if constexpr (std::is_same_v<C, RegionSet> || std::is_same_v<C, SketchSet> || std::is_same_v<C, SketchReset> ||
                  std::is_same_v<C, RegionEdit> || std::is_same_v<C, SketchEdit>)
      text += pins_dropped(before, after);
    return text;
  };
  return std::visit(compose, command);
}

} // namespace oversketch
