#include "ui/panels/window_layout.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// Below this height eight buttons do not fit one below the other, design pixels.
constexpr float kLowStrip = 290;

} // namespace

WindowLayout lay_out_window(const LayoutWish& wish) {
  const auto px = [&](float design) { return std::round(design * wish.scale); };
  const float w = std::max(1.0F, wish.size.x), h = std::max(1.0F, wish.size.y);
  WindowLayout out;
  out.narrow = w < px(kNarrow);
  const float menu = std::min(h, px(31));
  const float status = std::min(h - menu, px(24));
  const float bottom = h - status;
  const float tabs = wish.tabs ? std::min(bottom - menu, px(30)) : 0;
  const float offer = std::min(bottom - menu - tabs, px(wish.offer));
  out.strip_columns = bottom - menu < px(kLowStrip) ? 2 : 1;
  const float strip = std::min(w, px(out.strip_columns == 2 ? 70 : out.narrow ? 40 : 52));
  float side = 0;
  if (!out.narrow && wish.side)
    side = std::clamp(px(wish.side_width), px(kLeastSide), std::max(px(kLeastSide), std::min(px(kMostSide), w / 2)));
  const float right = w - side;

  out.menu = {ImVec2(0, 0), ImVec2(w, menu)};
  out.status = {ImVec2(0, bottom), ImVec2(w, h)};
  out.strip = {ImVec2(0, menu), ImVec2(strip, bottom)};
  out.tabs = {ImVec2(strip, menu), ImVec2(right, menu + tabs)};
  out.offer = {ImVec2(strip, menu + tabs), ImVec2(right, menu + tabs + offer)};
  out.canvases = {ImVec2(strip, menu + tabs + offer), ImVec2(right, bottom)};
  out.side = {ImVec2(right, menu), ImVec2(w, bottom)};
  if (out.narrow && wish.side_over) out.side.low.x = std::max(strip, w - px(300));
  return out;
}

} // namespace oversketch
