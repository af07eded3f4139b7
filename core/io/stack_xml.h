#pragma once

// OpenRaster's stack.xml: which pictures lie over each other, and where.  (Specification: "OpenRaster", freedesktop
// create project, 0.0.5.)

#include "core/base/result.h"
#include "core/io/limits.h"

#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

/// The part of an OpenRaster file that holds the whole picture.
inline constexpr const char* kMergedPart = "mergedimage.png";

/// A picture, or a group of such; its place is that of its top left corner in the whole picture.
struct StackNode {
  std::string name;
  /// Name of the archive's part; empty for a group.
  std::string source;
  int x = 0;
  int y = 0;
  double opacity = 1;
  bool visible = true;
  std::string composite_op = "svg:src-over";
  /// Of a group, lowest first.
  std::vector<StackNode> children;
  bool is_group = false;
};

struct Stack {
  int width = 0;
  int height = 0;
  /// Lowest first.
  std::vector<StackNode> layers;
};

std::string print_stack(const Stack& stack);

/// @errors project.damaged (with what is wrong), project.too-large (size, number or depth of layers): document types
/// and
///   entities of their own are refused; `where` is empty.
Result<Stack> parse_stack(std::string_view xml, const IoLimits& limits);

} // namespace oversketch
