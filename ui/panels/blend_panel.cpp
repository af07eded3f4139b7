#include "ui/panels/blend_panel.h"

#include "ui/widgets/plot.h"
#include "ui/widgets/section.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace oversketch {
namespace {

void execute(const DrawContext& context, const LayerSet& set) {
  context.sink.emit(action::Execute{set});
}

void draw_mode(const LayerSettings& settings, const DrawContext& context) {
  static constexpr std::array kModes = {
      Option{"import", "Import gradients",
             "The part keeps its own structure and takes the colours of its surroundings."},
      Option{"mixed", "Mixed gradients", "At each place the stronger of both structures: for parts one sees through."},
      Option{"monochrome", "Monochrome", "The part's light and dark only, in the colours of the target."},
      Option{"average", "Average", "Half of both structures."},
      Option{"none", "Plain paste", "The part as it is, without matching colours."},
  };
  const int chosen = draw_choice(context, "blend.mode", "Mode", {"How the part is joined to the target.", {}}, kModes,
                                 static_cast<int>(settings.mode));
  if (chosen < 0) return;
  LayerSet set;
  set.mode = static_cast<CloneMode>(chosen);
  execute(context, set);
}

void draw_domain(const LayerSettings& settings, const DrawContext& context) {
  static constexpr std::array kDomains = {
      Option{"encoded", "As stored", "Differences of the values as pictures store them: right nearly always."},
      Option{"linear", "Linear light", "Differences of light itself."},
      Option{"log", "Ratios", "Ratios of values: for a part that was lit much brighter or darker."},
  };
  const int chosen = draw_choice(context, "blend.domain", "Domain", {"Which values are matched.", {}}, kDomains,
                                 static_cast<int>(settings.domain));
  if (chosen < 0) return;
  LayerSet set;
  set.domain = static_cast<CloneDomain>(chosen);
  execute(context, set);
}

void draw_sampling(const LayerSettings& settings, const DrawContext& context) {
  static constexpr std::array kSamplings = {
      Option{"bilinear", "Bilinear", "Quick, a little soft where the part is enlarged."},
      Option{"bicubic", "Bicubic", "Sharper where the part is enlarged."},
  };
  const int chosen =
      draw_choice(context, "blend.sampling", "Sampling", {"How the source is read where it is bent.", {}}, kSamplings,
                  static_cast<int>(settings.sampling));
  if (chosen < 0) return;
  LayerSet set;
  set.sampling = static_cast<WarpSampling>(chosen);
  execute(context, set);
}

void draw_seldom(const LayerSettings& settings, const DrawContext& context) {
  const LayerSettings start;
  const bool changed =
      settings.screening != start.screening || settings.domain != start.domain || settings.sampling != start.sampling;
  if (!draw_more(context, "blend.more", {"Screening, domain and sampling.", {}}, changed)) return;
  draw_setting(
      context, "blend.screening", "Screening",
      "How far from the edge the colour matching dies away, target pixels. Keeps a colour that bleeds in at one "
      "place from tinting the whole part; 0 matches all of it.",
      "screening", settings.screening, [](LayerSet& set, double value) { set.screening = value; });
  draw_domain(settings, context);
  draw_sampling(settings, context);
}

/// As many values as a small plot can show, each the greatest of its stretch.
std::vector<double> thinned(const std::vector<BleedSample>& samples) {
  constexpr std::size_t kMost = 160;
  std::vector<double> values(std::min(samples.size(), kMost), 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double& value = values[i * values.size() / samples.size()];
    value = std::max(value, static_cast<double>(samples[i].norm));
  }
  return values;
}

} // namespace

BlendModel make_blend_model(const Snapshot& snapshot) {
  BlendModel model;
  const Document& document = snapshot.document;
  const Layer* layer = document.selected ? document.find(*document.selected) : nullptr;
  if (layer == nullptr) return model;
  model.settings = layer->settings;
  const LayerSnapshot* derived = snapshot.find(layer->id);
  if (derived == nullptr) return model;
  if (derived->bleed != nullptr) model.mismatch = thinned(derived->bleed->samples);
  if (!(derived->blend_ms > 0)) return model;
  char text[64];
  std::snprintf(text, sizeof text, derived->blend_ms < 9.95 ? "%.1f ms a move" : "%.0f ms a move", derived->blend_ms);
  model.summary = text;
  return model;
}

void draw_blend_panel(const BlendModel& model, const DrawContext& context) {
  const Section section(context, "panel.blending", "Blending", model.summary,
                        "How the part's colours are matched to what surrounds it.");
  if (!section.open()) return;
  if (!model.settings) return draw_note(context, "No layer is selected.");
  draw_mode(*model.settings, context);
  draw_setting(context, "blend.strength", "Strength", "How much of the colour matching is applied, %.", "strength",
               model.settings->strength, [](LayerSet& set, double value) { set.strength = value; });
  draw_setting(context, "blend.feather", "Feather",
               "With a strength below 100 %, or a plain paste: over how many target pixels it sets in.", "feather_px",
               model.settings->feather_px, [](LayerSet& set, double value) { set.feather_px = value; });
  draw_seldom(*model.settings, context);
  if (model.mismatch.size() >= 2)
    draw_plot(
        context, "blend.mismatch",
        {"How far the colours of part and target differ along the boundary, 8-bit levels: peaks will tint the part.",
         {}},
        model.mismatch,
        {.caption = "colour mismatch along the boundary",
         .color = context.look.warning,
         .height = 42,
         .from_zero = true});
}

} // namespace oversketch
