#include "core/deform/match.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace oversketch {
namespace {

/// Rounds of the sketch that the pins make in this order, in units of its length: 1 when they can all hold.
double count_rounds(const ClosedCurve& sketch, const std::vector<PinPlace>& pins, const std::vector<int>& order) {
  double sum = 0;
  for (std::size_t k = 0; k < order.size(); ++k)
    sum += sketch.forward(pins[order[k]].sketch_s, pins[order[(k + 1) % order.size()]].sketch_s);
  return sum / sketch.length();
}

std::optional<Error> find_contradiction(const ClosedCurve& outline, const ClosedCurve& sketch,
                                        const std::vector<PinPlace>& pins) {
  const auto gap = [](const ClosedCurve& curve, double a, double b) {
    return std::min(curve.forward(a, b), curve.forward(b, a)) / curve.length();
  };
  constexpr double kSame = 1e-9;
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(pins.size()); ++i) {
    for (int j = 0; j < i; ++j) {
      const bool same_outline = gap(outline, pins[i].outline_s, pins[j].outline_s) < kSame;
      const bool same_sketch = gap(sketch, pins[i].sketch_s, pins[j].sketch_s) < kSame;
      if (same_outline != same_sketch) return pins_cross(j, i);
    }
    order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return pins[a].outline_s < pins[b].outline_s; });
  if (pins.size() < 3 || count_rounds(sketch, pins, order) < 1.5) return std::nullopt;
  std::pair<int, int> named{order[0], order[1]};
  double closest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < order.size(); ++k) {
    auto exchanged = order;
    std::swap(exchanged[k], exchanged[(k + 1) % order.size()]);
    const int a = order[k], b = order[(k + 1) % order.size()];
    const double apart = gap(sketch, pins[a].sketch_s, pins[b].sketch_s);
    if (count_rounds(sketch, pins, exchanged) < 1.5 && apart < closest) closest = apart, named = {a, b};
  }
  return pins_cross(std::min(named.first, named.second), std::max(named.first, named.second));
}

} // namespace

Result<std::vector<PinPlace>> place_pins(const ClosedCurve& outline, const ClosedCurve& sketch,
                                         std::span<const PinPair> pins) {
  std::vector<PinPlace> places;
  for (const PinPair& pin : pins)
    places.push_back({outline.nearest(pin.outline).s, sketch.nearest(pin.sketch).s});
  if (const auto error = find_contradiction(outline, sketch, places)) return *error;
  return places;
}

} // namespace oversketch
