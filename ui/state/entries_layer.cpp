#include "ui/state/entry_row.h"

#include <algorithm>
#include <array>

namespace oversketch {
namespace {

using C = const EntryContext&;

constexpr EntryRow layer(std::string_view id, std::string_view label, void (*act)(C), std::string_view help) {
  return make_row(Menu::kLayer, id, label, act, help);
}

const Layer* selected(C c) {
  const Document* document = c.snapshot == nullptr ? nullptr : &c.snapshot->document;
  return document == nullptr || !document->selected ? nullptr : document->find(*document->selected);
}
bool has_layer(C c) {
  return selected(c) != nullptr;
}
bool has_region(C c) {
  return has_layer(c) && !selected(c)->outline.empty();
}
bool has_pin(C c) {
  return has_layer(c) && c.state.tab() != nullptr && c.state.tab()->view.selected_pin.has_value();
}

void add_target(C c) {
  c.sink.emit(action::AddSource{std::string(kTargetName)});
}

int index_of_selected(C c) {
  const auto& layers = c.snapshot->document.layers;
  const auto found = std::ranges::find(layers, *c.snapshot->document.selected, &Layer::id);
  return static_cast<int>(found - layers.begin());
}
bool can_raise(C c) {
  return has_layer(c) && index_of_selected(c) + 1 < static_cast<int>(c.snapshot->document.layers.size());
}
bool can_lower(C c) {
  return has_layer(c) && index_of_selected(c) > 0;
}
void raise_layer(C c) {
  c.sink.emit(action::Execute{LayerOrder{{}, index_of_selected(c) + 1}});
}
void lower_layer(C c) {
  c.sink.emit(action::Execute{LayerOrder{{}, index_of_selected(c) - 1}});
}

bool is_visible(C c) {
  return has_layer(c) && selected(c)->settings.visible;
}
void toggle_visible(C c) {
  LayerSet set;
  set.visible = !is_visible(c);
  c.sink.emit(action::Execute{set});
}
void rename(C c) {
  c.flags.renaming = selected(c)->id;
  c.flags.rename_starts = true;
  c.flags.side_shown() = true;
}
void reset_sketch(C c) {
  c.sink.emit(action::Execute{SketchReset{}});
}
void remove_pin(C c) {
  c.sink.emit(action::Execute{PinRemove{{}, *c.state.tab()->view.selected_pin}});
}
void remove_layer(C c) {
  c.sink.emit(action::Execute{LayerRemove{}});
}

} // namespace

std::span<const EntryRow> layer_entries() {
  static constexpr std::array kRows = {
      layer("layer.add", "Add source image…", emit<action::AddSource>, "A picture to take a part from: a new layer.")
          .keys(ctrl_shift('O'))
          .when(has_target),
      layer("layer.add_target", "Add layer from the target", add_target,
            "A new layer that takes its part from the target itself.")
          .when(has_target),
      layer("layer.rename", "Rename", rename, "The selected layer.").keys(plain(Key::kF2)).when(has_layer).below_line(),
      layer("layer.visible", "Visible", toggle_visible, "Whether the selected layer is drawn.")
          .when(has_layer)
          .mark(is_visible),
      layer("layer.raise", "Raise", raise_layer, "Over the layer above it.").keys(ctrl(']')).when(can_raise),
      layer("layer.lower", "Lower", lower_layer, "Under the layer below it.").keys(ctrl('[')).when(can_lower),
      layer("layer.reset_sketch", "Reset sketch", reset_sketch,
            "Makes the sketch the outline again, where the layer stands.")
          .when(has_region)
          .below_line(),
      layer("layer.remove_pin", "Remove pin", remove_pin, "The selected pin.").when(has_pin),
      layer("layer.remove", "Remove layer", remove_layer, "The selected layer; undo brings it back.")
          .when(has_layer)
          .below_line(),
  };
  return kRows;
}

} // namespace oversketch
