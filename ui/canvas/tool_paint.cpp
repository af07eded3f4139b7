#include "ui/canvas/tool_paint.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace oversketch {
namespace {

void draw_line(const CanvasPaint& paint, const ToolLine& line) {
  const ThemeLook& look = paint.look;
  switch (line.kind) {
  case ToolLine::Kind::kStroke:
    return paint.haloed_line(line.points, line.closed, look.stroke, 2.5f);
  case ToolLine::Kind::kGhost:
    paint.line(line.points, line.closed, look.curve_halo, 4);
    return paint.dashed_line(line.points, line.closed, look.ghost, 2, 4);
  case ToolLine::Kind::kRubber:
    return paint.dashed_line(line.points, line.closed, faded(look.stroke, 0.7f), 1.25f, 3);
  case ToolLine::Kind::kFrame:
    paint.line(line.points, line.closed, faded(look.curve_halo, 0.7f), 2.5f);
    return paint.line(line.points, line.closed, look.accent, 1.25f);
  }
}

/// Beside the pointer: an arc with an arrow head at either end.
void draw_turn_sign(const CanvasPaint& paint, Point pointer) {
  const ThemeLook& look = paint.look;
  const ImVec2 p = paint.at(pointer), c{p.x + look.px(18), p.y + look.px(18)};
  const float r = look.px(7), from = -2.6f, to = 1.0f;
  for (const bool halo : {true, false}) {
    const PackedColor color = halo ? look.curve_halo : look.curve;
    paint.list.PathArcTo(c, r, from, to, 16);
    paint.list.PathStroke(color, 0, look.px(halo ? 4.0f : 1.75f));
    for (const float angle : {from, to}) {
      const float way = angle == to ? 1.0f : -1.0f;
      const ImVec2 tip{c.x + r * std::cos(angle), c.y + r * std::sin(angle)};
      const ImVec2 along{-std::sin(angle) * way, std::cos(angle) * way}, out{std::cos(angle), std::sin(angle)};
      const float size = look.px(halo ? 5.5f : 4.0f);
      paint.list.AddTriangleFilled({tip.x + along.x * size, tip.y + along.y * size},
                                   {tip.x + out.x * size, tip.y + out.y * size},
                                   {tip.x - out.x * size, tip.y - out.y * size}, color);
    }
  }
}

void draw_mark(const CanvasPaint& paint, const ToolMark& mark) {
  const ThemeLook& look = paint.look;
  switch (mark.kind) {
  case ToolMark::Kind::kClose:
    return paint.ring(mark.at, look.stroke, 6, 2);
  case ToolMark::Kind::kVertex:
    return paint.dot(mark.at, look.stroke, 2.5f);
  case ToolMark::Kind::kCorner: {
    const ImVec2 p = paint.at(mark.at);
    const float half = look.px(4);
    paint.list.AddRectFilled({p.x - half - 1, p.y - half - 1}, {p.x + half + 1, p.y + half + 1}, look.curve_halo);
    paint.list.AddRectFilled({p.x - half, p.y - half}, {p.x + half, p.y + half}, look.accent_ink);
    return paint.list.AddRect({p.x - half, p.y - half}, {p.x + half, p.y + half}, look.accent, 0, 0, look.px(1.5f));
  }
  case ToolMark::Kind::kPin:
    paint.ring(mark.at, look.curve, 6.5f, 2);
    return paint.dot(mark.at, fraction_color(mark.fraction), 4.5f);
  case ToolMark::Kind::kPlace:
    return paint.ring(mark.at, fraction_color(mark.fraction), 6, 2);
  case ToolMark::Kind::kTurn:
    return draw_turn_sign(paint, mark.at);
  }
}

/// A piece of a hint: plain words, or what stands on a key.
struct Piece {
  std::string text;
  bool key = false;
};

std::vector<Piece> parse_hint(std::string_view text) {
  std::vector<Piece> pieces;
  while (!text.empty()) {
    const bool key = text.front() == '[';
    const std::size_t end = std::min(text.find(key ? ']' : '['), text.size());
    const std::size_t from = key ? 1 : 0;
    std::string words(text.substr(from, end - from));
    if (!key)
      while (!words.empty() && words.back() == ' ')
        words.pop_back();
    if (!key)
      while (!words.empty() && words.front() == ' ')
        words.erase(0, 1);
    if (!words.empty()) pieces.push_back({words, key});
    text.remove_prefix(std::min(text.size(), end + from));
  }
  return pieces;
}

ImVec2 measure(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str(), text.c_str() + text.size());
}

constexpr PackedColor kPlate = IM_COL32(12, 13, 16, 225), kInk = IM_COL32(236, 238, 242, 255),
                      kKeyPlate = IM_COL32(70, 74, 84, 255);

} // namespace

void draw_tool(const CanvasPaint& paint, Side side, const ToolDrawing& drawing) {
  for (const ToolLine& line : drawing.lines)
    if (line.side == side) draw_line(paint, line);
  for (const ToolMark& mark : drawing.marks)
    if (mark.side == side) draw_mark(paint, mark);
}

void draw_caption(const CanvasPaint& paint, std::span<const std::string> parts) {
  const float pad = paint.look.px(8), margin = paint.look.px(10), room = paint.end.x - paint.corner.x - 2 * margin;
  const auto joined = [&](std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
      text += (i == 0 ? "" : " · ") + parts[i];
    return text;
  };
  std::size_t count = parts.size();
  while (count > 1 && measure(joined(count)).x + 2 * pad > room)
    --count;
  const std::string shown = joined(count);
  const ImVec2 size = measure(shown);
  if (size.x + 2 * pad > room || size.y + 2 * margin > paint.end.y - paint.corner.y) return;
  const ImVec2 low{paint.corner.x + margin, paint.corner.y + margin};
  draw_plate(paint, low, {low.x + size.x + 2 * pad, low.y + size.y + paint.look.px(6)});
  draw_plate_text(paint, {low.x + pad, low.y + paint.look.px(3)}, shown);
}

void draw_hint(const CanvasPaint& paint, std::string_view text) {
  const ThemeLook& look = paint.look;
  const std::vector<Piece> pieces = parse_hint(text);
  const float gap = look.px(8), key_pad = look.px(6), pad = look.px(12), margin = look.px(14);
  float width = 0, height = 0;
  for (const Piece& piece : pieces) {
    const ImVec2 size = measure(piece.text);
    width += size.x + (piece.key ? 2 * key_pad : 0) + (width > 0 ? gap : 0);
    height = std::max(height, size.y);
  }
  const float plate = height + look.px(14);
  if (pieces.empty() || width + 2 * (pad + margin) > paint.end.x - paint.corner.x ||
      plate + 2 * margin > paint.end.y - paint.corner.y)
    return;
  const ImVec2 low{paint.corner.x + margin, paint.end.y - margin - plate};
  paint.list.AddRectFilled(low, {low.x + width + 2 * pad, low.y + plate}, kPlate, look.px(7));
  float x = low.x + pad;
  const float y = low.y + look.px(7);
  for (const Piece& piece : pieces) {
    const ImVec2 size = measure(piece.text);
    const char* begin = piece.text.c_str();
    if (piece.key) {
      paint.list.AddRectFilled({x, y - look.px(2)}, {x + size.x + 2 * key_pad, y + height + look.px(2)}, kKeyPlate,
                               look.px(4));
      x += key_pad;
    }
    paint.list.AddText({x, y}, kInk, begin, begin + piece.text.size());
    x += size.x + gap + (piece.key ? key_pad : 0);
  }
}

void draw_plate(const CanvasPaint& paint, ImVec2 low, ImVec2 high) {
  paint.list.AddRectFilled(low, high, kPlate, paint.look.px(5));
}

void draw_plate_text(const CanvasPaint& paint, ImVec2 at, std::string_view text) {
  paint.list.AddText(at, kInk, text.data(), text.data() + text.size());
}

} // namespace oversketch
