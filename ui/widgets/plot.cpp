#include "ui/widgets/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace oversketch {
namespace {

std::string with_value(const Tip& tip, std::span<const double> values, float share) {
  const auto last = static_cast<float>(values.size() - 1);
  const auto index = static_cast<std::size_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * last));
  char text[64];
  std::snprintf(text, sizeof text, "%zu: %.4g", index, values[index]);
  return tip.text + "\n" + text;
}

} // namespace

std::vector<float> plot_heights(std::span<const double> values, const PlotLook& plot) {
  std::vector<double> scaled(values.begin(), values.end());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (double& value : scaled) {
    if (plot.logarithmic) value = value > 0 ? std::log(value) : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (plot.from_zero && !plot.logarithmic) low = std::min(low, 0.0);
  std::vector<float> heights;
  heights.reserve(scaled.size());
  for (const double value : scaled)
    heights.push_back(std::isfinite(value) && high > low ? static_cast<float>((value - low) / (high - low)) : 0.0F);
  return heights;
}

void draw_plot(const DrawContext& context, std::string_view id, const Tip& tip, std::span<const double> values,
               const PlotLook& plot) {
  const IdScope scope(id);
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + std::max(1.0F, ImGui::GetContentRegionAvail().x), at.y + look.px(plot.height));
  ImGui::InvisibleButton("##plot", ImVec2(end.x - at.x, end.y - at.y));
  Tip shown = tip;
  if (values.size() >= 2 && ImGui::IsItemHovered())
    shown.text = with_value(tip, values, (ImGui::GetIO().MousePos.x - at.x) / (end.x - at.x));
  finish_item(context, id, shown);

  ImDrawList* list = ImGui::GetWindowDrawList();
  const float alpha = ImGui::GetStyle().Alpha, pad = look.px(6);
  list->AddRectFilled(at, end, faded(look.sunken, alpha), look.px(4));
  if (values.size() >= 2) {
    const auto heights = plot_heights(values, plot);
    std::vector<ImVec2> line;
    line.reserve(heights.size());
    const float room = end.y - at.y - 2 * pad - look.px(16);
    const float step = (end.x - at.x - 2 * pad) / static_cast<float>(heights.size() - 1);
    for (std::size_t i = 0; i < heights.size(); ++i)
      line.emplace_back(at.x + pad + step * static_cast<float>(i), end.y - pad - heights[i] * room);
    list->AddPolyline(line.data(), static_cast<int>(line.size()), faded(plot.color, alpha), 0, look.px(1.5F));
  }
  draw_text(ImVec2(at.x + pad, at.y + look.px(2)), ImVec2(end.x - look.px(8), at.y + look.px(20)), look.ink_quiet,
            plot.caption, 1);
  end_row(context, {at, end, at.x});
}

} // namespace oversketch
