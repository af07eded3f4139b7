#include "ui/panels/layers_panel.h"

#include "ui/panels/thumbnail.h"
#include "ui/theme/icons.h"
#include "ui/widgets/section.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace oversketch {
namespace {

constexpr float kLayerRow = 46, kThumbnailWidth = 46, kThumbnailHeight = 34;
constexpr int kThumbnail_px = 96;

void draw_row_ground(ImVec2 at, ImVec2 end, bool selected, bool hovered, const DrawContext& context) {
  const ThemeLook& look = context.look;
  if (!selected && !hovered) return;
  ImGui::GetWindowDrawList()->AddRectFilled(at, end, selected ? look.selected : mixed(look.panel, look.raised, 0.6F),
                                            look.px(4));
}

void draw_eye(const LayerRow& row, ImVec2 at, ImVec2 end, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const float side = look.px(26);
  ImGui::SetCursorScreenPos(ImVec2(end.x - side - look.px(2), at.y + (end.y - at.y - side) / 2));
  if (draw_icon_button(context, "layer." + to_string(row.id) + ".visible", row.visible ? icon::kEye : icon::kEyeOff,
                       {row.visible ? "Hides the layer." : "Shows the layer.", {}},
                       {.quiet = true, .width = 26, .height = 26})) {
    LayerSet set;
    set.layer = row.id;
    set.visible = !row.visible;
    context.sink.emit(action::Execute{set});
  }
}

void end_renaming(const LayerRow& row, LayersPanelState& state, WindowFlags& flags, bool take,
                  const DrawContext& context) {
  flags.renaming.reset();
  if (take && !state.name.empty() && state.name != row.name)
    context.sink.emit(action::Execute{LayerRename{row.id, state.name}});
}

void draw_name_field(const LayerRow& row, LayersPanelState& state, WindowFlags& flags, ImVec2 at, float width,
                     const DrawContext& context) {
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + (context.look.px(kLayerRow) - ImGui::GetFrameHeight()) / 2));
  ImGui::SetNextItemWidth(width);
  if (flags.rename_starts) {
    state.name = row.name;
    give_keys_to_next_field(context);
  }
  const bool entered =
      ImGui::InputText("##name", &state.name, ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
  finish_item(context, "layer." + to_string(row.id) + ".name", {"The layer's name. Enter takes it, Esc does not.", {}});
  if (compat::is_key_pressed(ImGuiKey_Escape, false))
    end_renaming(row, state, flags, false, context);
  else if (entered || (ImGui::IsItemDeactivated() && !flags.rename_starts))
    end_renaming(row, state, flags, true, context);
  if (flags.rename_starts) context.reply.ask_frame_at(context.now_s);
  flags.rename_starts = false;
}

void draw_row(const LayerRow& row, LayersPanelState& state, const EntryContext& entries, Pictures& pictures,
              const DrawContext& context) {
  const ThemeLook& look = context.look;
  const std::string id = "layer." + to_string(row.id);
  const IdScope scope(id);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + std::max(1.0F, ImGui::GetContentRegionAvail().x), at.y + look.px(kLayerRow));
  const bool renaming = entries.flags.renaming == row.id;
  const bool over = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(at, end);
  draw_row_ground(at, end, row.selected, over, context);
  // Eye and name field take the pointer before the row does.
  draw_eye(row, at, end, context);
  const float x = at.x + look.px(8 + kThumbnailWidth + 10), right = end.x - look.px(32);
  if (renaming) draw_name_field(row, state, entries.flags, ImVec2(x - look.px(6), at.y), right - x, context);

  ImGui::SetCursorScreenPos(at);
  const bool clicked = ImGui::InvisibleButton("##row", ImVec2(end.x - at.x, end.y - at.y));
  const bool hovered = ImGui::IsItemHovered();
  if (ImGui::IsItemActive() && std::abs(ImGui::GetMouseDragDelta(0, look.px(5)).y) > 0) state.dragged = row.id;
  finish_item(context, id,
              {"Click selects, double-click renames, dragging changes the order." +
                   (row.note.empty() ? std::string() : "\nStill to do: " + row.note + "."),
               {}});
  if (hovered && ImGui::IsMouseDoubleClicked(0)) {
    entries.flags.renaming = row.id;
    entries.flags.rename_starts = true;
  } else if (clicked && !state.dragged && !row.selected) {
    context.sink.emit(action::Execute{LayerSelect{row.id}});
  }

  const float top = at.y + (end.y - at.y - look.px(kThumbnailHeight)) / 2;
  draw_picture_in(pictures, row.thumbnail, ImVec2(at.x + look.px(8), top),
                  ImVec2(at.x + look.px(8 + kThumbnailWidth), top + look.px(kThumbnailHeight)), context);
  if (!renaming) {
    const PackedColor ink = !row.visible   ? look.ink_quiet
                            : row.selected ? look.ink
                                           : mixed(look.ink, look.ink_quiet, 0.3F);
    if (row.note.empty()) {
      draw_text(ImVec2(x, at.y), ImVec2(right, end.y), ink, row.name);
    } else {
      draw_text(ImVec2(x, at.y + look.px(5)), ImVec2(right, at.y + look.px(24)), ink, row.name);
      draw_text(ImVec2(x, at.y + look.px(22)), ImVec2(right, end.y - look.px(5)), look.ink_quiet, row.note);
    }
  }
  ImGui::SetCursorScreenPos(ImVec2(at.x, end.y));
}

void draw_target_row(const LayersModel& model, LayersPanelState& state, Pictures& pictures,
                     const DrawContext& context) {
  const ThemeLook& look = context.look;
  if (model.target.pixels != nullptr &&
      (state.target_thumbnail == nullptr || state.target_content != model.target.content)) {
    state.target_thumbnail = make_thumbnail(*model.target.pixels, kThumbnail_px);
    state.target_content = model.target.content;
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + std::max(1.0F, ImGui::GetContentRegionAvail().x), at.y + look.px(kLayerRow));
  if (ImGui::InvisibleButton("##target", ImVec2(end.x - at.x, end.y - at.y))) {
  }
  finish_item(context, "layer.target", {"The picture that everything goes into: " + model.target_name, {}});
  const float top = at.y + (end.y - at.y - look.px(kThumbnailHeight)) / 2;
  draw_picture_in(pictures, state.target_thumbnail, ImVec2(at.x + look.px(8), top),
                  ImVec2(at.x + look.px(8 + kThumbnailWidth), top + look.px(kThumbnailHeight)), context);
  draw_text(ImVec2(at.x + look.px(18 + kThumbnailWidth), at.y), ImVec2(end.x - look.px(8), end.y),
            mixed(look.ink, look.ink_quiet, 0.3F), "target");
  ImGui::SetCursorScreenPos(ImVec2(at.x, end.y + look.px(4)));
}

/// The line where a dragged row would go; drops it when the button is let go.
void follow_row_drag(const LayersModel& model, LayersPanelState& state, float top, const DrawContext& context) {
  if (!state.dragged) return;
  const ThemeLook& look = context.look;
  const auto rows = static_cast<int>(model.rows.size());
  const float place = std::round((ImGui::GetIO().MousePos.y - top) / look.px(kLayerRow));
  const int to = std::clamp(static_cast<int>(place), 0, rows);
  const ImVec2 at(ImGui::GetCursorScreenPos().x, top + look.px(kLayerRow) * static_cast<float>(to));
  ImGui::GetWindowDrawList()->AddRectFilled(
      ImVec2(at.x, at.y - look.px(1)), ImVec2(at.x + ImGui::GetContentRegionAvail().x, at.y + look.px(1)), look.accent);
  if (ImGui::IsMouseDown(0)) return;
  const LayerId id = *state.dragged;
  state.dragged.reset();
  const auto row = std::ranges::find(model.rows, id, &LayerRow::id);
  if (row == model.rows.end()) return;
  const int index = order_after_drop(model, row->index, to);
  if (index != row->index) context.sink.emit(action::Execute{LayerOrder{id, index}});
}

void draw_buttons(const EntryContext& entries, const DrawContext& context) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, step = context.look.px(28);
  draw_entry_button(entries, "layer.add", "layer.add", icon::kPlus, context);
  ImGui::SetCursorScreenPos(ImVec2(at.x + step, at.y));
  draw_entry_button(entries, "layer.add_target", "layer.add_target", icon::kClone, context);
  ImGui::SetCursorScreenPos(ImVec2(at.x + 2 * step, at.y));
  draw_entry_button(entries, "layer.raise", "layer.raise", icon::kArrowUp, context);
  ImGui::SetCursorScreenPos(ImVec2(at.x + 3 * step, at.y));
  draw_entry_button(entries, "layer.lower", "layer.lower", icon::kArrowDown, context);
  ImGui::SetCursorScreenPos(ImVec2(at.x + width - context.look.px(24), at.y));
  draw_entry_button(entries, "layer.remove", "layer.remove", icon::kTrash, context);
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + context.look.px(26)));
}

} // namespace

LayersModel make_layers_model(const Snapshot& snapshot) {
  LayersModel model;
  model.target = snapshot.target;
  model.target_name = std::filesystem::path(snapshot.document.target.name).filename().string();
  const auto& layers = snapshot.document.layers;
  for (int i = static_cast<int>(layers.size()) - 1; i >= 0; --i) {
    const Layer& layer = layers[static_cast<std::size_t>(i)];
    LayerRow row{layer.id, layer.name, i, snapshot.document.selected == layer.id, layer.settings.visible, {}, nullptr};
    if (layer.outline.empty()) row.note = "no outline yet";
    if (const LayerSnapshot* derived = snapshot.find(layer.id)) row.thumbnail = derived->thumbnail;
    if (row.selected) model.opacity = layer.settings.opacity;
    model.rows.push_back(std::move(row));
  }
  return model;
}

int order_after_drop(const LayersModel& model, int dragged_index, int place) {
  // Above `place` rows from the top lie the higher ones; the dragged one itself leaves its place.
  const int count = static_cast<int>(model.rows.size());
  const int below = count - place;
  return std::clamp(dragged_index < below ? below - 1 : below, 0, std::max(count - 1, 0));
}

void draw_layers_panel(const LayersModel& model, LayersPanelState& state, const EntryContext& entries,
                       Pictures& pictures, const DrawContext& context) {
  const Section section(context, "panel.layers", "Layers", std::to_string(model.rows.size() + 1),
                        "The pasted parts, the highest first, and the picture they go into.");
  if (!section.open()) return;
  if (entries.flags.renaming &&
      std::ranges::find(model.rows, *entries.flags.renaming, &LayerRow::id) == model.rows.end())
    entries.flags.renaming.reset();
  const float top = ImGui::GetCursorScreenPos().y;
  for (const LayerRow& row : model.rows)
    draw_row(row, state, entries, pictures, context);
  follow_row_drag(model, state, top, context);
  draw_target_row(model, state, pictures, context);
  if (model.opacity) {
    const SliderChange change = draw_slider(context, "layer.opacity", "Opacity",
                                            {"How much of the selected layer covers what lies below, %.", {}},
                                            *model.opacity, setting_slider("opacity"));
    emit_slider(context.sink, change, [](double value) {
      LayerSet set;
      set.opacity = value;
      return set;
    });
  }
  draw_buttons(entries, context);
}

} // namespace oversketch
