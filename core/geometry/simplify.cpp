#include "core/geometry/curve.h"

#include <cstddef>
#include <utility>

namespace oversketch {

namespace {

using Range = std::pair<std::size_t, std::size_t>;

/// Squared distance to a chord, ready for many points.
struct Chord {
  Point start;
  Point end;
  Point along = end - start;
  double squared_length = dot(along, along);
  double inverse = squared_length > 0 ? 1 / squared_length : 0;

  double squared_distance(Point p) const {
    const Point away = p - start;
    const double reach = dot(away, along);
    if (!(reach > 0)) return dot(away, away);
    if (reach >= squared_length) return dot(p - end, p - end);
    const double off = cross(along, away);
    return off * off * inverse;
  }
};

/// Marks what must stay of ring[from…to], both ends being kept already.
void keep_between(const Points& ring, Range whole, double tolerance, std::vector<char>& kept) {
  std::vector<Range> open{whole};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    const Chord chord{ring[from], ring[to]};
    double furthest = tolerance * tolerance;
    std::size_t split = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double squared = chord.squared_distance(ring[i]);
      if (squared > furthest) furthest = squared, split = i;
    }
    if (split == from) continue;
    kept[split] = 1;
    open.emplace_back(from, split);
    open.emplace_back(split, to);
  }
}

std::size_t furthest_from_first(const Points& points) {
  std::size_t furthest = 0;
  double most = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point away = points[i] - points[0];
    if (dot(away, away) > most) most = dot(away, away), furthest = i;
  }
  return furthest;
}

} // namespace

Points simplify(const Points& points, double tolerance, bool closed) {
  CHECK(tolerance >= 0, "tolerance must be 0 or more");
  if (points.size() < 3) return points;
  Points ring = points;
  std::vector<char> kept(points.size() + 1, 0);
  kept[0] = 1;
  if (closed) {
    const std::size_t furthest = furthest_from_first(points);
    if (furthest == 0) return {points[0]};
    ring.push_back(points[0]);
    kept[furthest] = 1;
    keep_between(ring, {0, furthest}, tolerance, kept);
    keep_between(ring, {furthest, points.size()}, tolerance, kept);
  } else {
    kept[points.size() - 1] = 1;
    keep_between(ring, {0, points.size() - 1}, tolerance, kept);
  }
  Points out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) out.push_back(points[i]);
  return out;
}

} // namespace oversketch
