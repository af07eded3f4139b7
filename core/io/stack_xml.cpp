#include "core/io/stack_xml.h"

#include "core/image/image_io.h"

#include <pugixml.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

namespace oversketch {
namespace {

constexpr int kFurthest = 10'000'000;

Error wrong(const std::string& what) {
  return {"project.damaged", "this part of the file is damaged: " + what, ""};
}

std::optional<double> read_number(const pugi::xml_node& node, const char* name, double when_absent) {
  const pugi::xml_attribute attribute = node.attribute(name);
  if (!attribute) return when_absent;
  const std::string_view text = attribute.value();
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<int> read_whole(const pugi::xml_node& node, const char* name, int low, int when_absent) {
  const auto value = read_number(node, name, when_absent);
  if (!value || *value < low || *value > kFurthest || *value != std::floor(*value))
    return wrong("\"" + std::string(name) + "\" is no whole number that a picture may have");
  return static_cast<int>(*value);
}

class Reader {
public:
  explicit Reader(const IoLimits& limits) : limits_(limits) {}

  Result<std::vector<StackNode>> read_children(const pugi::xml_node& stack, int depth) {
    if (depth > limits_.xml_depth)
      return Error{"project.too-large",
                   "its groups lie in groups more than " + std::to_string(limits_.xml_depth) + " deep", ""};
    std::vector<StackNode> nodes;
    for (const pugi::xml_node& child : stack.children()) {
      const std::string_view kind = child.name();
      if (kind != "layer" && kind != "stack") continue;
      if (++count_ > limits_.entries)
        return Error{"project.too-large", "it has more than " + std::to_string(limits_.entries) + " layers", ""};
      auto node = read_node(child, depth);
      if (!node) return node.error();
      nodes.push_back(std::move(*node));
    }
    // The file names the uppermost first.
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }

private:
  Result<StackNode> read_node(const pugi::xml_node& xml, int depth) {
    StackNode node;
    node.name = xml.attribute("name").value();
    node.is_group = std::string_view(xml.name()) == "stack";
    const auto x = read_whole(xml, "x", -kFurthest, 0), y = read_whole(xml, "y", -kFurthest, 0);
    if (!x) return x.error();
    if (!y) return y.error();
    node.x = *x, node.y = *y;
    const auto opacity = read_number(xml, "opacity", 1);
    if (!opacity || *opacity < 0 || *opacity > 1) return wrong("an opacity is not from 0 to 1");
    node.opacity = *opacity;
    node.visible = std::string_view(xml.attribute("visibility").as_string("visible")) != "hidden";
    node.composite_op = xml.attribute("composite-op").as_string("svg:src-over");
    if (node.is_group) {
      auto children = read_children(xml, depth + 1);
      if (!children) return children.error();
      node.children = std::move(*children);
    } else {
      node.source = xml.attribute("src").value();
      if (node.source.empty()) return wrong("a layer has no \"src\"");
    }
    return node;
  }

  const IoLimits& limits_;
  std::int64_t count_ = 0;
};

std::string print_number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void print_node(pugi::xml_node parent, const StackNode& node) {
  pugi::xml_node xml = parent.append_child("layer");
  xml.append_attribute("name") = node.name.c_str();
  xml.append_attribute("src") = node.source.c_str();
  xml.append_attribute("x") = node.x;
  xml.append_attribute("y") = node.y;
  xml.append_attribute("opacity") = print_number(node.opacity).c_str();
  xml.append_attribute("visibility") = node.visible ? "visible" : "hidden";
  xml.append_attribute("composite-op") = node.composite_op.c_str();
}

} // namespace

std::string print_stack(const Stack& stack) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node image = document.append_child("image");
  image.append_attribute("version") = "0.0.5";
  image.append_attribute("w") = stack.width;
  image.append_attribute("h") = stack.height;
  pugi::xml_node layers = image.append_child("stack");
  for (auto node = stack.layers.rbegin(); node != stack.layers.rend(); ++node)
    print_node(layers, *node);
  std::ostringstream text;
  document.save(text, " ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

Result<Stack> parse_stack(std::string_view xml, const IoLimits& limits) {
  if (xml.size() > limits.xml_bytes)
    return Error{"project.too-large", "it has more than " + std::to_string(limits.xml_bytes) + " bytes", ""};
  pugi::xml_document document;
  const auto parsed = document.load_buffer(xml.data(), xml.size(), pugi::parse_default | pugi::parse_doctype);
  if (!parsed) return wrong(std::string("at byte ") + std::to_string(parsed.offset) + ": " + parsed.description());
  for (const pugi::xml_node& node : document.children())
    if (node.type() == pugi::node_doctype) return wrong("it declares a document type, which is not read");
  const pugi::xml_node image = document.child("image");
  if (!image) return wrong("it describes no image");
  const auto width = read_whole(image, "w", 1, 0), height = read_whole(image, "h", 1, 0);
  if (!width) return width.error();
  if (!height) return height.error();
  if (std::int64_t{*width} * *height > kMaxPixels)
    return Error{"project.too-large",
                 "the picture is said to have " + std::to_string(*width) + " × " + std::to_string(*height) + " pixels",
                 ""};
  auto layers = Reader(limits).read_children(image.child("stack"), 1);
  if (!layers) return layers.error();
  return Stack{*width, *height, std::move(*layers)};
}

} // namespace oversketch
