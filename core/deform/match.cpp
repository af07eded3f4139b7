#include "core/deform/match.h"

#include "core/base/check.h"
#include "core/deform/match_path.h"
#include "core/deform/match_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace oversketch {
namespace {

constexpr int kCoarse = 96;
constexpr int kFine = 320;
/// Largest stray of a path from even arc length, part of the length.
constexpr double kCoarseBand = 0.35;
/// Half the width of the fine search around the coarse path, part of the length.
constexpr double kFineBand = 0.03;
/// Reach of the turning angles: wide to find the right match, half as wide to place it.
constexpr double kWide = 1.0;
constexpr double kNear = 0.5;
constexpr float kDirection = 0.02F;
constexpr float kStrongDirection = 0.3F;
/// Once the turn of the whole is known, directions tell more.
constexpr float kTurnedDirection = 0.1F;
/// A cost beyond which shape decides nothing.
constexpr double kPoorMatch = 0.2;
/// Runners-up differ from better matches by this in the mean, part of the length.
constexpr double kDistinct = 0.04;
/// How far a partner is moved to see how sharply shape decides, part of the length.
constexpr double kCertaintyShift = 0.015;
/// Costs nearer than this are equal, and at most so many of them are looked at.
constexpr double kSymmetric = 0.008;
constexpr int kMostSymmetric = 6;
/// By how much coarse costs of equal matches differ.
constexpr double kCoarseNoise = 0.03;
/// Most steps of slope 6 and less that a piece may need on average.
constexpr int kSteepest = 4;
/// Paths of equal cost exist wherever curves are straight or symmetric: this decides by place, not by rounding.
constexpr float kTieBreak = 1e-4F;

float tie_break(int i, int j) {
  std::uint32_t h = static_cast<std::uint32_t>(i) * 0x9E3779B1U ^ static_cast<std::uint32_t>(j) * 0x85EBCA77U;
  h ^= h >> 15;
  h *= 0x2C1B3C6DU;
  h ^= h >> 13;
  return kTieBreak * static_cast<float>(h >> 8) / static_cast<float>(1U << 24);
}

/// A match by parts of the smoothed length.
struct Route {
  std::vector<double> u;
  std::vector<double> v;
  double cost = 0;
};

using Profile = MatchSource::Profile;

PathBand band_for_shift(int shift) {
  const int width = static_cast<int>(kCoarseBand * kCoarse);
  PathBand band;
  for (int i = 0; i <= kCoarse; ++i) {
    band.low.push_back(shift + std::max(0, i - width));
    band.high.push_back(shift + std::min(kCoarse, i + width));
  }
  return band;
}

/// All cyclic shifts at kCoarse samples: what each costs, and the path of any of them.
class CoarseSearch {
public:
  CoarseSearch(const Profile& outline, const Profile& sketch, DirectionTerm direction)
      : table_(kCoarse + 1, 2 * kCoarse + 1), costs_(kCoarse) {
    const auto a = outline.samples(kCoarse, 0, 1, kWide), b = sketch.samples(kCoarse, 0, 1, kWide);
    for (int i = 0; i <= kCoarse; ++i)
      for (int j = 0; j < kCoarse; ++j)
        table_.row(i)[j] = shape_cost(a[i % kCoarse], b[j], direction) + tie_break(i % kCoarse, j);
    for (int i = 0; i <= kCoarse; ++i)
      for (int j = kCoarse; j <= 2 * kCoarse; ++j)
        table_.row(i)[j] = table_.row(i)[j - kCoarse];
    for (int k = 0; k < kCoarse; ++k)
      costs_[k] = finder_.find(table_, band_for_shift(k), k, k + kCoarse) / static_cast<float>(kCoarse);
  }

  /// Shifts that cost less than their neighbours, cheapest first; never none.
  std::vector<int> best_shifts() const {
    std::vector<int> shifts;
    for (int k = 0; k < kCoarse; ++k) {
      const float before = costs_[(k + kCoarse - 1) % kCoarse], after = costs_[(k + 1) % kCoarse];
      if (costs_[k] <= before && costs_[k] < after) shifts.push_back(k);
    }
    if (shifts.empty()) shifts.push_back(0);
    std::stable_sort(shifts.begin(), shifts.end(), [&](int a, int b) { return costs_[a] < costs_[b]; });
    return shifts;
  }

  double cost(int shift) const { return costs_[shift]; }

  Route route(int shift) {
    const PathBand band = band_for_shift(shift);
    Route route;
    route.cost = finder_.find(table_, band, shift, shift + kCoarse) / static_cast<float>(kCoarse);
    for (const auto& [i, j] : finder_.trace(table_, band, shift, shift + kCoarse)) {
      route.u.push_back(static_cast<double>(i) / kCoarse);
      route.v.push_back(static_cast<double>(j) / kCoarse);
    }
    return route;
  }

private:
  CostTable table_;
  PathFinder finder_;
  std::vector<float> costs_;
};

/// v at u by linear interpolation between the nodes of a route that spans one round.
double follow(const Route& route, double u) {
  const double turns = std::floor(u - route.u.front());
  const double at = u - turns;
  const auto next = std::upper_bound(route.u.begin(), route.u.end(), at);
  const auto k =
      std::clamp<std::ptrdiff_t>(next - route.u.begin() - 1, 0, static_cast<std::ptrdiff_t>(route.u.size()) - 2);
  const double gap = route.u[k + 1] - route.u[k];
  const double t = gap > 0 ? (at - route.u[k]) / gap : 0.0;
  return turns + route.v[k] + t * (route.v[k + 1] - route.v[k]);
}

/// The node where both curves bend most alike: the safest place to cut the round open.
std::size_t find_anchor(const Profile& outline, const Profile& sketch, const Route& route) {
  std::size_t best = 0;
  float most = -std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k + 1 < route.u.size(); ++k) {
    const ShapeSample a = outline.sample(route.u[k], kWide), b = sketch.sample(route.v[k], kWide);
    const float bend = 1 - a.turning[2];
    const float value = bend - 4 * shape_cost(a, b, {});
    if (value > most + kTieBreak) most = value, best = k;
  }
  return best;
}

/// Directions compared as if the outline were turned like the sketch along this route: the turn itself costs nothing.
DirectionTerm direction_along(const Profile& outline, const Profile& sketch, const Route& route) {
  double c = 0, s = 0;
  for (std::size_t k = 0; k + 1 < route.u.size(); ++k) {
    const auto a = outline.sample(route.u[k], kWide).direction, b = sketch.sample(route.v[k], kWide).direction;
    const double part = route.u[k + 1] - route.u[k];
    c += part * (a[0] * b[0] + a[1] * b[1]);
    s += part * (a[0] * b[1] - a[1] * b[0]);
  }
  const double norm = std::hypot(c, s);
  if (!(norm > 0)) return {};
  return {kTurnedDirection, static_cast<float>(c / norm), static_cast<float>(s / norm)};
}

/// Once more at kFine samples near a coarse route, cut open at its anchor, whose partner is free within a coarse step.
Route refine(const Profile& outline, const Profile& sketch, const Route& coarse) {
  const DirectionTerm direction = direction_along(outline, sketch, coarse);
  const std::size_t anchor = find_anchor(outline, sketch, coarse);
  const double u0 = coarse.u[anchor], v0 = coarse.v[anchor];
  const int width = static_cast<int>(kFineBand * kFine), free = 1 + kFine / kCoarse, margin = width + 1;
  const int columns = kFine + 2 * margin + 1;
  CostTable table(kFine + 1, columns);
  PathBand band;
  const auto a = outline.samples(kFine + 1, u0, u0 + 1 + 1.0 / kFine, kNear);
  const auto b = sketch.samples(columns, v0 - static_cast<double>(margin) / kFine,
                                v0 + static_cast<double>(columns - margin) / kFine, kNear);
  for (int i = 0; i <= kFine; ++i) {
    const double centre = (follow(coarse, u0 + static_cast<double>(i) / kFine) - v0) * kFine + margin;
    // The partner of the last row is the first's, one round on: both ends of the band must hold it.
    band.low.push_back(std::clamp(static_cast<int>(std::floor(centre)) - width, 0, columns - 1));
    band.high.push_back(std::clamp(static_cast<int>(std::ceil(centre)) + width, 0, columns - 1));
    for (int j = band.low[i]; j <= band.high[i]; ++j)
      table.row(i)[j] = shape_cost(a[i], b[j], direction) + tie_break(i % kFine, j % kFine);
  }
  PathFinder finder;
  float best = std::numeric_limits<float>::infinity();
  int best_first = margin;
  for (int first = margin - free; first <= margin + free; ++first) {
    const float cost = finder.find(table, band, first, first + kFine);
    if (cost < best - kTieBreak) best = cost, best_first = first;
  }
  if (!std::isfinite(best)) return coarse;
  finder.find(table, band, best_first, best_first + kFine);
  Route fine;
  fine.cost = best / static_cast<float>(kFine);
  for (const auto& [i, j] : finder.trace(table, band, best_first, best_first + kFine)) {
    fine.u.push_back(u0 + static_cast<double>(i) / kFine);
    fine.v.push_back(v0 + static_cast<double>(j - margin) / kFine);
  }
  return fine;
}

/// How far apart two routes are in the mean over the outline, part of the length.
double route_distance(const Route& a, const Route& b) {
  double sum = 0;
  for (int k = 0; k < kCoarse; ++k) {
    const double gap = follow(a, static_cast<double>(k) / kCoarse) - follow(b, static_cast<double>(k) / kCoarse);
    sum += std::abs(gap - std::round(gap));
  }
  return sum / kCoarse;
}

/// How much a route turns the curve, 0…2: the mean of 1 − cos between the directions.
double measure_turn(const Profile& outline, const Profile& sketch, const Route& route) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < route.u.size(); ++k) {
    const ShapeSample a = outline.sample(route.u[k], kWide), b = sketch.sample(route.v[k], kWide);
    const double along = a.direction[0] * b.direction[0] + a.direction[1] * b.direction[1];
    sum += (1 - along) * (route.u[k + 1] - route.u[k]);
  }
  return sum;
}

/// Cheapest first; among those that cost nearly as little as the cheapest, the one that turns least comes first: they
/// are the ways in which a symmetric shape fits itself, and their costs differ by sampling alone.
void sort_routes(const Profile& outline, const Profile& sketch, std::vector<Route>& routes) {
  std::stable_sort(routes.begin(), routes.end(), [](const Route& a, const Route& b) { return a.cost < b.cost; });
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < routes.size() && routes[k].cost < routes.front().cost + kSymmetric; ++k) {
    const double turn = measure_turn(outline, sketch, routes[k]);
    if (turn < least - kSymmetric) least = turn, best = k;
  }
  std::rotate(routes.begin(), routes.begin() + static_cast<std::ptrdiff_t>(best),
              routes.begin() + static_cast<std::ptrdiff_t>(best) + 1);
}

std::optional<std::vector<Route>> find_routes(const Profile& outline, const Profile& sketch, int count,
                                              const Watch& watch) {
  DirectionTerm direction{kDirection};
  std::optional<CoarseSearch> search(std::in_place, outline, sketch, direction);
  if (watch.stopped()) return std::nullopt;
  auto shifts = search->best_shifts();
  if (search->cost(shifts.front()) > kPoorMatch) {
    direction.weight = kStrongDirection;
    search.emplace(outline, sketch, direction);
    shifts = search->best_shifts();
  }
  std::vector<Route> routes;
  const double limit = search->cost(shifts.front()) + kCoarseNoise;
  for (const int shift : shifts) {
    if (watch.stopped()) return std::nullopt;
    const auto found = static_cast<int>(routes.size());
    if (found >= std::max(count, kMostSymmetric) || (found >= count && search->cost(shift) > limit)) break;
    const Route coarse = search->route(shift);
    const auto near = [&](const Route& other) { return route_distance(coarse, other) < kDistinct; };
    if (std::any_of(routes.begin(), routes.end(), near)) continue;
    routes.push_back(refine(outline, sketch, coarse));
  }
  sort_routes(outline, sketch, routes);
  routes.resize(std::min(routes.size(), static_cast<std::size_t>(count)));
  return routes;
}

/// The cheapest path between two pins that follow each other; adds its nodes but for the last one.
void match_piece(const Profile& outline, const Profile& sketch, double u0, double u1, double v0, double v1, Route& to) {
  int rows = std::max(1, static_cast<int>(std::lround(kFine * (u1 - u0))));
  int columns = std::max(1, static_cast<int>(std::lround(kFine * (v1 - v0))));
  rows = std::max(rows, (columns + kSteepest - 1) / kSteepest);
  columns = std::max(columns, (rows + kSteepest - 1) / kSteepest);
  const auto a = outline.samples(rows + 1, u0, u1 + (u1 - u0) / rows, kNear);
  const auto b = sketch.samples(columns + 1, v0, v1 + (v1 - v0) / columns, kNear);
  CostTable table(rows + 1, columns + 1);
  PathBand band;
  for (int i = 0; i <= rows; ++i) {
    band.low.push_back(0);
    band.high.push_back(columns);
    for (int j = 0; j <= columns; ++j)
      table.row(i)[j] = shape_cost(a[i], b[j], {}) + tie_break(i, j);
  }
  PathFinder finder;
  const float cost = finder.find(table, band, 0, columns);
  to.cost += cost * (u1 - u0) / rows;
  for (const auto& [i, j] : finder.trace(table, band, 0, columns)) {
    if (i == rows) break;
    to.u.push_back(u0 + (u1 - u0) * i / rows);
    to.v.push_back(v0 + (v1 - v0) * j / columns);
  }
}

/// What moving the partner either way costs, the smaller of both.
double measure_certainty(const Profile& outline, const Profile& sketch, double u, double v) {
  const ShapeSample own = outline.sample(u, kNear);
  const float here = shape_cost(own, sketch.sample(v, kNear), {});
  const float before = shape_cost(own, sketch.sample(v - kCertaintyShift, kNear), {});
  const float after = shape_cost(own, sketch.sample(v + kCertaintyShift, kNear), {});
  return std::max(0.0F, std::min(before, after) - here);
}

Match make_match(const Profile& outline, const Profile& sketch, const Route& route) {
  Match match;
  match.cost = route.cost;
  for (std::size_t k = 0; k < route.u.size(); ++k) {
    match.outline_s.push_back(outline.s_at(route.u[k]));
    match.sketch_s.push_back(sketch.s_at(route.v[k]));
    match.certainty.push_back(measure_certainty(outline, sketch, route.u[k], route.v[k]));
  }
  return match;
}

/// Pins split the round into pieces; sorted along the outline, unwrapped on both curves.
Match match_pinned(const MatchSource& source, const ClosedCurve& sketch, const Profile& target,
                   std::vector<PinPlace> pins) {
  std::sort(pins.begin(), pins.end(), [](const PinPlace& a, const PinPlace& b) { return a.outline_s < b.outline_s; });
  const auto repeats = [](const PinPlace& a, const PinPlace& b) { return b.outline_s <= a.outline_s; };
  pins.erase(std::unique(pins.begin(), pins.end(), repeats), pins.end());
  for (std::size_t k = 1; k < pins.size(); ++k)
    pins[k].sketch_s = pins[k - 1].sketch_s + sketch.forward(pins[k - 1].sketch_s, pins[k].sketch_s);
  pins.push_back({pins.front().outline_s + source.outline().length(), pins.front().sketch_s + sketch.length()});
  const Profile& own = source.profile();
  Route route;
  std::vector<std::size_t> at;
  for (std::size_t k = 0; k + 1 < pins.size(); ++k) {
    at.push_back(route.u.size());
    match_piece(own, target, own.u_at(pins[k].outline_s), own.u_at(pins[k + 1].outline_s),
                target.u_at(pins[k].sketch_s), target.u_at(pins[k + 1].sketch_s), route);
  }
  at.push_back(route.u.size());
  route.u.push_back(route.u.front() + 1);
  route.v.push_back(route.v.front() + 1);
  Match match = make_match(own, target, route);
  for (std::size_t k = 0; k < pins.size(); ++k) {
    match.outline_s[at[k]] = pins[k].outline_s;
    match.sketch_s[at[k]] = pins[k].sketch_s;
  }
  return match;
}

} // namespace

namespace {

/// Where s lies between the nodes of a match: index of the node before it, part of the way to the next, rounds.
struct NodePlace {
  std::size_t node = 0;
  double part = 0;
  double turns = 0;
};

NodePlace find_node(const std::vector<double>& outline_s, double s) {
  CHECK(outline_s.size() >= 2, "a match has nodes");
  const double turns = std::floor((s - outline_s.front()) / (outline_s.back() - outline_s.front()));
  const double at = s - turns * (outline_s.back() - outline_s.front());
  const auto next = std::upper_bound(outline_s.begin(), outline_s.end(), at);
  const auto last = static_cast<std::ptrdiff_t>(outline_s.size()) - 2;
  const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next - outline_s.begin() - 1, 0, last));
  const double gap = outline_s[k + 1] - outline_s[k];
  return {k, gap > 0 ? std::clamp((at - outline_s[k]) / gap, 0.0, 1.0) : 0.0, turns};
}

} // namespace

double Match::sketch_at(double s) const {
  const auto [k, t, turns] = find_node(outline_s, s);
  return turns * (sketch_s.back() - sketch_s.front()) + sketch_s[k] + t * (sketch_s[k + 1] - sketch_s[k]);
}

double Match::certainty_at(double s) const {
  const auto [k, t, turns] = find_node(outline_s, s);
  return certainty[k] + t * (certainty[k + 1] - certainty[k]);
}

MatchSource::MatchSource(const ClosedCurve& outline)
    : outline_(outline), profile_(std::make_shared<const Profile>(outline)) {}

Result<std::vector<Match>> match_curves(const MatchSource& source, const ClosedCurve& sketch,
                                        std::span<const PinPlace> pins, const MatchOptions& options,
                                        const Watch& watch) {
  CHECK(options.alternatives >= 0, "alternatives are counted from 0");
  if (watch.stopped()) return cancelled();
  const Profile target(sketch);
  if (!pins.empty()) return std::vector{match_pinned(source, sketch, target, {pins.begin(), pins.end()})};
  const auto routes = find_routes(source.profile(), target, 1 + options.alternatives, watch);
  if (!routes) return cancelled();
  std::vector<Match> matches;
  for (const Route& route : *routes)
    matches.push_back(make_match(source.profile(), target, route));
  return matches;
}

} // namespace oversketch
