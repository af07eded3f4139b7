#include "core/document/apply_parts.h"

#include "core/document/command_table.h"

namespace oversketch {

Result<Layer*> find_layer(Document& document, const LayerRef& ref) {
  if (!ref && !document.selected)
    return Error{"layer.none-selected", "no layer is selected: add one with layer.add, or name one with \"layer\"", ""};
  const LayerId id = ref ? *ref : *document.selected;
  for (Layer& layer : document.layers)
    if (layer.id == id) return &layer;
  return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
}

Result<Document> apply(const Document& document, const Command& command) {
  if (auto in_range = check_values(command); !in_range) return in_range.error();
  if (document.empty() && !std::holds_alternative<DocumentNew>(command))
    return Error{"document.none", "there is no document yet: begin with document.new", ""};
  Document changed = document;
  const Result<void> done = std::visit([&](const auto& c) { return run(changed, c); }, command);
  if (!done) return done.error();
  return changed;
}

std::vector<ImageRef*> images_of(Command& command) {
  std::vector<ImageRef*> refs;
  const auto ask = [&](ImageRef& ref) {
    if (ref.name != kTargetName) refs.push_back(&ref);
  };
  if (auto* c = std::get_if<DocumentNew>(&command); c && c->target) ask(*c->target);
  if (auto* c = std::get_if<TargetSet>(&command)) ask(c->target);
  if (auto* c = std::get_if<LayerAdd>(&command)) ask(c->source);
  return refs;
}

std::vector<ImageRef*> images_to_load(Command& command) {
  std::vector<ImageRef*> refs = images_of(command);
  std::erase_if(refs, [](const ImageRef* ref) { return ref->image.has_value(); });
  return refs;
}

} // namespace oversketch
