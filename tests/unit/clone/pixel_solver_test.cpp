#include "core/clone/pixel_solver.h"

#include "core/base/check.h"
#include "core/clone/feather.h"
#include "tests/unit/clone/clone_support.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace oversketch {
namespace {

TEST(PixelSolver, RefusesEmptyAndHugeMasksAndStops) {
  EXPECT_EQ(PixelSolver::make(Mask()).error().code, "clone.empty-mask");
  const Mask square = rect_mask({0, 0, 30, 30});
  EXPECT_EQ(PixelSolver::make(square, {}, PixelSolver::estimate_bytes(900) - 1).error().code, "clone.too-large");
  EXPECT_TRUE(PixelSolver::make(square, {}, PixelSolver::estimate_bytes(900)).ok());
  // Refused by size alone, before anything is allocated.
  EXPECT_EQ(PixelSolver::make(rect_mask({0, 0, 1'000'000, 100})).error().code, "clone.too-large");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(PixelSolver::make(square, Watch{stop.get_token(), {}, nullptr}).error(), cancelled());
  // Stopped by what it reports while it works.
  std::stop_source later;
  Watch watch{later.get_token(),
              [&](double, std::string_view stage) {
                if (stage == "factoring") later.request_stop();
              },
              nullptr};
  EXPECT_EQ(PixelSolver::make(square, watch).error(), cancelled());
  std::vector<Channels> wrong(899);
  const Result<PixelSolver> solver = PixelSolver::make(square);
  EXPECT_THROW((void)solver->solve(wrong), BugError);
}

TEST(PixelGraph, HasEveryNeighbourOnce) {
  for (const Mask& mask : shapes()) {
    const PixelGraph graph(mask);
    const std::vector<std::pair<int, int>> at = places(mask);
    ASSERT_EQ(static_cast<std::size_t>(graph.count), at.size());
    std::multiset<std::tuple<int, int, int>> ring, ring_expected;
    std::multiset<std::pair<int, int>> vertical, vertical_expected;
    for (const PixelGraph::RingEdge& edge : graph.ring)
      ring.insert({edge.pixel, edge.x, edge.y});
    for (const PixelGraph::Stretch& s : graph.stretches)
      for (int i = 0; i < s.length; ++i)
        vertical.insert({s.upper + i, s.lower + i});
    std::map<std::pair<int, int>, int> number;
    for (std::size_t k = 0; k < at.size(); ++k)
      number[at[k]] = static_cast<int>(k);
    for (const auto& [place, k] : number) {
      const auto [x, y] = place;
      for (const auto& [u, v] : {std::pair{x - 1, y}, std::pair{x + 1, y}, std::pair{x, y - 1}, std::pair{x, y + 1}})
        if (!number.contains({u, v})) ring_expected.insert({k, u, v});
      if (number.contains({x, y + 1})) vertical_expected.insert({k, number[{x, y + 1}]});
    }
    EXPECT_EQ(ring, ring_expected);
    EXPECT_EQ(vertical, vertical_expected);
    for (std::size_t run = 0; run < mask.runs().size(); ++run)
      EXPECT_EQ(graph.first[run], (number[{mask.runs()[run].x0, mask.runs()[run].y}]));
  }
}

/// A u straight from the definition; by pixel number.
std::vector<Channels> apply_laplacian(const Mask& mask, const std::vector<Channels>& u) {
  const std::vector<std::pair<int, int>> at = places(mask);
  std::map<std::pair<int, int>, std::size_t> number;
  for (std::size_t k = 0; k < at.size(); ++k)
    number[at[k]] = k;
  std::vector<Channels> out(u.size());
  for (std::size_t k = 0; k < at.size(); ++k) {
    const auto [x, y] = at[k];
    out[k] = 4.0 * u[k];
    for (const auto& neighbour : {std::pair{x - 1, y}, std::pair{x + 1, y}, std::pair{x, y - 1}, std::pair{x, y + 1}})
      if (const auto found = number.find(neighbour); found != number.end()) out[k] -= u[found->second];
  }
  return out;
}

TEST(PixelSolver, UndoesTheLaplacian) {
  std::mt19937 random(4);
  std::normal_distribution<double> value;
  for (const Mask& mask : shapes()) {
    const Result<PixelSolver> solver = PixelSolver::make(mask);
    ASSERT_TRUE(solver.ok());
    EXPECT_EQ(solver->unknowns(), mask.count());
    EXPECT_GE(solver->bytes(), 12 * mask.count());
    EXPECT_LE(solver->bytes(), PixelSolver::estimate_bytes(mask.count()));
    std::vector<Channels> u(static_cast<std::size_t>(mask.count()));
    for (Channels& c : u)
      for (double& v : c.v)
        v = value(random);
    const std::vector<Channels> b = apply_laplacian(mask, u);
    const std::vector<Channels> x = solver->solve(b);
    double worst = 0;
    for (std::size_t k = 0; k < u.size(); ++k)
      for (std::size_t c = 0; c < 4; ++c)
        worst = std::max(worst, std::abs(x[k].v[c] - u[k].v[c]));
    EXPECT_LT(worst, 1e-12);
    EXPECT_LT(solver->error_bound(x, b), 1e-11);
  }
}

TEST(PixelSolver, TheErrorBoundIsABound) {
  std::mt19937 random(5);
  std::normal_distribution<double> value;
  for (const Mask& mask : shapes()) {
    const Result<PixelSolver> solver = PixelSolver::make(mask);
    ASSERT_TRUE(solver.ok());
    const std::size_t n = static_cast<std::size_t>(mask.count());
    for (const bool smooth : {false, true}) {
      // The smooth one, A e = 1, is the worst there is.
      std::vector<Channels> error(n);
      for (Channels& c : error)
        c.v[1] = smooth ? 1 : value(random);
      if (smooth) error = solver->solve(error);
      double worst = 0;
      for (const Channels& c : error)
        worst = std::max(worst, std::abs(c.v[1]));
      // Exact solution 0 of A u = 0: all of u is error.
      EXPECT_GE(solver->error_bound(error, std::vector<Channels>(n)), worst);
    }
  }
}

TEST(SquaredDepths, AreTheDistancesToTheNearestOutside) {
  for (const Mask& mask : shapes()) {
    const std::vector<double> depths = squared_depths(PixelGraph(mask));
    const std::vector<std::pair<int, int>> at = places(mask);
    const Rect box = grown(mask.bounds(), 1);
    for (std::size_t k = 0; k < at.size(); ++k) {
      double best = HUGE_VAL;
      for (int y = box.y; y < box.bottom(); ++y)
        for (int x = box.x; x < box.right(); ++x)
          if (!mask.contains(x, y)) best = std::min(best, std::pow(x - at[k].first, 2) + std::pow(y - at[k].second, 2));
      ASSERT_EQ(depths[k], best);
    }
  }
}

TEST(InsideWeights, RiseFromTheEdge) {
  const PixelGraph graph(rect_mask({0, 0, 41, 41}));
  const std::vector<double> hard = inside_weights(graph, 0), soft = inside_weights(graph, 9);
  EXPECT_EQ(hard, std::vector<double>(41 * 41, 1.0));
  for (int x = 0; x < 20; ++x) {
    const double t = std::min(1.0, (x + 1) / 10.0);
    EXPECT_NEAR(soft[static_cast<std::size_t>(20 * 41 + x)], t * t * (3 - 2 * t), 1e-15);
  }
}

} // namespace
} // namespace oversketch
