#include "ui/panels/deform_panel.h"

#include "ui/widgets/plot.h"
#include "ui/widgets/section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace oversketch {
namespace {

std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void draw_method(const LayerSettings& settings, const DrawContext& context) {
  static constexpr std::array kMethods = {
      Option{"flipfree", "Flip-free",
             "Follows the sketch and never folds over; finds by itself which point goes where."},
      Option{"paper", "Paper", "The method of the paper: a gradient descent from the initial shape; may fold."},
      Option{"initial", "Initial", "The linear start of the paper's method: rough, may fold."},
  };
  const int chosen = draw_segments(context, "deform.method", kMethods, static_cast<int>(settings.method));
  if (chosen < 0) return;
  LayerSet set;
  set.method = static_cast<DeformMethod>(chosen);
  context.sink.emit(action::Execute{set});
}

void draw_settings(const LayerSettings& settings, const DrawContext& context) {
  if (settings.method == DeformMethod::kFlipfree) {
    draw_setting(context, "deform.follow", "Follow sketch",
                 "How closely the boundary keeps to the sketch. More follows every bend, less keeps the shape calmer.",
                 "follow", settings.follow, [](LayerSet& set, double value) { set.follow = value; });
    draw_setting(context, "deform.stiffness", "Stiffness", "How much the part resists growing and shrinking in places.",
                 "stiffness", settings.stiffness, [](LayerSet& set, double value) { set.stiffness = value; });
  } else {
    draw_setting(context, "deform.weight", "Handle weight ω",
                 "The paper's ω: how hard the outline is pulled to the sketch, against keeping its shape.",
                 "handle_weight", settings.handle_weight,
                 [](LayerSet& set, double value) { set.handle_weight = value; });
  }
  if (settings.method == DeformMethod::kPaper)
    draw_setting(context, "deform.iterations", "Iterations", "Steps of the paper's gradient descent.", "iterations",
                 settings.iterations,
                 [](LayerSet& set, double value) { set.iterations = static_cast<int>(std::lround(value)); });
  draw_setting(context, "deform.cell", "Mesh cell",
               "Side of a mesh cell, source pixels. Smaller follows finer bends and takes longer.", "cell_px",
               settings.cell_px, [](LayerSet& set, double value) { set.cell_px = value; });
}

std::string describe_stages(const StageTimes& times) {
  std::string text;
  for (const auto& [stage, ms] : times.stages_ms)
    text += (text.empty() ? "" : "\n") + stage + ": " + print("%.1f ms", ms);
  return text.empty() ? "Time of the last solve." : "Time of the last solve, by stage:\n" + text;
}

/// While they are being measured a dash stands in for each, so that nothing below them moves.
void draw_numbers(const DeformModel& model, const DrawContext& context) {
  const bool known = model.metrics.has_value();
  NumberGrid grid(context);
  const auto draw = [&](const char* id, const char* label, const char* format, double value, const char* tip) {
    grid.draw(id, label, known ? print(format, value) : "–", {tip, {}});
  };
  const Metrics metrics = known ? *model.metrics : Metrics{};
  grid.draw("deform.numbers.flipped", "Folded", known ? std::to_string(model.flipped) : "–",
            {"Cells of the mesh that are turned inside out. There should be none.", {}}, model.flipped > 0);
  grid.draw("deform.numbers.time", "Time", known ? print("%.0f ms", model.times.total_ms()) : "–",
            {describe_stages(model.times), {}});
  draw("deform.numbers.sigma", "Mean σ1/σ2", "%.2f", metrics.distortion.sigma_ratio_mean,
       "How far cells are squeezed on average: longest by shortest side of what a square becomes. 1 is not at all.");
  draw("deform.numbers.worst", "Worst", "%.2f", metrics.distortion.sigma_ratio_max,
       "The same of the cell that is squeezed most.");
  draw("deform.numbers.distance", "To sketch", "%.2f px", metrics.sketch_distance.mean,
       "Mean distance between the part's boundary and the sketch, target pixels.");
  draw("deform.numbers.farthest", "Farthest", "%.1f px", metrics.sketch_distance.max,
       "Greatest distance between the part's boundary and the sketch, target pixels.");
}

void draw_alternatives(const DeformModel& model, Pictures& pictures, const DrawContext& context) {
  if (model.alternatives.empty()) return;
  const ThemeLook& look = context.look;
  ImGui::Dummy(ImVec2(1, look.px(2)));
  draw_note(context, "Ways to fit the curves");
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, gap = look.px(6);
  // All in a row: there are few, and none is to be looked for below the others.
  const auto count = static_cast<float>(model.alternatives.size());
  const float side = std::min(look.px(84), (width + gap) / count - gap);
  for (std::size_t i = 0; i < model.alternatives.size(); ++i) {
    const AlternativeSnapshot& choice = model.alternatives[i];
    const std::string id = "deform.alternative." + std::to_string(i);
    const IdScope scope(id);
    const ImVec2 corner(at.x + static_cast<float>(i) * (side + gap), at.y), end(corner.x + side, corner.y + side);
    ImGui::SetCursorScreenPos(corner);
    if (ImGui::InvisibleButton("##choice", ImVec2(side, side)) && !choice.chosen)
      context.sink.emit(action::Execute{choice.take});
    const bool hovered = ImGui::IsItemHovered();
    finish_item(context, id,
                {choice.chosen ? "How the outline lies along the sketch now."
                               : "Another way to lay the outline along the sketch. Click takes it: one pin holds it.",
                 {}});
    ImGui::GetWindowDrawList()->AddRectFilled(corner, end, look.sunken, look.px(4));
    draw_picture_in(pictures, choice.picture, corner, end, context);
    if (hovered || choice.chosen)
      ImGui::GetWindowDrawList()->AddRect(corner, end, look.accent, look.px(4), 0,
                                          look.px(choice.chosen ? 2.5F : 1.2F));
  }
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + side + gap));
}

/// Tells the session whether the other fits are looked at: they cost a solve each.
void want_alternatives(DeformPanelState& state, const void* tab, bool wanted, const DrawContext& context) {
  if (state.alternatives_wanted == wanted && state.asked == tab) return;
  if (!wanted && state.asked != tab) return;
  state = {wanted, tab};
  context.sink.emit(action::WantAlternatives{wanted});
}

} // namespace

DeformModel make_deform_model(const Snapshot& snapshot) {
  DeformModel model;
  const Document& document = snapshot.document;
  const Layer* layer = document.selected ? document.find(*document.selected) : nullptr;
  if (layer == nullptr) return model;
  model.settings = layer->settings;
  model.has_region = !layer->outline.empty();
  model.alternatives = snapshot.alternatives;
  const LayerSnapshot* derived = snapshot.find(layer->id);
  if (derived == nullptr || derived->deformation == nullptr) return model;
  model.energies = derived->deformation->energies;
  model.times = derived->deformation->times;
  model.metrics = derived->metrics;
  if (model.metrics) {
    model.flipped = model.metrics->distortion.flipped_cells;
    model.summary = std::to_string(model.flipped) + " folded · σ " +
                    print("%.2f", model.metrics->distortion.sigma_ratio_mean) + " · " +
                    print("%.0f ms", model.times.total_ms());
  }
  return model;
}

void draw_deform_panel(const DeformModel& model, DeformPanelState& state, const void* tab, Pictures& pictures,
                       const DrawContext& context) {
  const Section section(context, "panel.deformation", "Deformation", model.summary,
                        "How the part is bent to fit the sketch, and how well it went.");
  want_alternatives(state, tab, section.open() && model.has_region, context);
  if (!section.open()) return;
  if (!model.settings) return draw_note(context, "No layer is selected.");
  draw_method(*model.settings, context);
  draw_settings(*model.settings, context);
  if (!model.has_region) return draw_note(context, "Draw the outline in the source first.");
  if (model.energies.size() >= 2)
    draw_plot(context, "deform.energy",
              {"The energy after each step of the solver. It falls while the sketch weighs the same, and rises where "
               "the solver goes on to follow it more closely.",
               {}},
              model.energies,
              {.caption = "energy per step", .color = context.look.plot, .height = 46, .logarithmic = true});
  draw_numbers(model, context);
  draw_alternatives(model, pictures, context);
}

} // namespace oversketch
