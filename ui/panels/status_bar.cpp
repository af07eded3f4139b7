#include "ui/panels/status_bar.h"

#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace oversketch {
namespace {

std::string whole_ms(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, ms < 9.95 ? "%.1f" : "%.0f", ms);
  return text;
}

std::string size_text(const ShownPicture& picture) {
  if (picture.pixels == nullptr) return {};
  return std::to_string(picture.pixels->width()) + " × " + std::to_string(picture.pixels->height());
}

const LayerSnapshot* selected_layer(const Snapshot& snapshot) {
  return snapshot.document.selected ? snapshot.find(*snapshot.document.selected) : nullptr;
}

/// One field: its text, and what it means when the pointer rests on it.
bool draw_field(const DrawContext& context, const char* id, std::string_view text, const Tip& tip, ImVec2 corner,
                ImVec2 end, PackedColor color, float align = 0) {
  if (text.empty() || end.x - corner.x < 1) return false;
  const IdScope scope(id);
  ImGui::SetCursorScreenPos(corner);
  const bool clicked = ImGui::InvisibleButton("##field", ImVec2(end.x - corner.x, end.y - corner.y));
  draw_text(corner, end, color, text, align);
  finish_item(context, id, tip);
  return clicked;
}

/// The progress and its button, at the right; gives back where they begin.
float draw_activity(const StatusModel& model, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  float right = area.high.x - look.px(10);
  if (!model.activity.busy) return right;
  const bool narrow = area.width() < look.px(560);
  ImGui::SetCursorScreenPos(ImVec2(right - look.px(60), area.low.y + (area.height() - look.px(18)) / 2));
  if (draw_button(context, "status.cancel", "Cancel",
                  {"Stops what is being computed; the document stays as it was.", {}}, {.width = 60, .height = 18}))
    context.sink.emit(action::CancelWork{});
  right -= look.px(70);
  const float width = look.px(narrow ? 40 : 110), height = look.px(4);
  const ImVec2 low(right - width, (area.low.y + area.high.y - height) / 2);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(low, ImVec2(right, low.y + height), look.raised, height / 2);
  // Not known how far: a piece that wanders.
  const double done = model.activity.done;
  const auto phase = static_cast<float>(std::fmod(context.now_s, 1.6) / 1.6);
  const float from = done >= 0 ? 0 : std::max(0.0F, phase * 1.3F - 0.3F);
  const float to = done >= 0 ? static_cast<float>(std::min(done, 1.0)) : std::min(1.0F, phase * 1.3F);
  list->AddRectFilled(ImVec2(low.x + from * width, low.y), ImVec2(low.x + to * width, low.y + height), look.accent,
                      height / 2);
  register_box(context, "status.progress", low, ImVec2(right, low.y + height));
  context.reply.ask_frame_at(context.now_s + 0.05);
  right -= width + look.px(10);
  if (narrow) return right;
  const float label = std::min(ImGui::CalcTextSize(model.activity.label.c_str()).x + 1, look.px(220));
  draw_text(ImVec2(right - label, area.low.y), ImVec2(right, area.high.y), look.ink_quiet, model.activity.label, 1);
  return right - label - look.px(16);
}

} // namespace

std::string describe_solve(const LayerSnapshot& layer) {
  if (layer.deformation == nullptr) return {};
  std::string text = std::to_string(layer.deformation->vertices) + " vertices";
  double match = 0, rest = 0;
  for (const auto& [stage, ms] : layer.deformation->times.stages_ms)
    (stage == "match" ? match : rest) += ms;
  if (match > 0) text += " · match " + whole_ms(match);
  text += " · solve " + whole_ms(rest);
  if (layer.blend_ms > 0) text += " · blend " + whole_ms(layer.blend_ms);
  return text + " ms";
}

StatusModel make_status_model(const EditorState& state, const Snapshot* snapshot, const LiveSession::Activity& activity,
                              const std::optional<PointerPlace>& pointer, std::string_view hint, double now_s) {
  StatusModel model;
  model.activity = activity;
  model.said = !state.said.empty() && now_s < state.said_until;
  if (model.said)
    model.line = state.said;
  else
    model.line = snapshot != nullptr ? std::string(hint) : "Open a picture to begin, or drop one on the window";
  if (snapshot == nullptr || state.tab() == nullptr) return model;

  const LayerSnapshot* layer = selected_layer(*snapshot);
  const Side side = pointer ? pointer->side : Side::kTarget;
  const ShownPicture& picture = side == Side::kSource && layer != nullptr ? layer->source : snapshot->target;
  model.size = size_text(picture);
  char text[64];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * state.tab()->view.canvas(side).view.zoom);
  model.zoom = text;
  if (pointer && picture.pixels != nullptr && pointer->picture.x >= 0 && pointer->picture.y >= 0 &&
      pointer->picture.x < picture.pixels->width() && pointer->picture.y < picture.pixels->height()) {
    std::snprintf(text, sizeof text, "%.0f, %.0f", std::floor(pointer->picture.x), std::floor(pointer->picture.y));
    model.position = text;
  }
  if (layer != nullptr) model.solve = describe_solve(*layer);
  return model;
}

void draw_status_bar(const StatusModel& model, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(area.low, area.high, look.panel);
  list->AddRectFilled(area.low, ImVec2(area.high.x, area.low.y + look.px(1)), look.line);
  float right = draw_activity(model, area, context);
  float x = area.low.x + look.px(12);
  const auto put = [&](const char* id, std::string_view text, float width, const Tip& tip) {
    const bool clicked = draw_field(context, id, text, tip, ImVec2(x, area.low.y),
                                    ImVec2(std::min(right, x + look.px(width)), area.high.y), look.ink);
    x += look.px(width);
    return clicked;
  };
  const bool wide = area.width() >= look.px(760);
  if (!model.size.empty()) {
    if (wide)
      put("status.position", model.position, 75,
          {"The pixel under the pointer, from the picture's top left corner, px.", {}});
    if (put("status.zoom", model.zoom, 52,
            {"Screen pixels per pixel of the picture. Click shows the whole picture.", "Ctrl+0"}))
      context.sink.emit(action::Fit{Side::kTarget});
    if (wide) put("status.size", model.size, 100, {"Width and height of the picture, px.", {}});
  }
  if (wide && !model.activity.busy && !model.solve.empty()) {
    const float width = std::min(ImGui::CalcTextSize(model.solve.c_str()).x + 1, area.width() * 0.4F);
    draw_field(context, "status.solve", model.solve,
               {"The mesh that was solved, and the time of its last solve, by stage, in milliseconds.", {}},
               ImVec2(right - width, area.low.y), ImVec2(right, area.high.y), look.ink);
    right -= width + look.px(16);
  }
  draw_field(context, "status.line", model.line,
             {model.said ? model.line : "What the tool in hand does. " + model.line, {}}, ImVec2(x, area.low.y),
             ImVec2(right, area.high.y), model.said ? look.ink : mixed(look.ink, look.ink_quiet, 0.35F));
}

} // namespace oversketch
