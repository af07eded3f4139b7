#include "ui/panels/panel_parts.h"

#include "core/base/check.h"
#include "core/document/command_table.h"

#include <algorithm>

namespace oversketch {
namespace {

/// Bounds from the command table, so that no slider offers what is refused.
void take_bounds(std::string_view field, SliderSpec& spec) {
  static const std::vector<CommandInfo> table = command_table();
  const auto command = std::ranges::find(table, "layer.set", &CommandInfo::name);
  const auto found = std::ranges::find(command->fields, field, &FieldInfo::name);
  CHECK(found != command->fields.end(), "a setting that layer.set does not have");
  spec.least = found->low;
  spec.most = found->high;
}

SliderSpec bar_of(std::string_view field) {
  const LayerSettings start;
  if (field == "follow") return {.low = 0.5, .high = 500, .initial = start.follow, .logarithmic = true};
  if (field == "stiffness") return {.low = 0.01, .high = 10, .initial = start.stiffness, .logarithmic = true};
  if (field == "cell_px") return {.low = 4, .high = 40, .initial = start.cell_px, .unit = "px"};
  if (field == "handle_weight") return {.low = 0.01, .high = 100, .initial = start.handle_weight, .logarithmic = true};
  if (field == "iterations")
    return {.low = 0, .high = 200, .initial = static_cast<double>(start.iterations), .whole = true};
  if (field == "strength") return {.initial = start.strength, .factor = 100, .unit = "%"};
  if (field == "opacity") return {.initial = start.opacity, .factor = 100, .unit = "%"};
  if (field == "feather_px") return {.low = 0, .high = 60, .initial = start.feather_px, .unit = "px"};
  if (field == "screening") return {.low = 0, .high = 200, .initial = start.screening, .unit = "px"};
  CHECK(false, "a setting without a slider");
  return {};
}

} // namespace

SliderSpec setting_slider(std::string_view field) {
  SliderSpec spec = bar_of(field);
  take_bounds(field, spec);
  return spec;
}

void draw_setting(const DrawContext& context, const char* id, const char* label, const char* tip, const char* field,
                  double value, void (*put)(LayerSet&, double)) {
  const SliderChange change = draw_slider(context, id, label, {tip, {}}, value, setting_slider(field));
  emit_slider(context.sink, change, [put](double to) {
    LayerSet set;
    put(set, to);
    return set;
  });
}

void draw_entry_button(const EntryContext& entries, std::string_view name, std::string_view id, const char* icon,
                       const DrawContext& context) {
  const Entry& entry = entry_of(name);
  const Tip tip{std::string(entry.label) + ". " + std::string(entry.help), keys_of(entry)};
  if (draw_icon_button(context, id, icon, tip, {.enabled = is_enabled(entry, entries), .quiet = true}))
    entry.act(entries);
}

void draw_picture_in(Pictures& pictures, const std::shared_ptr<const Raster<Rgba8>>& picture, ImVec2 corner, ImVec2 end,
                     const DrawContext& context) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ThemeLook& look = context.look;
  if (picture == nullptr || picture->empty()) {
    list->AddRectFilled(corner, end, look.sunken, look.px(2));
    return;
  }
  const float w = end.x - corner.x, h = end.y - corner.y;
  const auto pw = static_cast<float>(picture->width()), ph = static_cast<float>(picture->height());
  const float scale = std::min({w / pw, h / ph});
  const ImVec2 low(corner.x + (w - scale * pw) / 2, corner.y + (h - scale * ph) / 2);
  const ImVec2 high(low.x + scale * pw, low.y + scale * ph);
  const ImTextureID texture = pictures.small(picture);
  if (texture) list->AddImageRounded(texture, low, high, ImVec2(0, 0), ImVec2(1, 1), IM_COL32_WHITE, look.px(2));
}

NumberGrid::NumberGrid(const DrawContext& context)
    : context_(context),
      corner_(ImGui::GetCursorScreenPos()),
      column_width_(std::max(1.0F, (ImGui::GetContentRegionAvail().x - context.look.px(18)) / 2)) {}

NumberGrid::~NumberGrid() {
  const auto rows = static_cast<float>((count_ + 1) / 2);
  ImGui::SetCursorScreenPos(ImVec2(corner_.x, corner_.y + rows * context_.look.px(20)));
}

void NumberGrid::draw(std::string_view id, std::string_view label, std::string_view value, const Tip& tip,
                      bool alarming) {
  const IdScope scope(id);
  const ThemeLook& look = context_.look;
  const auto column = static_cast<float>(count_ % 2), row = static_cast<float>(count_ / 2);
  const ImVec2 at(corner_.x + column * (column_width_ + look.px(18)), corner_.y + row * look.px(20));
  const ImVec2 end(at.x + column_width_, at.y + look.px(20));
  ++count_;
  ImGui::SetCursorScreenPos(at);
  ImGui::InvisibleButton("##number", ImVec2(end.x - at.x, end.y - at.y));
  finish_item(context_, id, tip);
  const float used = std::min(ImGui::CalcTextSize(label.data(), label.data() + label.size()).x, column_width_ * 0.65F);
  draw_text(at, ImVec2(at.x + used + 1, end.y), look.ink_quiet, label);
  draw_text(ImVec2(at.x + used + look.px(6), at.y), end, alarming ? look.danger : look.ink, value, 1);
}

} // namespace oversketch
