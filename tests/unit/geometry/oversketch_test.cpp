#include "core/geometry/oversketch.h"

#include "tests/unit/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace oversketch {
namespace {

using testing::blob;
using testing::circle;

constexpr OversketchOptions kPlain{};
constexpr OversketchOptions kSharp{.sharp = true};

Points reversed(const Points& points) {
  return {points.rbegin(), points.rend()};
}

ClosedCurve square() {
  Points points;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < 20; ++i) {
      Point p{10.0 * i, 0};
      for (int k = 0; k < side; ++k)
        p = Point{200, 0} + turned(p);
      points.push_back(p);
    }
  return ClosedCurve(points);
}

/// A stroke along the curve from s = a over `length` px, `bulge` px off to its left in the middle, its ends `off` px
/// away.
Points stroke_along(const ClosedCurve& curve, double a, double length, double bulge, double off, int count = 60) {
  Points stroke;
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count, s = a + t * length;
    const double wave = std::sin(std::numbers::pi * t);
    stroke.push_back(curve.at(s) - (off + bulge * wave * wave) * turned(curve.smooth_tangent(s, 10)));
  }
  return stroke;
}

std::string code_of(const Result<OversketchResult>& result) {
  return result ? "none" : result.error().code;
}

/// What holds for every result, checked by other means than it was made.
void expect_sound(const ClosedCurve& old, const OversketchResult& result) {
  ASSERT_FALSE(find_self_crossing(result.curve, true).has_value());
  ASSERT_GT(signed_area(result.curve) * old.signed_area(), 0);
  ASSERT_EQ(without_repeats(result.curve), result.curve);
  const ClosedCurve drawn(result.curve);
  ASSERT_EQ(result.new_length, drawn.length());
  ASSERT_EQ(result.old_length, old.length());
  if (result.whole_new) return;

  // Old vertices outside the replaced part are all there, in the old order, and nothing else lies outside the drawn
  // part.
  const double end = result.drawn.begin + result.drawn.length;
  Points kept, rest;
  for (int k = 0; k < old.size(); ++k) {
    const double ahead = old.forward(result.replaced.begin + result.replaced.length, old.s_at(k));
    if (ahead > 1e-6 && ahead < old.length() - result.replaced.length - 1e-6)
      kept.push_back(old.points()[static_cast<std::size_t>(k)]);
  }
  for (int k = 0; k < drawn.size(); ++k) {
    const double ahead = drawn.forward(end, drawn.s_at(k));
    if (ahead > 1e-6 && ahead < drawn.length() - result.drawn.length - 1e-6)
      rest.push_back(result.curve[static_cast<std::size_t>(k)]);
  }
  if (!kept.empty() && !rest.empty()) {
    // Both lists begin wherever the curve does; turned to begin alike they must be equal bit by bit.
    const auto begin = std::find(rest.begin(), rest.end(), kept.front());
    ASSERT_NE(begin, rest.end());
    std::rotate(rest.begin(), begin, rest.end());
  }
  ASSERT_EQ(kept, rest);

  // The ghost is the replaced part.
  ASSERT_LT(distance(result.ghost.front(), old.at(result.replaced.begin)), 1e-5);
  ASSERT_LT(distance(result.ghost.back(), old.at(result.replaced.begin + result.replaced.length)), 1e-5);
  ASSERT_NEAR(path_length(result.ghost), result.replaced.length, 1e-5);

  for (int i = 0; i < 50; ++i) {
    const double s = old.length() * i / 50, past = old.forward(result.replaced.begin, s);
    const auto moved = result.moved(s);
    ASSERT_EQ(moved.has_value(), past == 0 || past >= result.replaced.length) << s;
    if (!moved) continue;
    ASSERT_GE(*moved, 0);
    ASSERT_LT(*moved, result.new_length);
    ASSERT_LT(distance(drawn.at(*moved), old.at(s)), 1e-5);
  }
}

TEST(OversketchTest, EveryUnusableStrokeIsAnError) {
  const ClosedCurve curve = square();
  EXPECT_EQ(code_of(oversketch(curve, {}, kPlain)), "oversketch.stroke-too-short");
  EXPECT_EQ(code_of(oversketch(curve, {{50, 0}}, kPlain)), "oversketch.stroke-too-short");
  EXPECT_EQ(code_of(oversketch(curve, {{50, 0}, {50, 0}, {50, 0}}, kPlain)), "oversketch.stroke-too-short");
  const auto broken = oversketch(curve, {{50, 0}, {60, -9}, {70, std::nan("")}}, kPlain);
  EXPECT_EQ(code_of(broken), "oversketch.not-finite");
  EXPECT_EQ(broken.error().where, "stroke point 2");
  EXPECT_EQ(code_of(oversketch(curve, {{HUGE_VAL, 0}, {70, 0}}, kPlain)), "oversketch.not-finite");
  for (const double tolerance : {0.0, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_EQ(code_of(oversketch(curve, {{50, 0}, {70, 0}}, {.tolerance_px = tolerance})), "oversketch.tolerance");
  // Far away and open; one end near and the other beyond three tolerances; both beyond one.
  EXPECT_EQ(code_of(oversketch(curve, {{50, -90}, {90, -90}}, kPlain)), "oversketch.not-near");
  EXPECT_EQ(code_of(oversketch(curve, {{50, 0}, {90, -31}}, kPlain)), "oversketch.not-near");
  EXPECT_EQ(oversketch(curve, {{50, 0}, {90, -31}}, kPlain).error().where, "stroke end");
  EXPECT_EQ(code_of(oversketch(curve, {{50, -11}, {90, -11}}, kPlain)), "oversketch.not-near");
  // Crosses itself; crosses the kept part; leaves no area.
  EXPECT_EQ(code_of(oversketch(curve, {{50, 0}, {90, -60}, {50, -60}, {90, 0}}, kPlain)), "oversketch.crosses");
  EXPECT_EQ(code_of(oversketch(curve, {{30, 0}, {-10, 30}, {30, 30}, {170, 10}, {170, 0}}, kPlain)),
            "oversketch.crosses");
  EXPECT_EQ(code_of(oversketch(curve, {{500, 500}, {540, 540}, {520, 520}, {500, 500}}, kPlain)), "curve.no-area");
  EXPECT_EQ(code_of(oversketch(curve, {{500, 0}, {2e6, 0}, {500, 9}}, kPlain)), "curve.too-far");
}

TEST(OversketchTest, ACrossingNamesItsPlace) {
  const auto crossed = oversketch(square(), {{50, 0}, {90, -60}, {50, -60}, {90, 0}}, kSharp);
  ASSERT_EQ(code_of(crossed), "oversketch.crosses");
  EXPECT_EQ(crossed.error().where, "(70.0, -30.0)");
  EXPECT_NE(crossed.error().sentence.find("(70.0, -30.0)"), std::string::npos);
}

TEST(OversketchTest, ASharpStrokeTakesThePartsPlaceAsItIs) {
  const ClosedCurve curve = square();
  const Points stroke{{52, -4}, {60, -40}, {90, -40}, {97, 3}};
  const auto result = oversketch(curve, stroke, kSharp);
  ASSERT_TRUE(result.ok()) << to_string(result.error());
  expect_sound(curve, *result);
  EXPECT_EQ(result->replaced.begin, 52);
  EXPECT_EQ(result->replaced.length, 45);
  EXPECT_EQ(result->ghost, (Points{{52, 0}, {60, 0}, {70, 0}, {80, 0}, {90, 0}, {97, 0}}));
  Points expected{{0, 0}, {10, 0}, {20, 0}, {30, 0}, {40, 0}, {50, 0}, {52, 0}};
  expected.insert(expected.end(), stroke.begin(), stroke.end());
  expected.push_back({97, 0});
  for (std::size_t i = 10; i < 80; ++i)
    expected.push_back(curve.points()[i]);
  EXPECT_EQ(result->curve, expected);
  EXPECT_EQ(result->moved(40), 40);
  EXPECT_EQ(result->moved(52), 52);
  EXPECT_FALSE(result->moved(60).has_value());
}

TEST(OversketchTest, AJoinNearAVertexIsTheVertex) {
  const ClosedCurve curve = square();
  const auto result = oversketch(curve, {{50 + 1e-9, -2}, {70, -40}, {100 - 1e-9, -2}}, kSharp);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->replaced.begin, 50);
  EXPECT_EQ(result->replaced.length, 50);
  EXPECT_EQ(result->curve.size(), 80u - 4u + 3u);
}

TEST(OversketchTest, WhereTheFirstPointIsReplacedTheKeptPartLeads) {
  const ClosedCurve curve = square();
  const auto result = oversketch(curve, {{0, 50}, {-40, -40}, {50, 0}}, kSharp);
  ASSERT_TRUE(result.ok()) << to_string(result.error());
  expect_sound(curve, *result);
  EXPECT_EQ(result->curve.front(), (Point{50, 0}));
  EXPECT_EQ(result->moved(50), 0.0);
  EXPECT_EQ(result->moved(60), 10.0);
  EXPECT_EQ(result->replaced.begin, 750);
  EXPECT_EQ(result->replaced.length, 100);
}

TEST(OversketchTest, RandomStrokesHoldEveryPromise) {
  std::mt19937 random(61);
  std::uniform_real_distribution<double> unit(0, 1);
  int taken = 0, others = 0;
  constexpr int rounds = 400;
  for (int round = 0; round < rounds; ++round) {
    Points points = blob(random, 60 + round, {400, 300}, 200, 0.35);
    if (round % 2 == 1) points = reversed(points);
    const ClosedCurve curve(points);
    const double begin = curve.length() * unit(random), length = curve.length() * (0.08 + 0.5 * unit(random));
    const Points stroke = stroke_along(curve, begin, length, 60 * unit(random) - 30, 14 * unit(random) - 7);
    const OversketchOptions options{.sharp = round % 5 == 0};
    const auto result = oversketch(curve, stroke, options);
    SCOPED_TRACE("round " + std::to_string(round));
    if (!result) {
      EXPECT_TRUE(code_of(result) == "oversketch.crosses" || code_of(result) == "oversketch.not-near")
          << code_of(result);
      EXPECT_EQ(code_of(oversketch(curve, reversed(stroke), options)), code_of(result));
      continue;
    }
    ++taken;
    ASSERT_NO_FATAL_FAILURE(expect_sound(curve, *result));
    // The part under the stroke is the one replaced; a corner of the curve may put a projection some px off.
    EXPECT_NEAR(result->replaced.length, length, 60);
    EXPECT_LT(std::min(curve.forward(begin, result->replaced.begin), curve.forward(result->replaced.begin, begin)), 30);
    // The stroke's middle is followed point by point.
    const std::size_t middle = stroke.size() / 2;
    for (std::size_t i = middle - 2; i <= middle + 2; ++i)
      EXPECT_EQ(std::count(result->curve.begin(), result->curve.end(), stroke[i]), 1);
    const auto back = oversketch(curve, reversed(stroke), options);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->curve, result->curve) << "the stroke's direction never decides";

    OversketchOptions other_options = options;
    other_options.side = OversketchSide::kOther;
    const auto other = oversketch(curve, stroke, other_options);
    EXPECT_EQ(other.ok(), result->other_side_possible);
    if (!other) continue;
    ++others;
    ASSERT_NO_FATAL_FAILURE(expect_sound(curve, *other));
    EXPECT_TRUE(other->other_side_possible);
    EXPECT_NEAR(other->replaced.length + result->replaced.length, curve.length(), 60);
  }
  EXPECT_GT(taken, rounds * 9 / 10);
  EXPECT_GT(others, 0);
}

TEST(OversketchTest, StrokesOverStrokesStaySound) {
  std::mt19937 random(62);
  std::uniform_real_distribution<double> unit(0, 1);
  Points points = blob(random, 300, {400, 300}, 200, 0.2);
  int taken = 0;
  for (int round = 0; round < 150; ++round) {
    const ClosedCurve curve(points);
    const double length = curve.length() * (0.1 + 0.2 * unit(random));
    const auto result = oversketch(
        curve, stroke_along(curve, curve.length() * unit(random), length, 20 * unit(random) - 10, 4 * unit(random) - 2),
        kPlain);
    if (!result) continue;
    ++taken;
    ASSERT_NO_FATAL_FAILURE(expect_sound(curve, *result)) << "round " << round;
    points = result->curve;
  }
  EXPECT_GT(taken, 120);
}

double sharpest_turn(const Points& closed) {
  double sharpest = 0;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const Point a = closed[(i + 1) % closed.size()] - closed[i],
                b = closed[(i + 2) % closed.size()] - closed[(i + 1) % closed.size()];
    sharpest = std::max(sharpest, std::abs(std::atan2(cross(a, b), dot(a, b))));
  }
  return sharpest;
}

TEST(OversketchTest, SmoothJoinsHaveNoCornerAndSharpOnesDo) {
  const ClosedCurve curve(circle(400, {300, 300}, 200));
  for (const double off : {-8.0, -3.0, 3.0, 8.0}) {
    const Points stroke = stroke_along(curve, 200, 400, 15, off, 200);
    const auto smooth = oversketch(curve, stroke, kPlain), sharp = oversketch(curve, stroke, kSharp);
    ASSERT_TRUE(smooth.ok() && sharp.ok());
    EXPECT_LT(sharpest_turn(smooth->curve), 0.15) << off;
    EXPECT_GT(sharpest_turn(sharp->curve), 0.8) << off;
    for (const Point p : stroke)
      EXPECT_NE(std::find(sharp->curve.begin(), sharp->curve.end(), p), sharp->curve.end());
  }
}

TEST(OversketchTest, TracingTheCurveChangesNothingToSee) {
  const ClosedCurve curve(circle(400, {300, 300}, 200));
  const auto result = oversketch(curve, stroke_along(curve, 100, 500, 0, 0, 157), kPlain);
  ASSERT_TRUE(result.ok());
  for (const Point p : result->curve)
    EXPECT_NEAR(distance(p, {300, 300}), 200, 0.1);
  EXPECT_NEAR(result->new_length, curve.length(), 0.5);
}

TEST(OversketchTest, AFreeEndIsLedToTheCurve) {
  const ClosedCurve curve = square();
  const auto result = oversketch(curve, {{50, 2}, {60, -60}, {100, -60}, {100, -29}}, kSharp);
  ASSERT_TRUE(result.ok());
  expect_sound(curve, *result);
  EXPECT_EQ(result->replaced.length, 50);
  EXPECT_NE(std::find(result->curve.begin(), result->curve.end(), Point{100, 0}), result->curve.end());
  EXPECT_EQ(code_of(oversketch(curve, {{50, 2}, {60, -60}, {100, -60}, {100, -31}}, kSharp)), "oversketch.not-near");
}

TEST(OversketchTest, AStrokeThatClosesItselfAwayFromTheCurveTakesItsPlace) {
  const ClosedCurve curve = square();
  Points ring = circle(50, {100, 100}, 60);
  for (const Points& stroke : {ring, reversed(ring)}) {
    const auto result = oversketch(curve, stroke, kPlain);
    ASSERT_TRUE(result.ok()) << to_string(result.error());
    expect_sound(curve, *result);
    EXPECT_TRUE(result->whole_new);
    EXPECT_FALSE(result->other_side_possible);
    EXPECT_FALSE(result->moved(3).has_value());
    EXPECT_EQ(result->curve.size(), 50u);
    EXPECT_EQ(result->ghost.size(), 81u);
  }
  ring.resize(40);
  EXPECT_EQ(code_of(oversketch(curve, ring, kPlain)), "oversketch.not-near");
}

TEST(OversketchTest, GoingRoundAllOfItReplacesAllOfIt) {
  std::mt19937 random(63);
  for (int round = 0; round < 40; ++round) {
    const ClosedCurve curve(blob(random, 200, {400, 300}, 200, 0.3));
    const double begin = curve.length() * round / 40;
    // Short of its start, exactly back at it, and past it.
    for (const double excess : {-15.0, 0.0, 15.0}) {
      Points stroke = stroke_along(curve, begin, curve.length() + excess, 9, 2, 150);
      if (excess == 0) stroke.back() = stroke.front();
      for (const Points& way : {stroke, reversed(stroke)}) {
        const auto result = oversketch(curve, way, kPlain);
        ASSERT_TRUE(result.ok()) << excess << ": " << to_string(result.error());
        ASSERT_NO_FATAL_FAILURE(expect_sound(curve, *result));
        EXPECT_NE(std::find(result->curve.begin(), result->curve.end(), stroke[75]), result->curve.end());
        EXPECT_GT(result->replaced.length, curve.length() - 30);
      }
    }
  }
}

TEST(OversketchTest, ABumpOnANarrowBaseReplacesTheBase) {
  const ClosedCurve curve(circle(400, {300, 300}, 200));
  for (const double base : {6.0, 15.0, 40.0}) {
    const Points bump{
        {500, 300 - base / 2}, {540, 300 - base / 2}, {570, 300}, {540, 300 + base / 2}, {500, 300 + base / 2}};
    const auto result = oversketch(curve, bump, kSharp);
    ASSERT_TRUE(result.ok()) << to_string(result.error());
    expect_sound(curve, *result);
    EXPECT_NEAR(result->replaced.length, 400 * std::atan(base / 400), 0.01);
  }
}

TEST(OversketchTest, PinsDecideBetweenEqualParts) {
  const ClosedCurve curve(circle(400, {300, 300}, 200));
  const Points diameter{{300, 100}, {300, 300}, {300, 500}};
  for (const bool right : {true, false}) {
    const double pin = curve.nearest({right ? 500.0 : 100.0, 300}).s;
    OversketchOptions options{.pin_s = std::span(&pin, 1)};
    const auto result = oversketch(curve, diameter, options);
    ASSERT_TRUE(result.ok());
    EXPECT_TRUE(result->moved(pin).has_value());
    EXPECT_TRUE(result->other_side_possible);
    options.side = OversketchSide::kOther;
    const auto other = oversketch(curve, diameter, options);
    ASSERT_TRUE(other.ok());
    EXPECT_FALSE(other->moved(pin).has_value());
  }
}

TEST(OversketchTest, EvenATieDoesNotDependOnTheDirection) {
  const Points across{{100, 0}, {100, 100}, {100, 200}};
  const auto there = oversketch(square(), across, kPlain), back = oversketch(square(), reversed(across), kPlain);
  ASSERT_TRUE(there.ok() && back.ok());
  EXPECT_EQ(there->curve, back->curve);
  EXPECT_EQ(there->replaced.begin, 100);
}

TEST(OversketchTest, AnOvershootIsCutOff) {
  const ClosedCurve curve = square();
  // Both ends begin outside beside the part meant, and pass over the kept part on their way in.
  const Points stroke{{40, -6}, {46, 6}, {60, 40}, {100, 40}, {114, 6}, {120, -6}};
  for (const OversketchOptions& options : {kPlain, kSharp}) {
    const auto result = oversketch(curve, stroke, options);
    ASSERT_TRUE(result.ok()) << to_string(result.error());
    expect_sound(curve, *result);
    EXPECT_LT(signed_area(result->curve), curve.signed_area());
  }
  // Starts on its way back over the part that is kept.
  const Points hook{{70, -3}, {60, -8}, {50, 3}, {60, 40}, {100, 40}, {110, 0}};
  for (const OversketchOptions& options : {kPlain, kSharp}) {
    const auto result = oversketch(curve, hook, options);
    ASSERT_TRUE(result.ok()) << to_string(result.error());
    expect_sound(curve, *result);
    EXPECT_NEAR(result->replaced.begin, 52.7, 3);
  }
}

TEST(OversketchTest, TurningInsideOutIsAnError) {
  const ClosedCurve curve = square();
  // Below the square from corner to corner: the lower side is meant, replacing the other three would turn it over.
  const Points below{{0, 200}, {50, 240}, {150, 240}, {200, 200}};
  ASSERT_TRUE(oversketch(curve, below, kSharp).ok());
  EXPECT_FALSE(oversketch(curve, below, kSharp)->other_side_possible);
  EXPECT_EQ(code_of(oversketch(curve, below, {.side = OversketchSide::kOther, .sharp = true})),
            "oversketch.inside-out");
}

TEST(OversketchTest, MovesAndTurnsWithCurveAndStroke) {
  std::mt19937 random(64);
  const Similarity turn{std::polar(1.0, 0.7), {120, -75}};
  for (int round = 0; round < 30; ++round) {
    const ClosedCurve curve(blob(random, 150, {400, 300}, 200, 0.3));
    const Points stroke = stroke_along(curve, 40.0 * round, 400, 12, 3);
    const auto here = oversketch(curve, stroke, kPlain);
    const auto there = oversketch(ClosedCurve(transformed(curve.points(), turn)), transformed(stroke, turn), kPlain);
    ASSERT_TRUE(here.ok() && there.ok());
    ASSERT_EQ(here->curve.size(), there->curve.size());
    for (std::size_t i = 0; i < here->curve.size(); ++i)
      EXPECT_LT(distance(turn(here->curve[i]), there->curve[i]), 1e-6);
  }
}

} // namespace
} // namespace oversketch
