#include "ui/canvas/canvas_panel.h"

#include "core/base/hash.h"
#include "ui/canvas/tool_paint.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/item.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace oversketch {
namespace {

/// Design px.
constexpr float kSplitterWidth = 5;

/// Everything of one frame that the parts below share.
struct Scene {
  const EditorState& state;
  const Tab& tab;
  const Snapshot& snapshot;
  CanvasesState& canvases;
  Pictures& pictures;
  const DrawContext& context;
  ImDrawList& list;
  const Layer* layer = nullptr;
  const LayerSnapshot* derived = nullptr;
};

ImVec2 to_imgui(Point p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

Point size_of(const Image& image) {
  return {static_cast<double>(image.width()), static_cast<double>(image.height())};
}

WidgetMap::Box to_widget(const Box& box) {
  const ImVec2 low = to_imgui(box.low), size = to_imgui(box.size());
  return {low.x, low.y, size.x, size.y};
}

/// Whether the selected layer has a picture of its own to show beside the target.
bool has_source_canvas(const Document& document) {
  const Layer* layer = selected_layer(document);
  return layer != nullptr && !(layer->source.image == document.target.image);
}

/// Which canvas it is, how near, and of which picture: the last is what can be done without.
std::vector<std::string> caption(const char* side, const std::string& name, double zoom) {
  const double percent = 100 * zoom;
  const std::string number =
      percent < 10 ? std::to_string(std::round(percent * 10) / 10).substr(0, 3) : std::to_string(std::lround(percent));
  std::vector<std::string> parts = {side, number + " %"};
  if (const std::string file = std::filesystem::path(name).filename().string(); !file.empty()) parts.push_back(file);
  return parts;
}

CanvasPaint paint_of(const Scene& scene, const Box& box, Side side) {
  return {scene.list, scene.context.look, scene.canvases.input.view(side), to_imgui(box.low), to_imgui(box.high)};
}

/// What is left of the slider and what is right of it, beside it where there is room.
void label_compared(const CanvasPaint& paint, float x, LiveSession::Compare compare) {
  const auto rows = compare_rows();
  const auto row = std::ranges::find(rows, compare, &CompareRow::compare);
  const float gap = paint.look.px(8), pad = paint.look.px(7), height = ImGui::GetTextLineHeight() + paint.look.px(6);
  // Below legends and captions, above the hint.
  const float top = std::max(paint.corner.y + paint.look.px(44), paint.end.y - paint.look.px(84));
  const auto put = [&](std::string_view text, bool left) {
    const float width = ImGui::CalcTextSize(text.data(), text.data() + text.size()).x + 2 * pad;
    const float from = left ? x - gap - width : x + gap;
    if (from < paint.corner.x || from + width > paint.end.x || top + height > paint.end.y) return;
    draw_plate(paint, {from, top}, {from + width, top + height});
    draw_plate_text(paint, {from + pad, top + paint.look.px(3)}, text);
  };
  put("Result", true);
  if (row != rows.end()) put(row->label, false);
}

/// The comparison right of the slider, or all over while the state before is held.
void draw_compared(const Scene& scene, const CanvasPaint& paint) {
  const auto& compare = scene.snapshot.compare;
  const DocumentView& view = scene.tab.view;
  const bool whole = view.before_held;
  if (!whole && view.compare == LiveSession::Compare::kOff) return;
  const float x = paint.corner.x + static_cast<float>(view.compare_split) * (paint.end.x - paint.corner.x);
  if (compare && compare->pixels != nullptr) {
    ShownPicture& shown = scene.canvases.compared;
    if (shown.pixels != compare->pixels) {
      shown.pixels = compare->pixels;
      Hasher hasher;
      hasher.add(shown.pixels->width()).add(shown.pixels->height());
      hasher.add_bytes(shown.pixels->values().data(), shown.pixels->values().size_bytes());
      shown.content = hasher.finish();
    }
    View moved = paint.view;
    moved.origin -= Point{static_cast<double>(compare->rect.x), static_cast<double>(compare->rect.y)};
    const ImVec2 corner{whole ? paint.corner.x : std::max(paint.corner.x, x), paint.corner.y};
    moved.origin.x += (corner.x - paint.corner.x) / paint.view.zoom;
    if (corner.x < paint.end.x) scene.pictures.draw(scene.list, shown, moved, corner, paint.end);
  }
  if (whole) return;
  const ThemeLook& look = paint.look;
  const float y = 0.5f * (paint.corner.y + paint.end.y), r = look.px(9);
  scene.list.AddLine({x, paint.corner.y}, {x, paint.end.y}, look.curve_halo, look.px(3));
  scene.list.AddLine({x, paint.corner.y}, {x, paint.end.y}, look.curve, look.px(1));
  scene.list.AddCircleFilled({x, y}, r + 1, look.curve_halo);
  scene.list.AddCircleFilled({x, y}, r, look.curve);
  for (const float way : {-1.0f, 1.0f})
    scene.list.AddTriangleFilled({x + way * look.px(6.5f), y}, {x + way * look.px(2), y - look.px(4)},
                                 {x + way * look.px(2), y + look.px(4)}, look.curve_halo | IM_COL32_A_MASK);
  label_compared(paint, x, view.compare);
  scene.context.widgets.add("canvas.compare", {x - r, y - r, 2 * r, 2 * r});
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  tip_at_rest(scene.context, "canvas.compare",
              std::hypot(mouse.x - x, mouse.y - y) <= r && !scene.canvases.input.held(),
              {"Drag: left of the line is the result, right of it what it is compared with.", {}});
}

void draw_layer_overlays(const Scene& scene, const CanvasPaint& paint, Side side) {
  if (scene.layer == nullptr || scene.tab.view.before_held) return;
  const OverlayScene overlays{*scene.layer, scene.derived, scene.state.overlays, scene.tab.view.selected_pin};
  draw_overlays(paint, side, overlays, scene.canvases.overlays);
}

/// Where the target is its own source both curves lie on one picture: the outline is dashed, to be told from the
/// sketch.
void draw_source_overlays_on_target(const Scene& scene, const CanvasPaint& paint) {
  if (scene.layer == nullptr || scene.tab.view.before_held) return;
  Overlays shown = scene.state.overlays;
  if (shown.shown && std::exchange(shown.curves, false) && !scene.layer->outline.empty()) {
    paint.line(scene.layer->outline, true, faded(paint.look.curve_halo, 0.6f), 3);
    paint.dashed_line(scene.layer->outline, true, paint.look.curve, 1.25f, 4);
  }
  const OverlayScene overlays{*scene.layer, scene.derived, shown, scene.tab.view.selected_pin};
  draw_overlays(paint, Side::kSource, overlays, scene.canvases.overlays);
}

void draw_source(const Scene& scene, const Box& box, const ToolDrawing& drawing) {
  const CanvasPaint paint = paint_of(scene, box, Side::kSource);
  scene.list.PushClipRect(paint.corner, paint.end, true);
  if (scene.derived != nullptr && scene.derived->source.pixels != nullptr)
    scene.pictures.draw(scene.list, scene.derived->source, paint.view, paint.corner, paint.end);
  draw_layer_overlays(scene, paint, Side::kSource);
  draw_tool(paint, Side::kSource, drawing);
  if (scene.layer != nullptr) draw_caption(paint, caption("Source", scene.layer->source.name, paint.view.zoom));
  if (scene.state.overlays.shown && drawing.hint_side == Side::kSource) draw_hint(paint, drawing.hint);
  scene.list.PopClipRect();
}

void draw_target(const Scene& scene, const Box& box, bool one_canvas, const ToolDrawing& drawing) {
  const CanvasPaint paint = paint_of(scene, box, Side::kTarget);
  scene.list.PushClipRect(paint.corner, paint.end, true);
  if (!scene.snapshot.document.empty())
    scene.pictures.draw_result(scene.list, *scene.tab.session, paint.view, paint.corner, paint.end);
  draw_compared(scene, paint);
  if (one_canvas) draw_source_overlays_on_target(scene, paint);
  draw_layer_overlays(scene, paint, Side::kTarget);
  if (one_canvas) draw_tool(paint, Side::kSource, drawing);
  draw_tool(paint, Side::kTarget, drawing);
  if (!scene.snapshot.document.empty())
    draw_caption(paint, caption(one_canvas && scene.layer != nullptr ? "Source and target" : "Target",
                                scene.snapshot.document.target.name, paint.view.zoom));
  const bool derived = scene.derived != nullptr && scene.derived->deformation != nullptr;
  if (!scene.tab.view.before_held) draw_legends(paint, list_legends(scene.state.overlays, derived));
  if (scene.state.overlays.shown && (one_canvas || drawing.hint_side == Side::kTarget)) draw_hint(paint, drawing.hint);
  scene.list.PopClipRect();
}

/// A bar with a grip, that lights up under the pointer.
void draw_splitter(const Scene& scene, const Box& box, bool over) {
  const ThemeLook& look = scene.context.look;
  const ImVec2 low = to_imgui(box.low), high = to_imgui(box.high);
  scene.list.AddRectFilled(low, high, over ? look.accent : look.panel);
  const float x = std::round((low.x + high.x) / 2), y = std::round((low.y + high.y) / 2);
  for (const float step : {-8.0f, 0.0f, 8.0f})
    scene.list.AddCircleFilled({x, y + look.px(step)}, look.px(1.5f), over ? look.accent_ink : look.ink_quiet);
  tip_at_rest(scene.context, "canvas.splitter", over && !scene.canvases.input.held(),
              {"Drag to share the width between the two pictures.", {}});
}

/// The two ends of the selected pin joined, of all with the Pin tool in hand, as far as both can be seen.
void draw_pin_links(const Scene& scene, const CanvasLayout& layout) {
  const Overlays& shown = scene.state.overlays;
  if (scene.layer == nullptr || !shown.shown || !shown.pins || scene.tab.view.before_held) return;
  const bool all = scene.state.tool == Tool::kPin;
  const CanvasPaint target = paint_of(scene, layout.target, Side::kTarget);
  const CanvasPaint source = layout.source ? paint_of(scene, *layout.source, Side::kSource) : target;
  const Similarity placed = scene.layer->placement.to_target();
  for (const Pin& pin : scene.layer->pins) {
    const ImVec2 from = source.at(pin.outline), to = target.at(placed(pin.sketch));
    if (!source.shows(from, 0) || !target.shows(to, 0)) continue;
    const bool selected = scene.tab.view.selected_pin == pin.id;
    // Lines across both pictures are in the way of everything else.
    if (!all && !selected) continue;
    const PackedColor color = fraction_color(outline_fraction(scene.layer->outline, pin.outline));
    scene.list.AddLine(from, to, faded(scene.context.look.curve_halo, selected ? 1.0f : 0.4f),
                       scene.context.look.px(selected ? 3.5f : 2.5f));
    scene.list.AddLine(from, to, faded(color, selected ? 1.0f : 0.55f), scene.context.look.px(1.25f));
  }
}

void fit_where_wanted(const CanvasFrame& frame, DocumentView& view, ActionSink& sink) {
  for (const Side side : {Side::kSource, Side::kTarget}) {
    CanvasState& canvas = view.canvas(side);
    const Box* box = frame.layout.box(side);
    const Point picture = frame.picture_size(side);
    if (!canvas.fit_wanted || box == nullptr || !(picture.x > 0) || box->size().x < 2 || box->size().y < 2) continue;
    canvas.view = fitted(picture, box->size());
    sink.emit(action::SetView{side, canvas.view});
  }
}

void show_places(const CanvasLayout& layout, const DrawContext& context) {
  context.widgets.add("canvas.target", to_widget(layout.target));
  context.reply.canvases.target = to_widget(layout.target);
  if (!layout.source) return;
  context.widgets.add("canvas.source", to_widget(*layout.source));
  context.reply.canvases.source = to_widget(*layout.source);
  context.widgets.add("canvas.splitter", to_widget(*layout.splitter));
}

void draw_document(const EditorState& state, const Tab& tab, CanvasesState& canvases, Pictures& pictures,
                   const InputEvents& events, const Box& area, bool covered, bool mouse_free,
                   const DrawContext& context) {
  const std::shared_ptr<const Snapshot> snapshot = tab.session->snapshot();
  const Document& document = snapshot->document;
  const Layer* layer = selected_layer(document);
  const bool two = has_source_canvas(document);
  DocumentView view = tab.view;
  const CanvasFrame frame{state,
                          view,
                          *snapshot,
                          lay_out_canvases(area, view.split, two, std::round(context.look.px(kSplitterWidth))),
                          size_of(layer != nullptr ? layer->source.image : document.target.image),
                          size_of(document.target.image),
                          mouse_free,
                          !covered && !ImGui::GetIO().WantTextInput,
                          covered,
                          context.look.scale};
  fit_where_wanted(frame, view, context.sink);
  canvases.input.update(events, frame, context.sink);
  ToolDrawing drawing = canvases.input.draw(frame);
  if (const auto cursor = canvases.input.cursor(frame, drawing)) context.reply.cursor = cursor;
  if (view.before_held) drawing = {};
  show_places(frame.layout, context);

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Scene scene{state,    tab,      *snapshot,
                    canvases, pictures, context,
                    list,     layer,    layer != nullptr ? snapshot->find(layer->id) : nullptr};
  if (frame.layout.source) draw_source(scene, *frame.layout.source, drawing);
  draw_target(scene, frame.layout.target, !frame.layout.source, drawing);
  if (frame.layout.splitter) draw_splitter(scene, *frame.layout.splitter, canvases.input.over_splitter(frame));
  draw_pin_links(scene, frame.layout);
}

} // namespace

void draw_canvases(const EditorState& state, CanvasesState& canvases, Pictures& pictures, const InputEvents& events,
                   ImVec2 corner, ImVec2 end, const DrawContext& context) {
  const Box area{{corner.x, corner.y}, {std::max(end.x, corner.x + 1), std::max(end.y, corner.y + 1)}};
  ImGui::SetCursorScreenPos(corner);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleColor(ImGuiCol_ChildBg, context.look.canvas);
  ImGui::BeginChild("##canvases", to_imgui(area.size()), false,
                    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse);
  // Holds the pointer as long as a button is down, so that nothing else lights up under a stroke.
  ImGui::SetCursorScreenPos(corner);
  ImGui::InvisibleButton("##surface", to_imgui(area.size()),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool covered = is_popup_open();
  const bool over = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  const bool elsewhere = !ImGui::IsMouseHoveringRect(corner, to_imgui(area.high), false);
  const bool mouse_free = !covered && (over || elsewhere);
  if (const Tab* tab = state.tab(); tab != nullptr && tab->session != nullptr)
    draw_document(state, *tab, canvases, pictures, events, area, covered, mouse_free, context);
  else
    canvases.input = {};
  ImGui::EndChild();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

std::string_view tool_summary(Tool tool) {
  switch (tool) {
  case Tool::kOutline:
    return "Outline: draw round the part in the source; draw over a part of the outline to change it";
  case Tool::kSketch:
    return "Sketch: draw the boundary the region shall take; draw over a part to change it";
  case Tool::kPin:
    return "Pin: click a point of the outline, then the place of the sketch it belongs to";
  case Tool::kMove:
    return "Move: drag the part; corners scale, outside turns, arrows nudge";
  case Tool::kPan:
    return "Pan: drag the picture; the wheel zooms";
  }
  return "";
}

} // namespace oversketch
