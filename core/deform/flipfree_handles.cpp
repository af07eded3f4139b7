#include "core/deform/flipfree_handles.h"

#include "core/base/check.h"

#include <algorithm>
#include <limits>

namespace oversketch {
namespace {

/// Least gap of neighbours, part of the mean gap.
constexpr double kLeastGap = 0.02;

struct Pool {
  double sum = 0;
  int count = 0;
  double mean() const { return sum / count; }
};

/// The non-decreasing sequence nearest to `values`.
void pool_violators(std::vector<double>& values) {
  std::vector<Pool> pools;
  for (const double value : values) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].count += pools.back().count;
      pools.pop_back();
    }
  }
  auto out = values.begin();
  for (const Pool& pool : pools)
    out = std::fill_n(out, pool.count, pool.mean());
}

/// Handles first … first + count − 1 (indices modulo n), in order between `low` and `high`, by steps of at least `gap`.
void order_section(std::vector<double>& s, std::size_t first, std::size_t count, double low, double high, double gap,
                   double length) {
  if (count == 0) return;
  const std::size_t n = s.size();
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + k;
    values[k] = s[i % n] + (i >= n ? length : 0.0) - gap * static_cast<double>(k);
  }
  pool_violators(values);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + k;
    const double value = std::clamp(values[k], low, std::max(low, high)) + gap * static_cast<double>(k);
    s[i % n] = value - (i >= n ? length : 0.0);
  }
}

} // namespace

void place_handles(const ClosedCurve& curve, double cell, HandlePlaces& places) {
  places.points.resize(places.s.size());
  places.tangents.resize(places.s.size());
  for (std::size_t i = 0; i < places.s.size(); ++i) {
    places.points[i] = curve.at(places.s[i]);
    places.tangents[i] = curve.smooth_tangent(places.s[i], kTangentReach * cell);
  }
}

void order_handles(std::vector<double>& s, const std::vector<Handle>& handles, double length) {
  const std::size_t n = s.size();
  CHECK(n >= 3 && handles.size() == n, "a closed curve has at least three handles");
  const double gap = kLeastGap * length / static_cast<double>(n);
  std::vector<std::size_t> pins;
  for (std::size_t i = 0; i < n; ++i)
    if (handles[i].pinned) pins.push_back(i);
  if (pins.empty()) {
    // Cut the round open where it is furthest from a violation: pools do not reach across there.
    std::size_t start = 0;
    double widest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
      const double before = i == 0 ? s[n - 1] - length : s[i - 1];
      if (s[i] - before > widest) widest = s[i] - before, start = i;
    }
    const double before = start == 0 ? s[n - 1] - length : s[start - 1];
    const double middle = 0.5 * (before + s[start]);
    order_section(s, start, n, middle + 0.5 * gap, middle + length - (static_cast<double>(n) - 0.5) * gap, gap, length);
    return;
  }
  for (std::size_t k = 0; k < pins.size(); ++k) {
    const std::size_t from = pins[k], to = k + 1 < pins.size() ? pins[k + 1] : pins[0] + n;
    const double low = s[from], high = s[to % n] + (to >= n ? length : 0.0);
    const auto inner = to - from - 1;
    const double own_gap = std::min(gap, 0.5 * (high - low) / static_cast<double>(inner + 1));
    order_section(s, from + 1, inner, low + own_gap, high - own_gap * static_cast<double>(inner), own_gap, length);
  }
}

} // namespace oversketch
