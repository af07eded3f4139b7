#include "core/deform/match.h"

#include "core/deform/cleanup.h"
#include "core/deform/match_path.h"
#include "tests/support/random_bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace oversketch {
namespace {

using testing::bend_at_random;
using testing::named_shapes;

ClosedCurve dense(const Points& shape) {
  return ClosedCurve(resample(ClosedCurve(shape), 400));
}

Match best_match(const ClosedCurve& outline, const ClosedCurve& sketch, std::span<const PinPlace> pins = {}) {
  auto matches = match_curves(MatchSource(outline), sketch, pins, {}, {});
  EXPECT_TRUE(matches.ok());
  return matches->front();
}

/// Mean distance of the matched points from where they belong, part of the sketch's length.
double mean_error(const ClosedCurve& outline, const ClosedCurve& sketch, const Match& match, const Points& truth) {
  double sum = 0;
  for (int i = 0; i < outline.size(); ++i)
    sum += distance(sketch.at(match.sketch_at(outline.s_at(i))), truth[i]);
  return sum / outline.size() / sketch.length();
}

TEST(Match, PinsThatCannotHoldAreRefusedAndNamed) {
  const ClosedCurve curve = dense(testing::ellipse_shape());
  const double whole = curve.length();
  const auto pin = [&](double from, double to) { return PinPair{curve.at(from * whole), curve.at(to * whole)}; };
  const auto refused = [&](std::vector<PinPair> pins) {
    const auto places = place_pins(curve, curve, pins);
    return places.ok() ? std::string() : places.error().code + " " + places.error().where;
  };
  EXPECT_EQ(refused({pin(0.1, 0.1), pin(0.5, 0.5)}), "");
  EXPECT_EQ(refused({pin(0.1, 0.1), pin(0.4, 0.62), pin(0.6, 0.58), pin(0.8, 0.8)}), "deform.pins-cross pins 2 and 3");
  EXPECT_EQ(refused({pin(0.1, 0.1), pin(0.8, 0.8), pin(0.6, 0.58), pin(0.4, 0.62)}), "deform.pins-cross pins 3 and 4");
  EXPECT_EQ(refused({pin(0.1, 0.1), pin(0.3, 0.3), pin(0.1, 0.6)}), "deform.pins-cross pins 1 and 3");
  EXPECT_EQ(refused({pin(0.1, 0.1), pin(0.3, 0.1)}), "deform.pins-cross pins 1 and 2");
  EXPECT_EQ(refused({pin(0.1, 0.1), pin(0.1, 0.1), pin(0.5, 0.6)}), "");
}

TEST(Match, StopsWhenAsked) {
  const ClosedCurve curve = dense(testing::fish_shape());
  std::stop_source source;
  source.request_stop();
  const auto matches = match_curves(MatchSource(curve), curve, {}, {}, {source.get_token(), {}, nullptr});
  ASSERT_FALSE(matches.ok());
  EXPECT_EQ(matches.error(), cancelled());
}

TEST(Match, IsAMonotoneRound) {
  for (std::uint32_t seed = 0; seed < 21; ++seed) {
    const auto [name, shape] = named_shapes()[seed % 7];
    const auto pair = bend_at_random(shape, seed);
    const ClosedCurve outline(pair.outline), sketch(clean_sketch(pair.sketch, outline.signed_area())->curve);
    const auto matches = match_curves(MatchSource(outline), sketch, {}, {3}, {});
    ASSERT_TRUE(matches.ok());
    for (const Match& match : *matches) {
      EXPECT_NEAR(match.outline_s.back() - match.outline_s.front(), outline.length(), 1e-9 * outline.length());
      EXPECT_NEAR(match.sketch_s.back() - match.sketch_s.front(), sketch.length(), 1e-9 * sketch.length());
      for (std::size_t k = 1; k < match.outline_s.size(); ++k) {
        EXPECT_GT(match.outline_s[k], match.outline_s[k - 1]) << name << seed;
        EXPECT_GT(match.sketch_s[k], match.sketch_s[k - 1]) << name << seed;
      }
      EXPECT_NEAR(match.sketch_at(outline.length() + 5) - match.sketch_at(5), sketch.length(), 1e-9 * sketch.length());
      EXPECT_GE(match.cost, 0);
    }
  }
}

TEST(Match, FindsItselfMovedTurnedAndScaled) {
  for (const auto& [name, shape] : named_shapes()) {
    const ClosedCurve outline = dense(shape);
    Points moved = transformed(outline.points(), {std::polar(2.5, 0.5), {1000, -300}});
    Points truth = moved;
    std::rotate(moved.begin(), moved.begin() + 123, moved.end());
    const ClosedCurve sketch(moved);
    const Match match = best_match(outline, sketch);
    EXPECT_LT(match.cost, 0.03) << name;
    EXPECT_LT(mean_error(outline, sketch, match, truth), 0.004) << name;
  }
}

TEST(Match, FindsBendsOfTheSameShape) {
  std::vector<double> errors;
  for (const auto& [name, shape] : named_shapes()) {
    if (name == "ellipse" || name == "blob") continue;
    for (std::uint32_t seed = 100; seed < 108; ++seed) {
      const auto pair = bend_at_random(shape, seed, 0.25);
      const ClosedCurve outline(pair.outline), sketch(clean_sketch(pair.sketch, outline.signed_area())->curve);
      errors.push_back(mean_error(outline, sketch, best_match(outline, sketch), pair.truth));
      EXPECT_LT(errors.back(), 0.05) << name << " " << seed;
    }
  }
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.008);
}

TEST(Match, CostTellsSameShapesFromOthers) {
  const auto shapes = named_shapes();
  std::vector<double> same, other;
  for (const auto& [name, shape] : shapes) {
    const auto pair = bend_at_random(shape, 77, 0.2);
    const ClosedCurve outline(pair.outline);
    same.push_back(best_match(outline, clean_sketch(pair.sketch, outline.signed_area())->curve).cost);
    for (const auto& [other_name, other_shape] : shapes)
      if (other_name != name) {
        const ClosedCurve sketch = clean_sketch(other_shape, outline.signed_area())->curve;
        other.push_back(best_match(outline, sketch).cost);
      }
  }
  std::sort(other.begin(), other.end());
  EXPECT_LT(*std::max_element(same.begin(), same.end()), 0.13);
  EXPECT_GT(other[other.size() / 2], 0.15);
}

TEST(Match, DependsNeitherOnScaleNorOnPlace) {
  const auto pair = bend_at_random(testing::cactus_shape(), 9);
  const ClosedCurve outline(pair.outline), sketch(clean_sketch(pair.sketch, 1.0)->curve);
  const Match first = best_match(outline, sketch);
  for (const double scale : {0.05, 20.0}) {
    const ClosedCurve other(transformed(sketch.points(), {scale, {-4000, 777}}));
    const Match second = best_match(outline, other);
    ASSERT_EQ(first.sketch_s.size(), second.sketch_s.size());
    for (std::size_t k = 0; k < first.sketch_s.size(); ++k)
      EXPECT_NEAR(second.sketch_s[k] / scale, first.sketch_s[k], 1e-7 * sketch.length());
  }
}

TEST(Match, RunnersUpDifferAndAreSorted) {
  const ClosedCurve bar = dense(testing::bar_shape());
  const ClosedCurve sketch(transformed(bar.points(), {std::polar(1.0, 0.3), {5, 5}}));
  const auto matches = match_curves(MatchSource(bar), sketch, {}, {3}, {});
  ASSERT_TRUE(matches.ok());
  ASSERT_GE(matches->size(), 2U);
  // A bar fits itself turned by half a round just as well, but for the turn.
  EXPECT_LT((*matches)[1].cost, 0.05);
  const double apart =
      std::abs(std::remainder((*matches)[1].sketch_at(0) - (*matches)[0].sketch_at(0), sketch.length()));
  EXPECT_NEAR(apart, 0.5 * sketch.length(), 0.02 * sketch.length());
  EXPECT_LT(std::abs(std::remainder((*matches)[0].sketch_at(0), sketch.length())), 0.01 * sketch.length());
}

TEST(Match, MeetsPinsExactly) {
  const ClosedCurve outline = dense(testing::fish_shape());
  const ClosedCurve sketch(bend_at_random(testing::fish_shape(), 3).sketch);
  const double a = outline.length(), b = sketch.length();
  const Match free = best_match(outline, sketch);
  for (int count = 1; count <= 4; ++count) {
    std::vector<PinPlace> pins;
    for (int k = 0; k < count; ++k) {
      const double s = std::fmod(a * (0.9 + 0.23 * k), a);
      pins.push_back({s, sketch.wrap(free.sketch_at(s) + 0.03 * b * (k % 2 == 0 ? 1 : -1))});
    }
    const Match match = best_match(outline, sketch, pins);
    for (const PinPlace& pin : pins)
      EXPECT_NEAR(std::remainder(match.sketch_at(pin.outline_s) - pin.sketch_s, b), 0, 1e-9 * b);
  }
  // Pins so unlike the lengths that no path of the usual steps would do.
  const std::vector<PinPlace> steep{{0, 0}, {0.02 * a, 0.9 * b}, {0.5 * a, 0.95 * b}};
  const Match match = best_match(outline, sketch, steep);
  for (const PinPlace& pin : steep)
    EXPECT_NEAR(std::remainder(match.sketch_at(pin.outline_s) - pin.sketch_s, b), 0, 1e-9 * b);
}

/// The same minimum by trying every path.
double cheapest_by_trial(const CostTable& costs, int i, int j, int last) {
  if (i == costs.rows - 1) return j == last ? 0 : HUGE_VAL;
  double best = HUGE_VAL;
  for (const auto& [a, b] : std::vector<std::pair<int, int>>{
           {1, 1}, {1, 2}, {2, 1}, {2, 3}, {3, 2}, {1, 3}, {3, 1}, {1, 4}, {4, 1}, {1, 6}, {6, 1}}) {
    if (i + a >= costs.rows || j + b > last) continue;
    const double slope = std::log(static_cast<double>(b) / a), length = 0.5 * (a + b);
    const double step = length * (0.5 * (costs.row(i)[j] + costs.row(i + a)[j + b]) + 0.1 * slope * slope);
    best = std::min(best, step + cheapest_by_trial(costs, i + a, j + b, last));
  }
  return best;
}

TEST(MatchPath, IsTheCheapestOfAllPaths) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> one(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    CostTable costs(9, 10);
    for (float& value : costs.values)
      value = one(random);
    const PathBand band{std::vector<int>(9, 0), std::vector<int>(9, 9)};
    PathFinder finder;
    const double cost = finder.find(costs, band, 0, 9);
    EXPECT_NEAR(cost, cheapest_by_trial(costs, 0, 0, 9), 1e-5);
    const auto path = finder.trace(costs, band, 0, 9);
    EXPECT_EQ(path.front(), std::pair(0, 0));
    EXPECT_EQ(path.back(), std::pair(8, 9));
    for (std::size_t k = 1; k < path.size(); ++k) {
      EXPECT_GT(path[k].first, path[k - 1].first);
      EXPECT_GT(path[k].second, path[k - 1].second);
    }
  }
}

} // namespace
} // namespace oversketch
