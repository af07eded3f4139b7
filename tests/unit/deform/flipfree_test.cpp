#include "core/deform/flipfree.h"

#include "core/mesh/display_mesh.h"
#include "tests/support/random_bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <string>

namespace oversketch {
namespace {

using testing::bend_at_random;
using testing::BentPair;
using testing::named_shapes;

FlipfreeSystem make_flipfree_system(const Points& outline) {
  auto system = FlipfreeSystem::make(ClosedCurve(outline));
  EXPECT_TRUE(system.ok()) << to_string(system.error());
  return std::move(*system);
}

FlipfreeSolution solve_one(const FlipfreeSystem& system, const Points& sketch, std::vector<PinPair> pins = {},
                           const FlipfreeSolution* warm = nullptr, const FlipfreeOptions& options = {}) {
  auto solution = solve_flipfree(system, sketch, pins, options, warm);
  EXPECT_TRUE(solution.ok()) << to_string(solution.error());
  return std::move(*solution);
}

int count_flips(const QuadMesh& mesh, const Points& x) {
  int flips = 0;
  for (const auto& c : mesh.cells)
    for (int k = 0; k < 4; ++k) {
      const Point here = x[c[k]], next = x[c[(k + 1) % 4]], before = x[c[(k + 3) % 4]];
      if (!(cross(next - here, before - here) > 0)) {
        ++flips;
        break;
      }
    }
  return flips;
}

/// Control mesh, and display meshes at the sizes that matter.
int count_all_flips(const FlipfreeSystem& system, const Points& positions) {
  int flips = count_flips(system.region().mesh(), positions);
  for (const double cell : {20.0, 12.0, 8.0}) {
    const auto display = make_display_mesh(system.region(), cell);
    EXPECT_TRUE(display.ok());
    flips += count_flips(display->mesh, prolong(system.region().mesh(), positions, *display));
  }
  return flips;
}

double largest_gap(const Points& a, const Points& b) {
  EXPECT_EQ(a.size(), b.size());
  double gap = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    gap = std::max(gap, distance(a[i], b[i]));
  return gap;
}

double truth_error_of(const FlipfreeSolution& solution, const BentPair& pair) {
  double sum = 0;
  for (std::size_t i = 0; i < pair.truth.size(); ++i)
    sum += distance(solution.outline[i], pair.truth[i]);
  return sum / static_cast<double>(pair.truth.size()) / perimeter(pair.sketch);
}

/// The sketch with the points whose parts of the length lie in [from, to) pushed outwards by up to `push` px.
Points redraw(const Points& sketch, double from, double to, double push) {
  const ClosedCurve curve(sketch);
  Points out = sketch;
  const double turn = curve.signed_area() > 0 ? 1 : -1;
  for (int i = 0; i < curve.size(); ++i) {
    const double part = curve.s_at(i) / curve.length();
    if (part < from || part >= to) continue;
    const double bump = std::sin(std::numbers::pi * (part - from) / (to - from));
    out[i] -= turn * push * bump * bump * turned(curve.smooth_tangent(curve.s_at(i), 0.03 * curve.length()));
  }
  return out;
}

void expect_sound(const FlipfreeSystem& system, const FlipfreeSolution& solution, const std::string& what) {
  EXPECT_EQ(solution.flipped, 0) << what;
  EXPECT_EQ(count_all_flips(system, solution.positions), 0) << what;
  EXPECT_EQ(solution.order_violations, 0) << what;
  for (std::size_t i = 1; i < solution.handle_sketch_s.size(); ++i)
    EXPECT_GT(solution.handle_sketch_s[i], solution.handle_sketch_s[i - 1]) << what;
  int wraps = 0;
  for (std::size_t i = 0; i < solution.correspondence.size(); ++i) {
    EXPECT_GE(solution.correspondence[i], 0) << what;
    EXPECT_LT(solution.correspondence[i], 1) << what;
    if (solution.correspondence[(i + 1) % solution.correspondence.size()] < solution.correspondence[i]) ++wraps;
  }
  EXPECT_EQ(wraps, 1) << what;
}

TEST(Flipfree, RefusesBadInput) {
  const FlipfreeSystem system = make_flipfree_system(testing::fish_shape());
  const auto refused = [&](const Points& sketch, std::vector<PinPair> pins = {}) {
    const auto solution = solve_flipfree(system, sketch, pins, {}, nullptr);
    return solution.ok() ? std::string() : solution.error().code;
  };
  EXPECT_EQ(refused({}), "sketch.too-few-points");
  EXPECT_EQ(refused({{0, 0}, {100, 0}, {50, 0}}), "sketch.no-area");
  EXPECT_EQ(refused({{0, 0}, {0.5, 0}, {0.5, 0.5}}), "sketch.no-area");
  EXPECT_EQ(refused({{0, 0}, {100, 100}, {100, 0}, {0, 100}}), "sketch.crosses-itself");
  const Points round = testing::ellipse_shape();
  EXPECT_EQ(refused(round, {{{200, 0}, round[0]}, {{-190, 0}, round[100]}, {{40, 82}, round[120]}}),
            "deform.pins-cross");
  const auto tiny = FlipfreeSystem::make(ClosedCurve(testing::bar_shape()),
                                         *make_region_mesh(ClosedCurve(testing::bar_shape()), 10, MeshKind::kCovering));
  EXPECT_TRUE(tiny.ok());
  EXPECT_THROW((void)solve_flipfree(system, round, {}, {.stiffness = 0}, nullptr), BugError);
  EXPECT_THROW((void)solve_flipfree(system, round, {}, {.follow = -1}, nullptr), BugError);
  const FlipfreeSolution other = solve_one(*tiny, round);
  EXPECT_THROW((void)solve_flipfree(system, round, {}, {}, &other), BugError);
}

TEST(Flipfree, StopsWhenAskedAndLeavesTheWarmSolution) {
  const FlipfreeSystem system = make_flipfree_system(testing::fish_shape());
  const Points sketch = testing::blob_shape();
  const FlipfreeSolution warm = solve_one(system, sketch);
  const Points before = warm.positions;
  std::stop_source source;
  source.request_stop();
  for (const FlipfreeSolution* start : {static_cast<const FlipfreeSolution*>(nullptr), &warm}) {
    const auto stopped = solve_flipfree(system, sketch, {}, {}, start, {source.get_token(), {}, nullptr});
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error(), cancelled());
  }
  EXPECT_FALSE(FlipfreeSystem::make(ClosedCurve(sketch), {source.get_token(), {}, nullptr}).ok());
  EXPECT_EQ(warm.positions, before);
}

TEST(Flipfree, ASimilarSketchGivesTheSimilarity) {
  for (const auto& [name, shape] : named_shapes()) {
    const FlipfreeSystem system = make_flipfree_system(shape);
    const Similarity similarity{std::polar(0.4, -0.5), {700, 1200}};
    Points sketch = transformed(shape, similarity);
    std::rotate(sketch.begin(), sketch.begin() + 3, sketch.end());
    std::reverse(sketch.begin(), sketch.end());
    const FlipfreeSolution solution = solve_one(system, sketch);
    const auto& mesh = system.region().mesh();
    EXPECT_LT(largest_gap(solution.positions, transformed(mesh.vertices, similarity)), 1e-5 * 0.4 * mesh.cell) << name;
    EXPECT_LT(largest_gap(solution.outline, transformed(shape, similarity)), 1e-5 * 0.4 * mesh.cell) << name;
  }
}

TEST(Flipfree, DependsNeitherOnPlaceNorScaleNorStartNorDirection) {
  for (std::uint32_t seed = 0; seed < 7; ++seed) {
    const auto [name, shape] = named_shapes()[seed];
    const auto pair = bend_at_random(shape, 50 + seed);
    const FlipfreeSystem system = make_flipfree_system(pair.outline);
    const FlipfreeSolution first = solve_one(system, pair.sketch);
    const double size = bounds(pair.sketch).diagonal();
    Points sketch = pair.sketch;
    std::rotate(sketch.begin(), sketch.begin() + 31, sketch.end());
    EXPECT_LT(largest_gap(solve_one(system, sketch).positions, first.positions), 1e-6 * size) << name;
    std::reverse(sketch.begin(), sketch.end());
    EXPECT_LT(largest_gap(solve_one(system, sketch).positions, first.positions), 1e-6 * size) << name;
    for (const double scale : {0.05, 20.0}) {
      const Similarity by{scale, {-1234.5, 777.25}};
      const FlipfreeSolution other = solve_one(system, transformed(pair.sketch, by));
      EXPECT_LT(largest_gap(transformed(other.positions, by.inverse()), first.positions), 1e-6 * size) << name;
    }
  }
}

TEST(Flipfree, AnOutlineTheOtherWayRoundGoesToTheSamePlaces) {
  const auto pair = bend_at_random(testing::pineapple_shape(), 4);
  Points backwards = pair.outline;
  std::reverse(backwards.begin(), backwards.end());
  const FlipfreeSystem one = make_flipfree_system(pair.outline), other = make_flipfree_system(backwards);
  const FlipfreeSolution first = solve_one(one, pair.sketch), second = solve_one(other, pair.sketch);
  expect_sound(other, second, "backwards");
  Points turned_back = second.outline;
  std::reverse(turned_back.begin(), turned_back.end());
  // The handles start elsewhere, so that the two are equal to the solver's own accuracy only.
  EXPECT_LT(largest_gap(turned_back, first.outline), 0.02 * bounds(pair.sketch).diagonal());
}

TEST(Flipfree, CorrespondenceIsWhereTheOutlineLies) {
  for (const bool backwards : {false, true}) {
    const auto pair = bend_at_random(testing::fish_shape(), 12, 0.25, 0.3);
    Points sketch = pair.sketch;
    if (backwards) std::reverse(sketch.begin(), sketch.end());
    const FlipfreeSystem system = make_flipfree_system(pair.outline);
    const FlipfreeSolution solution = solve_one(system, sketch);
    Points run = sketch;
    if (ClosedCurve(sketch).signed_area() * system.outline().signed_area() < 0)
      std::reverse(run.begin() + 1, run.end());
    const ClosedCurve along(run);
    double sum = 0;
    for (std::size_t i = 0; i < solution.outline.size(); ++i)
      sum += distance(along.at(solution.correspondence[i] * along.length()), solution.outline[i]);
    EXPECT_LT(sum / static_cast<double>(solution.outline.size()), 0.005 * along.length());
  }
}

TEST(Flipfree, RandomBendsNeverFlipAndComeNearTheTruth) {
  std::vector<double> errors;
  const auto shapes = named_shapes();
  for (std::uint32_t seed = 0; seed < 70; ++seed) {
    const auto& [name, shape] = shapes[seed % shapes.size()];
    const auto pair = bend_at_random(shape, 5000 + seed, 0.2 + 0.05 * (seed % 4));
    const FlipfreeSystem system = make_flipfree_system(pair.outline);
    const FlipfreeSolution solution = solve_one(system, pair.sketch);
    expect_sound(system, solution, std::string(name) + " " + std::to_string(seed));
    if (name != "ellipse" && name != "blob" && name != "star") errors.push_back(truth_error_of(solution, pair));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.009);
}

TEST(Flipfree, UnrelatedShapesDoNotFlipEither) {
  const auto shapes = named_shapes();
  for (const auto& [name, shape] : shapes) {
    const FlipfreeSystem system = make_flipfree_system(shape);
    for (const auto& [other_name, other] : shapes)
      if (name != other_name)
        expect_sound(system, solve_one(system, other), std::string(name) + " to " + std::string(other_name));
  }
}

TEST(Flipfree, HandlesHaveSlidToWhereTheyRest) {
  for (std::uint32_t seed = 0; seed < 7; ++seed) {
    const auto [name, shape] = named_shapes()[seed];
    const auto pair = bend_at_random(shape, 60 + seed, 0.25);
    const FlipfreeSystem system = make_flipfree_system(pair.outline);
    const FlipfreeSolution solution = solve_one(system, pair.sketch);
    const ClosedCurve& curve = solution.sketch->curve;
    const double cell =
        system.region().mesh().cell * std::sqrt(std::abs(curve.signed_area() / system.outline().signed_area()));
    double strayed = 0, left = 0;
    for (std::size_t i = 0; i < solution.handles.size(); ++i) {
      const double s = solution.handle_sketch_s[i];
      const Point d = solution.handles[i] - curve.at(s), t = curve.smooth_tangent(s, 0.35 * cell);
      const double along = 0.04 * solution.options.follow + solution.holds[i], hold = solution.holds[i];
      left += std::abs(along * dot(t, d) + hold * (solution.anchors[i] - s)) / (along + hold) / cell;
      strayed += std::abs(s - solution.anchors[i]) / cell;
    }
    const double n = static_cast<double>(solution.handles.size());
    EXPECT_LT(left / n, 0.02) << name;
    EXPECT_GT(strayed / n, 0.05) << name;
  }
}

TEST(Flipfree, WarmWithNothingChangedStaysAndMatchesNothing) {
  const auto pair = bend_at_random(testing::cactus_shape(), 8);
  const FlipfreeSystem system = make_flipfree_system(pair.outline);
  const FlipfreeSolution first = solve_one(system, pair.sketch), second = solve_one(system, pair.sketch, {}, &first);
  EXPECT_EQ(second.start, FlipfreeStart::kWarm);
  EXPECT_EQ(second.matches, 0);
  EXPECT_LE(second.iterations, 3);
  EXPECT_LT(largest_gap(first.positions, second.positions), 0.01 * bounds(pair.sketch).diagonal());
}

TEST(Flipfree, WarmStepsAreFewForOptions) {
  const auto pair = bend_at_random(testing::fish_shape(), 21);
  const FlipfreeSystem system = make_flipfree_system(pair.outline);
  const FlipfreeSolution first = solve_one(system, pair.sketch);
  for (const FlipfreeOptions options :
       {FlipfreeOptions{.follow = 5}, FlipfreeOptions{.follow = 60}, FlipfreeOptions{.stiffness = 0.5}}) {
    const FlipfreeSolution second = solve_one(system, pair.sketch, {}, &first, options);
    EXPECT_EQ(second.matches, 0);
    EXPECT_LE(second.iterations, 10);
    expect_sound(system, second, "options");
  }
}

TEST(Flipfree, AnOversketchKeepsTheCorrespondenceElsewhere) {
  for (std::uint32_t seed = 0; seed < 14; ++seed) {
    const auto [name, shape] = named_shapes()[seed % 7];
    const auto pair = bend_at_random(shape, 300 + seed, 0.2);
    const FlipfreeSystem system = make_flipfree_system(pair.outline);
    const FlipfreeSolution first = solve_one(system, pair.sketch);
    const Points sketch = redraw(pair.sketch, 0.3, 0.5, 0.08 * bounds(pair.sketch).diagonal());
    if (!clean_sketch(sketch, 1.0)) continue;
    const FlipfreeSolution second = solve_one(system, sketch, {}, &first);
    EXPECT_EQ(second.start, FlipfreeStart::kRemapped) << name;
    EXPECT_EQ(second.matches, 0) << name;
    expect_sound(system, second, std::string(name));
    // Far from the change little moves.
    const double size = bounds(pair.sketch).diagonal();
    std::vector<double> gaps;
    const ClosedCurve curve(sketch);
    for (std::size_t i = 0; i < second.outline.size(); ++i) {
      const double part = curve.nearest(second.outline[i]).s / curve.length();
      if (part > 0.65 || part < 0.15) gaps.push_back(distance(first.outline[i], second.outline[i]));
    }
    EXPECT_LT(std::accumulate(gaps.begin(), gaps.end(), 0.0) / static_cast<double>(gaps.size()), 0.02 * size) << name;
  }
}

TEST(Flipfree, ANewSketchIsMatchedAnew) {
  const FlipfreeSystem system = make_flipfree_system(testing::fish_shape());
  const FlipfreeSolution first = solve_one(system, testing::blob_shape());
  const FlipfreeSolution second = solve_one(system, testing::ellipse_shape(), {}, &first);
  EXPECT_EQ(second.start, FlipfreeStart::kMatched);
  EXPECT_EQ(second.matches, 1);
  EXPECT_EQ(second.positions, solve_one(system, testing::ellipse_shape()).positions);
}

TEST(Flipfree, FramesOfADragTakeTwoStepsAndStaySound) {
  const auto pair = bend_at_random(testing::cactus_shape(), 31, 0.2);
  const FlipfreeSystem system = make_flipfree_system(pair.outline);
  FlipfreeSolution at = solve_one(system, pair.sketch);
  for (int frame = 1; frame <= 12; ++frame) {
    const Points sketch = redraw(pair.sketch, 0.1, 0.3, 3.0 * frame);
    at = solve_one(system, sketch, {}, &at, {.most_steps = 2});
    EXPECT_LE(at.iterations, 2);
    EXPECT_LE(at.numeric_factorizations, 2);
    EXPECT_EQ(at.matches, 0);
    expect_sound(system, at, "frame " + std::to_string(frame));
  }
}

TEST(Flipfree, PinsAreMet) {
  for (std::uint32_t seed = 0; seed < 14; ++seed) {
    const auto [name, shape] = named_shapes()[seed % 7];
    const auto pair = bend_at_random(shape, 700 + seed, 0.2);
    const FlipfreeSystem system = make_flipfree_system(pair.outline);
    const FlipfreeSolution first = solve_one(system, pair.sketch);
    const ClosedCurve& curve = first.sketch->curve;
    std::vector<PinPair> pins;
    for (const std::size_t i : {40U, 180U, 300U}) {
      const double s = curve.nearest(first.outline[i]).s;
      pins.push_back({pair.outline[i], curve.at(s + 0.02 * curve.length())});
    }
    const double cell =
        system.region().mesh().cell * std::sqrt(std::abs(curve.signed_area() / system.outline().signed_area()));
    for (const FlipfreeSolution* warm : {static_cast<const FlipfreeSolution*>(nullptr), &first}) {
      const FlipfreeSolution second = solve_one(system, pair.sketch, pins, warm);
      EXPECT_EQ(second.matches, warm ? 0 : 1) << name;
      EXPECT_LE(second.pin_distance, 0.1) << name;
      expect_sound(system, second, std::string(name));
      for (const PinPair& pin : pins) {
        const auto at = std::find(pair.outline.begin(), pair.outline.end(), pin.outline) - pair.outline.begin();
        EXPECT_LT(distance(second.outline[at], pin.sketch), 0.1 * cell) << name;
      }
    }
  }
}

// Where the shape is nearly the source's own, places drift on along a valley that has next to no slope.
TEST(Flipfree, APinOnASmoothShapeTakesFewSteps) {
  const Points outline = resample(ClosedCurve(testing::ellipse_shape()), 400);
  const Points sketch = transformed(outline, Similarity{std::polar(1.0, std::numbers::pi / 2), {40, -30}});
  const FlipfreeSystem system = make_flipfree_system(outline);
  FlipfreeSolution last = solve_one(system, sketch);
  const ClosedCurve& curve = last.sketch->curve;
  const double s = curve.nearest(last.outline[170]).s;
  for (const double shift : {0.03, 0.0, -0.02, 0.0}) {
    const PinPair pin{outline[170], curve.at(s + shift * curve.length())};
    last = solve_one(system, sketch, {pin}, &last);
    EXPECT_EQ(last.matches, 0);
    EXPECT_LE(last.iterations, 12) << "moved to " << shift;
    EXPECT_LE(last.pin_distance, 0.1);
    expect_sound(system, last, "pinned ellipse");
  }
}

TEST(Flipfree, APinFarAwayIsMatchedAnew) {
  const auto pair = bend_at_random(testing::bar_shape(), 5, 0.2);
  const FlipfreeSystem system = make_flipfree_system(pair.outline);
  const FlipfreeSolution first = solve_one(system, pair.sketch);
  const ClosedCurve& curve = first.sketch->curve;
  // The bar the other way round.
  const double s = curve.nearest(first.outline[20]).s + 0.5 * curve.length();
  const FlipfreeSolution second = solve_one(system, pair.sketch, {{pair.outline[20], curve.at(s)}}, &first);
  EXPECT_EQ(second.matches, 1);
  EXPECT_LE(second.pin_distance, 0.1);
  expect_sound(system, second, "turned");
}

TEST(Flipfree, PinsFarFromTheCurvesAreSnapped) {
  const auto pair = bend_at_random(testing::fish_shape(), 6, 0.2);
  const FlipfreeSystem system = make_flipfree_system(pair.outline);
  const FlipfreeSolution free = solve_one(system, pair.sketch);
  const Point far = pair.outline[100] + 50 * (pair.outline[100] / length(pair.outline[100]));
  const FlipfreeSolution pinned = solve_one(system, pair.sketch, {{far, free.outline[100]}});
  EXPECT_LE(pinned.pin_distance, 0.1);
  expect_sound(system, pinned, "snapped");
}

TEST(Flipfree, AlternativesAreSolvedAndDistinct) {
  const FlipfreeSystem system = make_flipfree_system(testing::bar_shape());
  const Points sketch = transformed(testing::bar_shape(), {std::polar(1.2, 0.4), {10, 20}});
  const auto solutions = solve_alternatives(system, sketch, {}, {}, 3);
  ASSERT_TRUE(solutions.ok());
  ASSERT_GE(solutions->size(), 2U);
  for (const FlipfreeSolution& solution : *solutions)
    expect_sound(system, solution, "alternative");
  EXPECT_EQ((*solutions)[0].positions, solve_one(system, sketch).positions);
  EXPECT_LE((*solutions)[0].match_cost, (*solutions)[1].match_cost);
  EXPECT_GT(largest_gap((*solutions)[0].positions, (*solutions)[1].positions), 100);
}

TEST(Flipfree, ThinOutlinesAndManyLoops) {
  const Points thin{{0, 0}, {400, 0}, {400, 1.5}, {0, 1.5}};
  const FlipfreeSystem system = make_flipfree_system(thin);
  expect_sound(system, solve_one(system, {{0, 0}, {300, 200}, {299, 202}, {-2, 2}}), "thin");
  const FlipfreeSystem fish = make_flipfree_system(testing::fish_shape());
  Points loops;
  const Points round = testing::polar_shape(3000, [](double) { return 150.0; });
  for (std::size_t i = 0; i < round.size(); ++i) {
    loops.push_back(round[i]);
    if (i % 3 != 0) continue;
    const Point way = round[(i + 1) % round.size()] - round[i];
    for (const Point turn : {Point{0.8, 0.5}, Point{0.4, 0.8}, Point{0.3, -0.3}})
      loops.push_back(round[i] + turn.x * way + turn.y * turned(way));
  }
  const FlipfreeSolution solution = solve_one(fish, loops);
  EXPECT_GE(solution.sketch->loops_cut, 900);
  expect_sound(fish, solution, "loops");
}

} // namespace
} // namespace oversketch
