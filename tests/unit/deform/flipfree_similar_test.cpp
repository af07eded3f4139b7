// The flip-free method where the sketch is the outline's own shape, and where it begins.

#include "core/deform/flipfree.h"
#include "core/deform/flipfree_align.h"
#include "core/deform/flipfree_frame.h"
#include "tests/support/random_bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oversketch {
namespace {

/// Six teeth, one of them a little longer: a shape that fits itself nearly as well a sixth of a turn on.
Points nearly_even_gear() {
  return testing::polar_shape(300,
                              [](double a) { return 200 + 50 * std::tanh(3 * std::cos(6 * a)) + 20 * std::cos(a); });
}

double similar_gap(const Points& a, const Points& b) {
  EXPECT_EQ(a.size(), b.size());
  double gap = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    gap = std::max(gap, distance(a[i], b[i]));
  return gap;
}

Points started_at(Points points, std::size_t first) {
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(first), points.end());
  return points;
}

struct Spaced {
  Points points;
  std::vector<double> s;
};

Spaced spaced(const ClosedCurve& curve, int count) {
  Spaced out{resample(curve, count), {}};
  for (int i = 0; i < count; ++i)
    out.s.push_back(curve.length() * i / count);
  return out;
}

TEST(FindSimilar, FindsAnyTurn) {
  const ClosedCurve outline(nearly_even_gear());
  const auto [points, s] = spaced(outline, 170);
  for (const double turn : {-3.0, -1.0, 0.0, 0.5, 2.6}) {
    const Similarity by{std::polar(0.3, turn), {5, 6}};
    const ClosedCurve curve(started_at(transformed(outline.points(), by), 77));
    const auto found = find_similar(points, outline, s, curve, 1e-3);
    ASSERT_TRUE(found.has_value()) << turn;
    EXPECT_NEAR(found->turn, turn, 1e-9);
    EXPECT_LT(found->distance, 1e-9);
    for (std::size_t i = 0; i < s.size(); ++i)
      EXPECT_LT(distance(curve.at(found->s[i]), by(points[i])), 1e-9) << turn;
  }
}

TEST(FindSimilar, TurnsAsLittleAsTheShapeAllows) {
  const ClosedCurve outline(testing::star_shape());
  const auto [points, s] = spaced(outline, 200);
  const double fifth = 2 * std::numbers::pi / 5;
  const ClosedCurve curve(transformed(outline.points(), {std::polar(1.0, 2 * fifth + 0.3), {}}));
  const auto found = find_similar(points, outline, s, curve, 1e-3);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->turn, 0.3, 1e-6);
}

TEST(FindSimilar, FindsNothingWhereShapesDiffer) {
  const ClosedCurve outline(nearly_even_gear());
  const auto [points, s] = spaced(outline, 170);
  EXPECT_FALSE(find_similar(points, outline, s, ClosedCurve(testing::fish_shape()), 1e-3).has_value());
  Points dented = outline.points();
  for (std::size_t i = 18; i < 23; ++i)
    dented[i] = 1.002 * dented[i];
  EXPECT_FALSE(find_similar(points, outline, s, ClosedCurve(dented), 1e-3).has_value());
}

TEST(FlipfreeSimilar, ANearlySymmetricShapeTurnsAllTheWay) {
  const Points shape = nearly_even_gear();
  const auto system = FlipfreeSystem::make(ClosedCurve(shape));
  ASSERT_TRUE(system.ok());
  for (const double turn : {-2.2, -1.2, 0.8, 2.6}) {
    const Similarity by{std::polar(1.4, turn), {300, -50}};
    const auto solution = solve_flipfree(*system, transformed(shape, by), {}, {}, nullptr);
    ASSERT_TRUE(solution.ok());
    const double cell = 1.4 * system->region().mesh().cell;
    EXPECT_LT(similar_gap(solution->outline, transformed(shape, by)), 1e-5 * cell) << turn;
    EXPECT_LT(similar_gap(solution->positions, transformed(system->region().mesh().vertices, by)), 1e-5 * cell) << turn;
  }
}

TEST(SketchFrame, IsTheSameWhereverTheSketchBegins) {
  const ClosedCurve outline(testing::blob_shape());
  Points corners = testing::cactus_shape();
  const SketchFrame frame = make_sketch_frame(outline, 10, ClosedCurve(corners));
  EXPECT_EQ(frame.curve.size(), static_cast<int>(corners.size()));
  Points more;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (const double t : {0.0, 0.2, 0.7})
      more.push_back(lerp(corners[i], corners[(i + 1) % corners.size()], t));
  EXPECT_EQ(make_sketch_frame(outline, 10, ClosedCurve(more)).curve.points(), frame.curve.points());
  // What bends but little is no straight line.
  const Points round = testing::polar_shape(20000, [](double) { return 150.0; });
  EXPECT_EQ(make_sketch_frame(outline, 10, ClosedCurve(round)).curve.size(), 20000);
}

TEST(FlipfreeSimilar, ASketchMayBeginInTheMiddleOfASide) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const auto pair = testing::bend_at_random(testing::named_shapes()[seed].second, 90 + seed, 0.3, 2.0);
    const auto system = FlipfreeSystem::make(ClosedCurve(pair.outline));
    ASSERT_TRUE(system.ok());
    Points sketch = started_at(pair.sketch, 31);
    sketch.insert(sketch.begin(), lerp(sketch.back(), sketch.front(), 0.5));
    const auto one = solve_flipfree(*system, pair.sketch, {}, {}, nullptr);
    const auto other = solve_flipfree(*system, sketch, {}, {}, nullptr);
    ASSERT_TRUE(one.ok() && other.ok());
    EXPECT_LT(similar_gap(one->positions, other->positions), 1e-6 * bounds(pair.sketch).diagonal()) << seed;
  }
}

TEST(FlipfreeAlternatives, AreAnswersOrAreNotOffered) {
  std::size_t asked_for = 0, offered = 0;
  for (std::uint32_t seed = 0; seed < 7; ++seed) {
    const auto pair = testing::bend_at_random(testing::named_shapes()[seed].second, 120 + seed);
    const auto system = FlipfreeSystem::make(ClosedCurve(pair.outline));
    ASSERT_TRUE(system.ok());
    const auto solutions = solve_alternatives(*system, pair.sketch, {}, {}, 5);
    ASSERT_TRUE(solutions.ok());
    const FlipfreeSolution& best = solutions->front();
    const double size = std::sqrt(std::abs(best.sketch->curve.signed_area()));
    const auto furthest = [&](const FlipfreeSolution& solution) {
      // Of the sketch alone: the outline always clings to it, but may leave a part of it bare.
      const ClosedCurve outline(solution.handles);
      double most = 0;
      for (const Point p : resample(best.sketch->curve, 500))
        most = std::max(most, outline.nearest(p).distance);
      return most;
    };
    for (std::size_t k = 1; k < solutions->size(); ++k) {
      const FlipfreeSolution& other = (*solutions)[k];
      EXPECT_EQ(other.flipped, 0);
      EXPECT_LE(furthest(other), std::max(0.16 * size, 1.6 * furthest(best))) << seed;
      EXPECT_GT(similar_gap(other.outline, best.outline), 0.02 * size) << seed;
    }
    asked_for += 5;
    offered += solutions->size();
  }
  EXPECT_GT(offered, 7U);
  EXPECT_LT(offered, asked_for);
}

} // namespace
} // namespace oversketch
