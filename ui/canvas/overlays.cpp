#include "ui/canvas/overlays.h"

#include "core/geometry/curve.h"
#include "ui/canvas/pin_tool.h"
#include "ui/canvas/tool_paint.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// Dots of the correspondence: so many, or twice, four times… as many, as long as they are this far apart on the
/// screen, so that both sides have the same ones and the larger one more.  Design px.
constexpr int kFewestDots = 24, kMostDots = 768;
constexpr double kDotSpacing = 12;

/// A mismatch that is as alarming as can be, 8-bit levels.
constexpr float kBleedScale = 100;

/// How many times their length gradients are drawn.
constexpr double kGradientScale = 10;

/// A mesh ready to be drawn on that side.
void prepare(const CanvasPaint& paint, Side side, const Layer& layer, const std::shared_ptr<const QuadMesh>& mesh,
             const std::shared_ptr<const Points>& positions, MeshCache& cache) {
  cache.update(mesh, positions);
  if (side == Side::kSource)
    project(paint, mesh->vertices, {}, cache);
  else
    project(paint, *positions, layer.placement.to_target(), cache);
}

void draw_meshes(const CanvasPaint& paint, Side side, const OverlayScene& scene, OverlayCache& cache) {
  const Overlays& shown = scene.shown;
  const auto deformation = scene.derived->deformation;
  const bool cells = shown.heat_sigma || shown.heat_area || shown.flipped;
  if ((cells || shown.display_mesh) && deformation->mesh != nullptr) {
    prepare(paint, side, scene.layer, deformation->mesh, {deformation, &deformation->positions}, cache.drawn);
    if (shown.heat_area) draw_mesh_cells(paint, cache.drawn, CellColor::kArea);
    if (shown.heat_sigma) draw_mesh_cells(paint, cache.drawn, CellColor::kSigma);
    if (shown.display_mesh) draw_mesh_edges(paint, cache.drawn, faded(paint.look.curve, 0.6f), 1);
    if (shown.flipped) draw_mesh_cells(paint, cache.drawn, CellColor::kFlipped);
  }
  if (!shown.control_mesh) return;
  const bool own = deformation->control_mesh != nullptr && deformation->control_positions != nullptr;
  const auto mesh = own ? deformation->control_mesh : deformation->mesh;
  if (mesh == nullptr) return;
  const auto positions =
      own ? deformation->control_positions : std::shared_ptr<const Points>(deformation, &deformation->positions);
  prepare(paint, side, scene.layer, mesh, positions, cache.control);
  draw_mesh_edges(paint, cache.control, faded(paint.look.accent, 0.9f), 1.25f);
}

/// The handles on the outline: its arc lengths run on the outline made clockwise, the same points in reverse order.
Points handles_on_outline(const Layer& layer, const Deformation& deformation) {
  if (deformation.flipfree == nullptr) return layer.outline;
  const ClosedCurve outline(layer.outline);
  const bool reversed = outline.signed_area() < 0;
  const double last = outline.s_at(outline.size() - 1);
  Points places;
  for (const double s : deformation.flipfree->handle_outline_s)
    places.push_back(outline.at(reversed ? last - s : s));
  return places;
}

void draw_handles(const CanvasPaint& paint, Side side, const OverlayScene& scene) {
  const Deformation& deformation = *scene.derived->deformation;
  const Similarity placed = scene.layer.placement.to_target();
  const Points places = side == Side::kSource ? handles_on_outline(scene.layer, deformation)
                                              : transformed(deformation.handle_points, placed);
  const float half = paint.look.px(2);
  for (const Point place : places) {
    const ImVec2 p = paint.at(place);
    if (!paint.shows(p, half)) continue;
    paint.list.AddRectFilled({p.x - half - 1, p.y - half - 1}, {p.x + half + 1, p.y + half + 1}, paint.look.curve_halo);
    paint.list.AddRectFilled({p.x - half, p.y - half}, {p.x + half, p.y + half}, paint.look.accent);
  }
}

/// Where each handle is drawn to: against the gradient, as the step goes.
void draw_gradients(const CanvasPaint& paint, const OverlayScene& scene) {
  const Deformation& deformation = *scene.derived->deformation;
  const Similarity placed = scene.layer.placement.to_target();
  const std::size_t count = std::min(deformation.handle_points.size(), deformation.handle_gradients.size());
  std::vector<ImVec2> ends;
  for (std::size_t i = 0; i < count; ++i) {
    const Point from = deformation.handle_points[i];
    ends.push_back(paint.at(placed(from)));
    ends.push_back(paint.at(placed(from - kGradientScale * deformation.handle_gradients[i])));
  }
  draw_line_pairs(paint, ends, paint.look.curve_halo, paint.look.px(3.5f));
  draw_line_pairs(paint, ends, paint.look.warning, paint.look.px(1.5f));
}

void draw_correspondence(const CanvasPaint& paint, Side side, const OverlayScene& scene) {
  const double length = perimeter(curve_on(scene.layer, side)) * paint.view.zoom / paint.look.scale;
  int count = kFewestDots;
  while (2 * count <= kMostDots && length / (2 * count) >= kDotSpacing)
    count *= 2;
  const MatchedPlaces places = matched_places(scene.layer, *scene.derived->deformation, count);
  const Points& points = side == Side::kSource ? places.outline : places.sketch;
  for (std::size_t i = 0; i < points.size(); ++i)
    paint.dot(points[i], fraction_color(places.fractions[i]), 2.5f);
}

/// Along the boundary, where the part is: as wide as to be told from the curve that it lies on.
void draw_bleed(const CanvasPaint& paint, const OverlayScene& scene) {
  const auto& samples = scene.derived->bleed->samples;
  if (samples.size() < 3) return;
  // No more pieces than the screen can tell apart.
  const double spacing = samples.back().s / static_cast<double>(samples.size() - 1) * paint.view.zoom;
  const auto step = static_cast<std::size_t>(std::max(1.0, std::ceil(2 / std::max(spacing, 1e-3))));
  const auto at = [&](std::size_t i) { return paint.at(samples[i % samples.size()].at); };
  std::vector<ImVec2> ends;
  std::vector<PackedColor> colors;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    ends.push_back(at(i));
    ends.push_back(at(std::min(i + step, samples.size())));
    float worst = 0;
    for (std::size_t k = i; k < std::min(i + step, samples.size()); ++k)
      worst = std::max(worst, samples[k].norm);
    colors.push_back(heat_color(worst / kBleedScale));
  }
  draw_line_pairs(paint, ends, faded(paint.look.curve_halo, 0.8f), paint.look.px(7));
  for (std::size_t i = 0; i < colors.size(); ++i)
    draw_line_pairs(paint, std::span(ends).subspan(2 * i, 2), colors[i], paint.look.px(4.5f));
}

void draw_pins(const CanvasPaint& paint, Side side, const OverlayScene& scene) {
  const Similarity placed = scene.layer.placement.to_target();
  for (const Pin& pin : scene.layer.pins) {
    const Point at = side == Side::kSource ? pin.outline : placed(pin.sketch);
    const bool selected = scene.selected_pin == pin.id;
    if (selected) paint.ring(at, paint.look.accent, 10, 2);
    paint.ring(at, paint.look.curve, 6.5f, 2);
    paint.dot(at, fraction_color(outline_fraction(scene.layer.outline, pin.outline)), 4.5f);
  }
}

} // namespace

MatchedPlaces matched_places(const Layer& layer, const Deformation& deformation, int count) {
  MatchedPlaces places;
  const auto& matched = deformation.correspondence;
  if (layer.outline.size() < 3 || layer.sketch.size() < 3 || matched.size() != layer.outline.size()) return places;
  const ClosedCurve outline(layer.outline), sketch(layer.sketch_in_target());
  const bool against = outline.signed_area() * sketch.signed_area() < 0;
  for (int i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / count, s = fraction * outline.length();
    const auto from = static_cast<std::size_t>(outline.segment_at(s)), to = (from + 1) % matched.size();
    const double begin = outline.s_at(static_cast<int>(from));
    const double piece = distance(layer.outline[from], layer.outline[to]);
    const double step = matched[to] - matched[from] - std::floor(matched[to] - matched[from]);
    const double on_sketch = matched[from] + (piece > 0 ? step * (s - begin) / piece : 0);
    places.fractions.push_back(fraction);
    places.outline.push_back(outline.at(s));
    places.sketch.push_back(sketch.at((against ? -on_sketch : on_sketch) * sketch.length()));
  }
  return places;
}

void draw_overlays(const CanvasPaint& paint, Side side, const OverlayScene& scene, OverlayCache& cache) {
  const Overlays& shown = scene.shown;
  if (!shown.shown || scene.layer.outline.empty()) return;
  const bool derived = scene.derived != nullptr && scene.derived->deformation != nullptr;
  if (derived) draw_meshes(paint, side, scene, cache);
  if (shown.curves) paint.haloed_line(curve_on(scene.layer, side), true, paint.look.curve, 1.5f);
  if (derived && shown.bleed && side == Side::kTarget && scene.derived->bleed != nullptr) draw_bleed(paint, scene);
  if (derived && shown.correspondence) draw_correspondence(paint, side, scene);
  if (derived && shown.handles) draw_handles(paint, side, scene);
  if (derived && shown.gradients && side == Side::kTarget) draw_gradients(paint, scene);
  if (shown.pins) draw_pins(paint, side, scene);
}

std::vector<Legend> list_legends(const Overlays& shown, bool derived) {
  std::vector<Legend> legends;
  if (!shown.shown || !derived) return legends;
  if (shown.heat_sigma) legends.push_back({"Distortion σ1/σ2", "1", "2 and more"});
  if (shown.heat_area) legends.push_back({"Change of area", "none", "4 times"});
  if (shown.bleed)
    legends.push_back({"Colour mismatch", "0", std::to_string(static_cast<int>(kBleedScale)) + " levels"});
  return legends;
}

void draw_legends(const CanvasPaint& paint, std::span<const Legend> legends) {
  const ThemeLook& look = paint.look;
  const float pad = look.px(10), margin = look.px(10), bar = look.px(8), line = ImGui::GetTextLineHeight();
  const float width = look.px(190), height = line + look.px(5) + bar + look.px(4) + line + 2 * look.px(7);
  // Below the caption where both do not fit side by side.
  const bool beside = paint.end.x - paint.corner.x > 2 * width + look.px(90);
  float y = paint.corner.y + (beside ? margin : look.px(42));
  for (const Legend& legend : legends) {
    const ImVec2 low{paint.end.x - margin - width, y}, high{paint.end.x - margin, y + height};
    if (low.x < paint.corner.x + margin || high.y > paint.end.y - margin) return;
    draw_plate(paint, low, high);
    const float left = low.x + pad, right = high.x - pad;
    float top = low.y + look.px(7);
    draw_plate_text(paint, {left, top}, legend.title);
    top += line + look.px(5);
    constexpr int kPieces = 24;
    for (int i = 0; i < kPieces; ++i) {
      const float from = left + (right - left) * static_cast<float>(i) / kPieces;
      const float to = left + (right - left) * static_cast<float>(i + 1) / kPieces;
      paint.list.AddRectFilled({from, top}, {to, top + bar}, heat_color((i + 0.5) / kPieces));
    }
    top += bar + look.px(4);
    draw_plate_text(paint, {left, top}, legend.low);
    draw_plate_text(paint, {right - ImGui::CalcTextSize(legend.high.c_str()).x, top}, legend.high);
    y = high.y + look.px(6);
  }
}

} // namespace oversketch
