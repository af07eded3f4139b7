#include "ui/panels/tool_panel.h"

#include "ui/widgets/section.h"

#include <array>

namespace oversketch {
namespace {

std::vector<ToolKey> keys_of_tool(Tool tool) {
  switch (tool) {
  case Tool::kOutline:
  case Tool::kSketch:
    return {{"X", "other side"}, {"Alt", "sharp joins"}, {"Esc", "give up"}};
  case Tool::kPin:
    return {{"Delete", "remove"}, {"Esc", "give up"}};
  case Tool::kMove:
    return {{"Shift", "keep straight"}, {"Arrows", "1 px, Shift 10"}, {"Esc", "give up"}};
  case Tool::kPan:
    return {{"Ctrl+0", "fit"}, {"Ctrl+1", "100 %"}, {"Space", "with any tool"}};
  }
  return {};
}

/// Keys as little caps, each with its word, as many to a row as fit.
void draw_keys(const std::vector<ToolKey>& keys, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float right = at.x + ImGui::GetContentRegionAvail().x, height = look.px(20);
  const auto measure = [](std::string_view text) {
    return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
  };
  ImVec2 pen(at.x, at.y + look.px(2));
  for (const ToolKey& key : keys) {
    const float cap = measure(key.key) + look.px(10), word = measure(key.what) + 1;
    if (pen.x > at.x && pen.x + cap + word + look.px(6) > right) pen = ImVec2(at.x, pen.y + height + look.px(4));
    ImGui::GetWindowDrawList()->AddRectFilled(pen, ImVec2(pen.x + cap, pen.y + height), look.raised, look.px(3));
    draw_text(pen, ImVec2(pen.x + cap, pen.y + height), look.ink, key.key, 0.5F);
    pen.x += cap + look.px(6);
    draw_text(pen, ImVec2(pen.x + word, pen.y + height), look.ink_quiet, key.what);
    pen.x += word + look.px(12);
  }
  ImGui::SetCursorScreenPos(ImVec2(at.x, pen.y + height + look.px(4)));
}

} // namespace

ToolModel make_tool_model(const EditorState& state, const Snapshot& snapshot) {
  ToolModel model;
  model.tool = state.tool;
  for (const ToolRow& row : tool_rows())
    if (row.tool == state.tool) model.title = entry_of("tool." + std::string(row.id)).label;
  model.draws = state.tool == Tool::kOutline || state.tool == Tool::kSketch;
  model.preferences = state.preferences;
  model.keys = keys_of_tool(state.tool);
  const Document& document = snapshot.document;
  if (const Layer* layer = document.selected ? document.find(*document.selected) : nullptr)
    model.pins = layer->pins.size();
  return model;
}

bool draw_stroke_options(const DrawContext& context, std::string_view prefix, Preferences& preferences) {
  static constexpr std::array kSmoothings = {
      Option{"none", "None", "The stroke goes exactly where the hand goes."},
      Option{"basic", "Basic", "Takes the tremble out of the stroke."},
      Option{"stabiliser", "Stabiliser", "A long, calm line that catches up with the hand at its end."},
  };
  const std::string name(prefix);
  const Preferences before = preferences;
  const RowBox row = begin_row(context, "Smoothing");
  ImGui::SetCursorScreenPos(row.corner);
  const int chosen = draw_segments(context, name + ".smoothing", kSmoothings, static_cast<int>(preferences.smoothing));
  if (chosen >= 0) preferences.smoothing = static_cast<Smoothing>(chosen);
  end_row(context, row);
  const SliderSpec spec{.low = 2,
                        .high = 40,
                        .least = 1,
                        .most = 100,
                        .initial = Preferences().tolerance_px,
                        .whole = true,
                        .unit = "px"};
  const SliderChange change = draw_slider(
      context, name + ".tolerance", "Tolerance",
      {"How near to a curve a stroke must begin and end to replace a part of it, screen pixels.", "[ and ]"},
      preferences.tolerance_px, spec);
  using Kind = SliderChange::Kind;
  if (change.kind == Kind::kPreview || change.kind == Kind::kCommit || change.kind == Kind::kSet)
    preferences.tolerance_px = change.value;
  if (change.kind == Kind::kRefused) context.sink.emit(action::Say{change.text});
  return preferences != before;
}

void draw_tool_panel(const ToolModel& model, const EntryContext& entries, const DrawContext& context) {
  const Section section(context, "panel.tool", "Tool", model.title, "What the tool in hand can be told.");
  if (!section.open()) return;
  if (model.draws) {
    Preferences preferences = model.preferences;
    if (draw_stroke_options(context, "tool", preferences)) context.sink.emit(action::SetPreferences{preferences});
  }
  if (model.tool == Tool::kSketch) {
    const Entry& reset = entry_of("layer.reset_sketch");
    if (draw_button(context, "tool.reset_sketch", "Reset sketch", {std::string(reset.help), {}},
                    {.enabled = is_enabled(reset, entries), .height = 24}))
      reset.act(entries);
  }
  if (model.tool == Tool::kPin) {
    draw_note(context, model.pins == 0   ? "No pins yet. Click the outline, then the sketch."
                       : model.pins == 1 ? "One pin."
                                         : std::to_string(model.pins) + " pins.");
    const Entry& remove = entry_of("layer.remove_pin");
    if (draw_button(context, "tool.remove_pin", "Remove pin", {std::string(remove.help), "Delete"},
                    {.enabled = is_enabled(remove, entries), .height = 24}))
      remove.act(entries);
  }
  draw_keys(model.keys, context);
}

} // namespace oversketch
