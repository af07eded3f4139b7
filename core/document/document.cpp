#include "core/document/document.h"

#include <algorithm>
#include <cmath>

namespace oversketch {

std::string to_string(LayerId id) {
  return "L" + std::to_string(id.number);
}
std::string to_string(PinId id) {
  return "P" + std::to_string(id.number);
}

Similarity Placement::sub_pixel() const {
  return {factor, to_complex(offset)};
}

Similarity Placement::to_target() const {
  return {factor, {offset.x + dx, offset.y + dy}};
}

Placement make_placement(const Similarity& to_target) {
  const double x = std::floor(to_target.offset.real()), y = std::floor(to_target.offset.imag());
  Placement placement;
  placement.factor = to_target.factor;
  placement.offset = {to_target.offset.real() - x, to_target.offset.imag() - y};
  placement.dx = static_cast<int>(x);
  placement.dy = static_cast<int>(y);
  return placement;
}

const Layer* Document::find(LayerId id) const {
  const auto found = std::find_if(layers.begin(), layers.end(), [&](const Layer& layer) { return layer.id == id; });
  return found == layers.end() ? nullptr : &*found;
}

} // namespace oversketch
