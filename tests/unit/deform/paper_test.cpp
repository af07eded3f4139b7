#include "core/deform/paper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

namespace oversketch {
namespace {

using Complex = std::complex<double>;

/// An outline of 240 points without symmetry, about 300 px across.
Points make_outline() {
  Points out;
  for (int i = 0; i < 240; ++i) {
    const double angle = 2 * std::numbers::pi * i / 240;
    const double radius = 100 + 25 * std::cos(2 * angle + 0.4) + 18 * std::sin(3 * angle) + 8 * std::cos(5 * angle);
    out.push_back({400 + 1.2 * radius * std::cos(angle), 300 + radius * std::sin(angle)});
  }
  return out;
}

/// The same outline, bent.
Points make_sketch() {
  Points out;
  for (const Point p : make_outline()) {
    const double x = (p.x - 400) / 150;
    out.push_back({p.x + 300, p.y + 45 * x * x - 20 * x});
  }
  return out;
}

/// Two long arms whose gap is narrower than a cell.
Points make_hairpin() {
  return {{0, 0}, {203, 0}, {203, 43}, {41, 43}, {41, 47}, {203, 47}, {203, 90}, {0, 90}};
}

std::shared_ptr<const RegionMesh> make_region(const Points& outline, double cell = 15) {
  auto made = make_region_mesh(ClosedCurve(outline), cell, MeshKind::kTrimmed);
  EXPECT_TRUE(made) << to_string(made.error());
  return std::make_shared<const RegionMesh>(*std::move(made));
}

PaperSystem make_system(const Points& outline = make_outline(), double cell = 15, double weight = 1) {
  auto made = PaperSystem::make(make_region(outline, cell), weight, {});
  EXPECT_TRUE(made);
  return *std::move(made);
}

PaperSolution solve(const PaperSystem& system, const Points& sketch, const std::vector<PinPair>& pins = {},
                    const PaperOptions& options = {}) {
  auto solved = solve_paper(system, ClosedCurve(sketch), pins, options, {});
  EXPECT_TRUE(solved) << to_string(solved.error());
  return *std::move(solved);
}

std::string error_of(const PaperSystem& system, const Points& sketch, const std::vector<PinPair>& pins,
                     const PaperOptions& options = {}) {
  const auto solved = solve_paper(system, ClosedCurve(sketch), pins, options, {});
  return solved ? "none" : solved.error().code + " " + solved.error().where;
}

double greatest_distance(const Points& a, const Points& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, distance(a[i], b[i]));
  return most;
}

/// Steps of the fractions that do not go forwards, modulo 1.
int count_steps_back(const std::vector<double>& fractions) {
  int back = 0;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    const double step = fractions[(i + 1) % fractions.size()] - fractions[i];
    if (!(step - std::round(step) > 0)) ++back;
  }
  return back;
}

PaperOptions iterations(int count) {
  PaperOptions options;
  options.iterations = count;
  return options;
}

TEST(SolvePaper, RefusesBadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(PaperSystem::make(make_region(make_outline()), nan, {}).error().code, "deform.handle-weight");
  EXPECT_THROW((void)PaperSystem::make(nullptr, 1, {}), BugError);

  const PaperSystem system = make_system();
  const Points from = make_outline(), to = make_sketch();
  const auto pin = [&](int outline, int sketch) { return PinPair{from[outline], to[sketch]}; };
  EXPECT_EQ(error_of(system, to, {}, iterations(-1)), "deform.iterations ");
  EXPECT_EQ(error_of(system, to, {}, iterations(kMostPaperIterations + 1)), "deform.iterations ");
  EXPECT_EQ(error_of(system, to, {pin(0, 0), {{nan, 0}, to[5]}}), "deform.pin-not-finite pin 2");
  EXPECT_EQ(error_of(system, to, {{from[5], {0, HUGE_VAL}}}), "deform.pin-not-finite pin 1");
  EXPECT_EQ(error_of(system, to, {pin(0, 0), pin(60, 180), pin(120, 120), pin(180, 60)}).substr(0, 17),
            "deform.pins-cross");
  EXPECT_EQ(error_of(system, to, {pin(0, 0), pin(120, 40), pin(124, 125)}), "none");
  EXPECT_EQ(error_of(system, to, {pin(0, 0), pin(120, 100), pin(120, 140)}), "deform.pins-cross pins 2 and 3");
  EXPECT_EQ(error_of(system, to, {pin(0, 0), pin(120, 100), {lerp(from[120], from[121], 0.01), to[140]}}),
            "deform.pins-too-close pins 2 and 3");
  EXPECT_EQ(error_of(system, {{0, 0}, {100, 0}, {200, 0}, {100, 0.001}}, {}), "sketch.no-area sketch");
}

TEST(SolvePaper, StopsWhenAsked) {
  const PaperSystem system = make_system();
  std::stop_source stop;
  int reports = 0;
  const auto count = [&](double done, std::string_view) {
    EXPECT_GE(done, 0);
    EXPECT_LT(done, 1);
    if (++reports == 3) stop.request_stop();
  };
  const auto solved = solve_paper(system, ClosedCurve(make_sketch()), {}, {}, {stop.get_token(), count, nullptr});
  ASSERT_FALSE(solved);
  EXPECT_EQ(solved.error(), cancelled());
  EXPECT_EQ(reports, 3);
}

TEST(SolvePaper, SimilarBoundaryGivesTheSimilarity) {
  for (const double cell : {10.0, 25.0}) {
    const PaperSystem system = make_system(make_outline(), cell);
    const Points& vertices = system.region().mesh().vertices;
    const Similarity map{{1.1, -0.8}, {-250, 90}};
    Points loop;
    for (const int vertex : system.region().boundary())
      loop.push_back(map(vertices[vertex]));
    std::rotate(loop.begin(), loop.begin() + 9, loop.end());
    const PaperSolution found = solve(system, loop);
    EXPECT_LT(greatest_distance(found.positions, transformed(vertices, map)), 1e-6);
    EXPECT_LT(found.energies.front(), 1e-12);
    EXPECT_LT(found.energies.back(), 1e-12);
    EXPECT_EQ(found.order_violations, 0);
    EXPECT_LT(greatest_distance(found.outline, transformed(system.region().outline().points(), map)), 1e-6);
  }
}

TEST(SolvePaper, InitialSpacesTheHandlesEvenly) {
  const PaperSystem system = make_system();
  const ClosedCurve sketch(make_sketch());
  const PaperSolution found = solve(system, make_sketch(), {}, iterations(0));
  const std::size_t count = found.handle_s.size();
  ASSERT_EQ(count, system.region().boundary().size());
  ASSERT_EQ(found.energies.size(), 1u);
  for (std::size_t i = 0; i < count; ++i) {
    const double step = sketch.forward(found.handle_s[i], found.handle_s[(i + 1) % count]);
    EXPECT_NEAR(step, sketch.length() / static_cast<double>(count), 1e-9);
  }
  EXPECT_EQ(found.order_violations, 0);
}

TEST(SolvePaper, StepsAreThePapers) {
  const PaperSystem system = make_system();
  const ClosedCurve sketch(make_sketch());
  PaperOptions options = iterations(12);
  options.keep_iterates = true;
  const PaperSolution found = solve(system, make_sketch(), {}, options);
  ASSERT_EQ(found.iterates.size(), 13u);
  for (std::size_t k = 0; k < 13; ++k) {
    const PaperIterate& now = found.iterates[k];
    EXPECT_EQ(now.energy, found.energies[k]);
    ComplexVector h(static_cast<Eigen::Index>(now.handles.size()));
    for (std::size_t i = 0; i < now.handles.size(); ++i)
      h[i] = to_complex(now.handles[i]);
    EXPECT_NEAR(system.handles().slope(h).energy, now.energy, 1e-9 * now.energy);
    if (k == 12) break;
    for (std::size_t i = 0; i < now.handles.size(); ++i) {
      const Point expected = sketch.nearest(now.handles[i] - 0.5 * now.gradients[i]).point;
      EXPECT_EQ(found.iterates[k + 1].handles[i], expected);
    }
  }
  EXPECT_EQ(found.iterates.back().positions, found.positions);
  EXPECT_EQ(found.iterates.back().handles, found.handles);
  EXPECT_EQ(found.iterates.back().gradients, found.gradients);
}

TEST(SolvePaper, DescendsAndStaysOnTheSketch) {
  const ClosedCurve sketch(make_sketch());
  for (const double weight : {0.1, 1.0, 2.0, 3.0, 100.0}) {
    const PaperSystem system = make_system(make_outline(), 15, weight);
    const PaperSolution found = solve(system, make_sketch());
    ASSERT_EQ(found.energies.size(), 51u);
    for (std::size_t k = 1; k < 51; ++k)
      EXPECT_LE(found.energies[k], found.energies[k - 1] * (1 + 1e-12)) << weight;
    EXPECT_LT(found.energies.back(), found.energies.front());
    for (std::size_t i = 0; i < found.handles.size(); ++i) {
      EXPECT_LT(sketch.nearest(found.handles[i]).distance, 1e-9);
      EXPECT_LT(distance(sketch.at(found.handle_s[i]), found.handles[i]), 1e-9);
    }
  }
}

TEST(SolvePaper, LooserHandlesCostLessEnergyAndMissMore) {
  double energy = HUGE_VAL, missed = 0;
  const PaperSystem system = make_system();
  for (const double weight : {10.0, 1.0, 0.5, 0.1}) {
    const auto changed = system.with_handle_weight(weight, {});
    ASSERT_TRUE(changed);
    const PaperSolution found = solve(*changed, make_sketch(), {}, iterations(0));
    EXPECT_LT(found.energies[0], energy);
    EXPECT_GT(greatest_distance(found.boundary, found.handles), missed);
    energy = found.energies[0];
    missed = greatest_distance(found.boundary, found.handles);
  }
}

TEST(SolvePaper, FollowsSimilaritiesOfTheSketch) {
  const PaperSystem system = make_system();
  const PaperSolution here = solve(system, make_sketch());
  for (const Similarity& map : {Similarity{0.05, {10, 20}}, Similarity{20.0, {-3, 4}}, Similarity{{0.6, 0.8}, 0}}) {
    const PaperSolution there = solve(system, transformed(make_sketch(), map));
    const double size = std::abs(map.factor);
    EXPECT_LT(greatest_distance(there.positions, transformed(here.positions, map)), 1e-4 * size);
    EXPECT_NEAR(there.energies.back(), size * size * here.energies.back(), 1e-6 * size * size * here.energies.back());
  }
}

TEST(SolvePaper, ReversedOrRestartedSketchGivesTheSame) {
  const PaperSystem system = make_system();
  const PaperSolution here = solve(system, make_sketch());
  EXPECT_FALSE(here.sketch_reversed);
  Points sketch = make_sketch();
  std::rotate(sketch.begin(), sketch.begin() + 100, sketch.end());
  EXPECT_LT(greatest_distance(solve(system, sketch).positions, here.positions), 1e-4);

  sketch = make_sketch();
  std::reverse(sketch.begin(), sketch.end());
  const PaperSolution there = solve(system, sketch);
  EXPECT_TRUE(there.sketch_reversed);
  EXPECT_LT(greatest_distance(there.positions, here.positions), 1e-4);
  const ClosedCurve curve(sketch);
  for (std::size_t i = 0; i < there.handles.size(); ++i) {
    EXPECT_LT(distance(curve.at(there.handle_s[i]), there.handles[i]), 1e-9);
  }
  const ClosedCurve forwards(make_sketch());
  for (std::size_t i = 0; i < there.correspondence.size(); ++i) {
    EXPECT_LT(distance(curve.at(there.correspondence[i] * curve.length()),
                       forwards.at(here.correspondence[i] * forwards.length())),
              1e-4);
  }
}

TEST(SolvePaper, ReversedOutlineIsTheSameRegion) {
  Points outline = make_outline();
  const PaperSolution here = solve(make_system(outline), make_sketch());
  std::reverse(outline.begin(), outline.end());
  const PaperSolution there = solve(make_system(outline), make_sketch());
  EXPECT_LT(greatest_distance(there.positions, here.positions), 1e-4);
}

TEST(SolvePaper, CorrespondenceRunsRoundOnce) {
  const Points outline = make_outline(), sketch_points = make_sketch();
  const ClosedCurve sketch(sketch_points);
  const PaperSystem system = make_system(outline, 10);
  const PaperSolution found = solve(system, sketch_points);
  ASSERT_EQ(found.correspondence.size(), outline.size());
  EXPECT_EQ(count_steps_back(found.correspondence), 0);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    EXPECT_GE(found.correspondence[i], 0);
    EXPECT_LT(found.correspondence[i], 1);
    EXPECT_LT(distance(sketch.at(found.correspondence[i] * sketch.length()), found.outline[i]), 20);
    EXPECT_LT(distance(sketch_points[i], found.outline[i]), 0.06 * sketch.length());
  }
}

TEST(SolvePaper, PinsAreHeld) {
  const Points from = make_outline(), to = make_sketch();
  const PaperSystem system = make_system(from, 15, 10);
  const std::vector<PinPair> pins{{from[10], to[20]}, {from[200], to[190]}, {from[90], to[105]}};
  for (const int count : {0, 50}) {
    const PaperSolution found = solve(system, to, pins, iterations(count));
    for (const PinPair& pin : pins) {
      const double s = system.region().outline().nearest(pin.outline).s;
      const int loop = system.boundary_map().loop_size();
      const int handle = (static_cast<int>(std::round(system.boundary_map().place_at(s))) + loop) % loop;
      EXPECT_LT(distance(found.handles[handle], pin.sketch), 1e-9);
      EXPECT_LT(distance(found.boundary[handle], pin.sketch), 3);
      EXPECT_LT(distance(system.region().mesh().vertices[system.region().boundary()[handle]], pin.outline), 25);
    }
    if (count == 0) {
      EXPECT_EQ(found.order_violations, 0);
    }
  }
  // Given twice, in another order, or with the sketch reversed: the same.
  const PaperSolution expected = solve(system, to, pins);
  const std::vector<PinPair> other{pins[2], pins[0], pins[1], pins[0]};
  EXPECT_EQ(solve(system, to, other).positions, expected.positions);
  Points backwards = to;
  std::reverse(backwards.begin(), backwards.end());
  EXPECT_LT(greatest_distance(solve(system, backwards, pins).positions, expected.positions), 1e-4);
}

TEST(SolvePaper, OnePinSetsTheShift) {
  const Points from = make_outline(), to = make_sketch();
  const PaperSystem system = make_system();
  const ClosedCurve sketch(to);
  const PaperSolution found = solve(system, to, {{from[0], to[60]}}, iterations(0));
  const std::size_t count = found.handle_s.size();
  std::size_t held = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (distance(found.handles[i], to[60]) < 1e-9) held = i;
    EXPECT_NEAR(sketch.forward(found.handle_s[i], found.handle_s[(i + 1) % count]),
                sketch.length() / static_cast<double>(count), 1e-9);
  }
  EXPECT_LT(distance(system.region().mesh().vertices[system.region().boundary()[held]], from[0]), 25);
}

TEST(SolvePaper, StartsWhereItIsTold) {
  const Points from = make_outline(), to = make_sketch();
  const PaperSystem system = make_system();
  PaperOptions options = iterations(0);
  const ClosedCurve outline(from), sketch(to);
  options.start = {outline.s_at(50), sketch.s_at(80)};
  const PaperSolution found = solve(system, to, {}, options);
  const double place = system.boundary_map().place_at(system.region().outline().nearest(from[50]).s);
  const int loop = system.boundary_map().loop_size(), below = static_cast<int>(std::floor(place));
  const Point a = found.handles[(below + loop) % loop], b = found.handles[(below + 1 + loop) % loop];
  EXPECT_LT(distance(lerp(a, b, place - below), to[80]), 0.5);

  Points backwards = to;
  std::reverse(backwards.begin(), backwards.end());
  options.start->sketch_s = ClosedCurve(backwards).s_at(239 - 80);
  EXPECT_LT(greatest_distance(solve(system, backwards, {}, options).positions, found.positions), 1e-6);
}

TEST(SolvePaper, OneFactorizationServesAllSketches) {
  StageTimes times;
  const Watch watch{{}, {}, &times};
  const auto system = PaperSystem::make(make_region(make_outline()), 1, watch);
  ASSERT_TRUE(system);
  const auto names = [&] {
    std::set<std::string> out;
    for (const auto& stage : times.stages_ms)
      out.insert(stage.first);
    return out;
  };
  EXPECT_EQ(names(), (std::set<std::string>{"matrix", "symbolic", "factor"}));
  times = {};
  ASSERT_TRUE(solve_paper(*system, ClosedCurve(make_sketch()), {}, {}, watch));
  ASSERT_TRUE(solve_paper(*system, ClosedCurve(make_outline()), {}, {}, watch));
  EXPECT_EQ(names(), (std::set<std::string>{"start", "iterations"}));
}

TEST(BoundaryMap, RunsRoundOnceNearTheOutline) {
  for (const Points& outline : {make_outline(), make_hairpin()}) {
    for (const double cell : {6.0, 11.0, 20.0}) {
      const auto region = make_region(outline, cell);
      const BoundaryMap map(*region);
      const std::vector<int>& loop = region->boundary();
      ASSERT_EQ(map.loop_size(), static_cast<int>(loop.size()));
      const double length = region->outline().length();
      EXPECT_NEAR(map.place_at(0.3 * length) + map.loop_size(), map.place_at(1.3 * length), 1e-9);
      double before = map.place_at(0);
      for (int k = 1; k <= 1000; ++k) {
        const double s = length * k / 1000, place = map.place_at(s);
        EXPECT_GT(place, before);
        before = place;
        const int below = static_cast<int>(std::floor(place)), count = map.loop_size();
        const Point a = region->mesh().vertices[loop[(below % count + count) % count]];
        const Point b = region->mesh().vertices[loop[((below + 1) % count + count) % count]];
        EXPECT_LT(distance(lerp(a, b, place - below), region->outline().at(s)), 1.6 * cell) << cell << " " << s;
      }
    }
  }
}

} // namespace
} // namespace oversketch
