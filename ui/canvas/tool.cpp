#include "ui/canvas/tool.h"

namespace oversketch {

const Layer* selected_layer(const Document& document) {
  return document.selected ? document.find(*document.selected) : nullptr;
}

} // namespace oversketch
