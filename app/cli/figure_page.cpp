#include "app/cli/figure_page.h"

#include <cmath>
#include <cstdio>

namespace oversketch::cli {

Result<Lettering> Lettering::load(const std::filesystem::path& assets) {
  auto regular = Font::load(assets / "fonts" / "Inter-Regular.otf");
  if (!regular) return regular.error();
  auto strong = Font::load(assets / "fonts" / "Inter-SemiBold.otf");
  if (!strong) return strong.error();
  return Lettering{std::move(*regular), std::move(*strong)};
}

Page::Page(int width, int height, const Lettering& lettering)
    : Canvas(width, height, color_of(kPaperColor)), lettering_(lettering) {}

void Page::write(std::initializer_list<Words> line, double size, Point at, Align align) {
  const auto font = [&](const Words& words) -> const Font& {
    return words.strong ? lettering_.strong : lettering_.regular;
  };
  if (align == Align::kCentre)
    for (const Words& words : line)
      at.x -= 0.5 * font(words).width(words.text, size);
  for (const Words& words : line) {
    fill(font(words).outlines(words.text, size, at), color_of(words.color));
    at.x += font(words).width(words.text, size);
  }
}

void Page::head(const std::string& title, const std::string& subtitle) {
  write({{title, kInkColor, true}}, kTitleSize, {kMargin, kMargin + 30.0});
  write({{subtitle, kQuietColor}}, kTextSize, {kMargin, kMargin + 68.0});
}

void Page::rule(double y) {
  rectangle(kMargin, y, width() - 2 * kMargin, 2, color_of(kRuleColor));
}

std::string number_text(double value, int decimals) {
  if (!std::isfinite(value)) return value > 0 ? "∞" : "–";
  char printed[64];
  std::snprintf(printed, sizeof printed, "%.*f", decimals, value);
  std::string text = printed;
  const auto point = text.find('.');
  const std::size_t whole = point == std::string::npos ? text.size() : point;
  for (std::size_t i = whole; i > 3 && text[i - 4] != '-'; i -= 3)
    text.insert(i - 3, "\u2009");
  return text;
}

} // namespace oversketch::cli
