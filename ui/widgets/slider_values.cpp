#include "ui/widgets/slider.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace oversketch {
namespace {

/// Decimals that tell a number of this size apart, in the unit that is shown.
int decimals_of(double shown, const SliderSpec& spec) {
  if (spec.whole || spec.factor == 100) return 0;
  const double size = std::abs(shown);
  if (!spec.logarithmic) return spec.high - spec.low >= 20 ? 0 : 2;
  return size >= 9.95 ? 0 : size >= 0.995 ? 1 : size >= 0.0995 ? 2 : 3;
}

double round_to(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

} // namespace

std::string format_value(double value, const SliderSpec& spec) {
  const double shown = value * spec.factor;
  int decimals = decimals_of(shown, spec);
  // A typed number keeps what it says.
  while (decimals < 4 && !spec.whole && std::abs(round_to(shown, decimals) - shown) > 1e-6 * std::abs(shown))
    ++decimals;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, shown);
  return spec.unit.empty() ? std::string(text) : std::string(text) + " " + std::string(spec.unit);
}

std::optional<double> parse_value(std::string_view text, const SliderSpec& spec) {
  std::string number(text);
  std::erase(number, ' ');
  if (!spec.unit.empty() && number.ends_with(spec.unit)) number.resize(number.size() - spec.unit.size());
  std::ranges::replace(number, ',', '.');
  if (number.starts_with('+')) number.erase(0, 1);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value)) return std::nullopt;
  return value / spec.factor;
}

double share_of(double value, const SliderSpec& spec) {
  const double share = spec.logarithmic
                           ? std::log(std::max(value, spec.low) / spec.low) / std::log(spec.high / spec.low)
                           : (value - spec.low) / (spec.high - spec.low);
  return std::clamp(share, 0.0, 1.0);
}

double value_at(double share, const SliderSpec& spec) {
  const double at = std::clamp(share, 0.0, 1.0);
  const double value =
      spec.logarithmic ? spec.low * std::pow(spec.high / spec.low, at) : spec.low + at * (spec.high - spec.low);
  const double shown = value * spec.factor;
  return std::clamp(round_to(shown, decimals_of(shown, spec)) / spec.factor, spec.low, spec.high);
}

} // namespace oversketch
