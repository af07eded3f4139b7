#include "core/deform/metrics.h"

#include "core/base/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace oversketch {
namespace {

/// `columns` × `rows` whole cells of side 3.
QuadMesh grid_mesh(int columns, int rows) {
  QuadMesh mesh;
  mesh.cell = 3;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x)
      mesh.vertices.push_back({3.0 * x + 7, 3.0 * y - 2});
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int i = y * (columns + 1) + x;
      mesh.cells.push_back({i, i + 1, i + columns + 2, i + columns + 1});
      mesh.coverage.push_back(1);
    }
  return mesh;
}

template <class Map>
Points mapped(const QuadMesh& mesh, Map map) {
  Points points;
  for (const Point p : mesh.vertices)
    points.push_back(map(p));
  return points;
}

ClosedCurve circle(double radius, int count) {
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back(to_point(std::polar(radius, 2 * std::numbers::pi * i / count)));
  return ClosedCurve(points);
}

TEST(Metrics, RefuseWhatDoesNotBelongTogether) {
  const QuadMesh mesh = grid_mesh(2, 2);
  EXPECT_THROW((void)measure_distortion(mesh, {}), BugError);
  QuadMesh no_coverage = mesh;
  no_coverage.coverage.clear();
  EXPECT_THROW((void)measure_distortion(no_coverage, mesh.vertices), BugError);
  EXPECT_THROW((void)truth_error({{0, 0}}, {}, 1), BugError);
  EXPECT_THROW((void)truth_error({}, {}, 1), BugError);
  EXPECT_THROW((void)truth_error({{0, 0}}, {{0, 0}}, 0), BugError);
  EXPECT_THROW((void)count_order_violations(std::vector{0.1, std::numeric_limits<double>::quiet_NaN()}), BugError);
}

TEST(Distortion, SimilarityHasNone) {
  const QuadMesh mesh = grid_mesh(5, 4);
  const DistortionMetrics m = measure_distortion(mesh, transformed(mesh.vertices, {std::polar(0.3, 2.0), {5, 6}}));
  EXPECT_EQ(m.flipped_cells, 0);
  EXPECT_EQ(m.cells_counted, 20);
  EXPECT_NEAR(m.sigma_ratio_mean, 1, 1e-12);
  EXPECT_NEAR(m.sigma_ratio_max, 1, 1e-12);
  EXPECT_NEAR(m.area_spread, 1, 1e-12);
}

TEST(Distortion, StretchHasItsRatioInEveryDirection) {
  const QuadMesh mesh = grid_mesh(5, 4);
  for (const double k : {1.5, 4.0, 0.25})
    for (const double angle : {0.0, 0.7, 2.0}) {
      const Similarity turn{std::polar(1.0, angle), 0}, back{std::polar(2.0, 0.3), 0};
      const DistortionMetrics m = measure_distortion(mesh, mapped(mesh, [&](Point p) {
                                                       const Point q = turn(p);
                                                       return back({k * q.x, q.y});
                                                     }));
      EXPECT_EQ(m.flipped_cells, 0);
      EXPECT_NEAR(m.sigma_ratio_mean, std::max(k, 1 / k), 1e-9);
      EXPECT_NEAR(m.sigma_ratio_p95, std::max(k, 1 / k), 1e-9);
      EXPECT_NEAR(m.sigma_ratio_max, std::max(k, 1 / k), 1e-9);
      EXPECT_NEAR(m.area_spread, 1, 1e-9);
    }
}

TEST(Distortion, MirrorFlipsAll) {
  const QuadMesh mesh = grid_mesh(5, 4);
  const DistortionMetrics m = measure_distortion(mesh, mapped(mesh, [](Point p) { return Point{-p.x, p.y}; }));
  EXPECT_EQ(m.flipped_cells, 20);
  EXPECT_NEAR(m.sigma_ratio_mean, 1, 1e-12);
  EXPECT_EQ(m.area_spread, std::numeric_limits<double>::infinity());
}

TEST(Distortion, OneCornerIsEnoughToFlipACell) {
  const QuadMesh mesh = grid_mesh(1, 1);
  for (int k = 0; k < 4; ++k) {
    Points moved = mesh.vertices;
    const auto& cell = mesh.cells[0];
    // On the diagonal exactly: the determinant is 0.
    moved[cell[k]] = 0.5 * (moved[cell[(k + 1) & 3]] + moved[cell[(k + 3) & 3]]);
    EXPECT_EQ(measure_distortion(mesh, moved).flipped_cells, 1);
    moved[cell[k]] += 0.01 * (mesh.vertices[cell[k]] - moved[cell[k]]);
    EXPECT_EQ(measure_distortion(mesh, moved).flipped_cells, 0);
  }
  Points lost = mesh.vertices;
  lost[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(measure_distortion(mesh, lost).flipped_cells, 1);
}

TEST(Distortion, CollapsedCellHasNoBound) {
  const QuadMesh mesh = grid_mesh(3, 1);
  const DistortionMetrics m = measure_distortion(mesh, mapped(mesh, [](Point p) { return Point{p.x, 0}; }));
  EXPECT_EQ(m.flipped_cells, 3);
  EXPECT_EQ(m.sigma_ratio_max, std::numeric_limits<double>::infinity());
}

TEST(Distortion, HardlyCoveredCellsCountForFlipsAlone) {
  QuadMesh mesh = grid_mesh(2, 1);
  mesh.coverage = {0.3, 0.31};
  Points moved = mesh.vertices;
  moved[0] = {1000, 1000};
  DistortionMetrics m = measure_distortion(mesh, moved);
  EXPECT_EQ(m.flipped_cells, 1);
  EXPECT_EQ(m.cells_counted, 1);
  EXPECT_DOUBLE_EQ(m.sigma_ratio_max, 1);
  mesh.coverage = {0.1, 0.1};
  m = measure_distortion(mesh, moved);
  EXPECT_EQ(m.cells_counted, 0);
  EXPECT_EQ(m.area_spread, 1);
}

/// Column k is stretched by 1 + k: percentiles between ranks are known.
TEST(Distortion, PercentilesLieBetweenRanks) {
  const int columns = 11;
  const QuadMesh mesh = grid_mesh(columns, 1);
  const DistortionMetrics m = measure_distortion(mesh, mapped(mesh, [](Point p) {
                                                   const int k = static_cast<int>(std::lround((p.x - 7) / 3));
                                                   return Point{3.0 * k * (k + 1) / 2, p.y};
                                                 }));
  // Ratios and determinants 1 … 11; ranks 0.5 and 9.5 of 0 … 10.
  EXPECT_NEAR(m.sigma_ratio_mean, 6, 1e-9);
  EXPECT_NEAR(m.sigma_ratio_p95, 10.5, 1e-9);
  EXPECT_NEAR(m.sigma_ratio_max, 11, 1e-9);
  EXPECT_NEAR(m.area_spread, 10.5 / 1.5, 1e-9);
}

TEST(SketchDistance, OfConcentricCirclesIsTheirGap) {
  const SketchDistance d = measure_sketch_distance(circle(100, 5000), circle(103, 700));
  EXPECT_NEAR(d.mean, 3, 2e-3);
  EXPECT_NEAR(d.max, 3, 2e-3);
}

TEST(SketchDistance, IsSymmetricAndZeroForTheSameCurve) {
  const ClosedCurve a = circle(50, 7), b({{0, 0}, {90, 10}, {20, 70}});
  EXPECT_NEAR(measure_sketch_distance(a, a).max, 0, 1e-9);
  const SketchDistance there = measure_sketch_distance(a, b), back = measure_sketch_distance(b, a);
  EXPECT_DOUBLE_EQ(there.mean, back.mean);
  EXPECT_DOUBLE_EQ(there.max, back.max);
}

TEST(SketchDistance, SeesASpikeOnEitherSide) {
  const ClosedCurve square({{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  const ClosedCurve spike({{0, 0}, {50, 0}, {50.001, -40}, {50.002, 0}, {100, 0}, {100, 100}, {0, 100}});
  EXPECT_NEAR(measure_sketch_distance(square, spike).max, 40, 1e-9);
  EXPECT_NEAR(measure_sketch_distance(spike, square).max, 40, 1e-9);
  // The spike: mean 20 over 80 of 480 px, seen from one side only.
  EXPECT_NEAR(measure_sketch_distance(square, spike).mean, 0.5 * 20 * 80 / 480, 0.02);
}

TEST(TruthError, IsTheMeanDistanceByTheLength) {
  EXPECT_DOUBLE_EQ(truth_error({{0, 0}, {3, 4}}, {{0, 0}, {0, 0}}, 10), 0.25);
  EXPECT_EQ(truth_error({{1, 2}}, {{1, 2}}, 10), 0);
}

TEST(OrderViolations, NoneWhenIncreasingOnceRound) {
  EXPECT_EQ(count_order_violations({}), 0);
  EXPECT_EQ(count_order_violations(std::vector{0.4}), 0);
  EXPECT_EQ(count_order_violations(std::vector{0.1, 0.2, 0.9}), 0);
  EXPECT_EQ(count_order_violations(std::vector{0.9, 0.1, 0.2}), 0);
  EXPECT_EQ(count_order_violations(std::vector{0.9, 1.1, 1.2}), 0);
  // One long step of more than half a turn is still forwards.
  EXPECT_EQ(count_order_violations(std::vector{0.1, 0.8, 0.9}), 0);
  EXPECT_EQ(count_order_violations(std::vector{0.1, 0.7}), 0);
}

TEST(OrderViolations, CountsStepsBackAndStandingStill) {
  EXPECT_EQ(count_order_violations(std::vector{0.1, 0.3, 0.2, 0.9}), 1);
  EXPECT_EQ(count_order_violations(std::vector{0.1, 0.3, 0.3, 0.9}), 1);
  EXPECT_EQ(count_order_violations(std::vector{0.1, 0.3, 0.2, 0.6, 0.5, 0.9}), 2);
  EXPECT_EQ(count_order_violations(std::vector{0.1, 0.1, 0.1}), 2);
  EXPECT_EQ(count_order_violations(std::vector{0.0, -1e-17, 0.5}), 1);
}

TEST(OrderViolations, CountsTurnsTooMany) {
  EXPECT_EQ(count_order_violations(std::vector{0.0, 0.4, 0.8, 0.2, 0.6}), 1);
  // 19 steps back, and one forwards for the turn that there must be.
  std::vector<double> reversed;
  for (int i = 0; i < 20; ++i)
    reversed.push_back(1 - i / 20.0);
  EXPECT_EQ(count_order_violations(reversed), 18);
}

} // namespace
} // namespace oversketch
