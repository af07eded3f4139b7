#include "core/deform/flipfree_warm.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oversketch {
namespace {

/// Sine of the angle between two segments below which they are one line: a join that was put on a segment is on it but
/// for rounding.
constexpr double kSameWay = 1e-9;

/// Indices of points sorted by place, so that equal points can be found.
std::vector<int> sort_points(const Points& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(points[a].x, points[a].y) < std::pair(points[b].x, points[b].y); });
  return order;
}

int find_point(const Points& points, const std::vector<int>& order, Point p) {
  const auto at = std::lower_bound(order.begin(), order.end(), p, [&](int a, Point q) {
    return std::pair(points[a].x, points[a].y) < std::pair(q.x, q.y);
  });
  return at != order.end() && points[*at] == p ? *at : -1;
}

/// Length from point `from` over `segments` segments.
double run_length(const ClosedCurve& curve, int from, int segments) {
  if (segments >= curve.size()) return curve.length();
  return curve.forward(curve.s_at(from), curve.s_at((from + segments) % curve.size()));
}

/// From a point that both curves have, how far two ways out of it are one: a segment that was redrawn in its middle.
double shared_length(Point from, Point old_to, Point new_to) {
  const Point a = old_to - from, b = new_to - from;
  const double least = std::min(length(a), length(b));
  const bool same = dot(a, b) > 0 && std::abs(cross(a, b)) <= kSameWay * length(a) * length(b);
  return same ? least : 0.0;
}

} // namespace

double CurveRemap::operator()(double s) const {
  const double turns = std::floor((s - old_from) / old_length), along = s - turns * old_length - old_from;
  const double base = new_from + turns * new_length;
  if (along <= common) return base + along;
  const double rest = old_length - common, new_rest = new_length - common;
  return base + common + (rest > 0 ? (along - common) / rest * new_rest : 0.0);
}

bool CurveRemap::redrawn(double s) const {
  const double turns = std::floor((s - old_from) / old_length);
  return s - turns * old_length - old_from > common;
}

std::optional<CurveRemap> find_remap(const ClosedCurve& before, const ClosedCurve& after) {
  const Points &old_points = before.points(), &new_points = after.points();
  const auto order = sort_points(old_points);
  const int n = after.size(), m = before.size();
  CurveRemap best;
  const auto extend = [&](int i, int j, int run) {
    const auto old_at = [&](int k) { return old_points[static_cast<std::size_t>((k + m) % m)]; };
    const auto new_at = [&](int k) { return new_points[static_cast<std::size_t>((k + n) % n)]; };
    if (run >= std::min(n, m)) return;
    const double ahead = shared_length(new_at(i + run), old_at(j + run + 1), new_at(i + run + 1));
    const double behind = shared_length(new_at(i), old_at(j - 1), new_at(i - 1));
    if (best.common + ahead + behind > std::min(best.old_length, best.new_length)) return;
    best.old_from -= behind;
    best.new_from -= behind;
    best.common += ahead + behind;
  };
  for (int i = 0; i < n;) {
    const int j = find_point(old_points, order, new_points[i]);
    int run = 0;
    if (j >= 0)
      while (run < std::min(n, m) && new_points[(i + run + 1) % n] == old_points[(j + run + 1) % m])
        ++run;
    const double common = run > 0 ? run_length(after, i, run) : 0.0;
    if (common > best.common) {
      best = {before.s_at(j), after.s_at(i), common, before.length(), after.length()};
      extend(i, j, run);
    }
    i += run + 1;
  }
  if (best.common < kLeastCommon * std::max(before.length(), after.length())) return std::nullopt;
  return best;
}

} // namespace oversketch
