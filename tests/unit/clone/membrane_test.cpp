#include "core/clone/membrane.h"

#include "core/base/check.h"
#include "core/clone/pixel_solver.h"
#include "tests/unit/clone/clone_support.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace oversketch {
namespace {

constexpr int kAll[] = {1, 2, 4};

using Ring = std::function<double(int x, int y)>;

/// A ring's values as the membrane takes them: channel 1 carries `value`, channel 2 minus half of it.
std::vector<Float4> float_ring(const PixelGraph& graph, const Ring& value) {
  std::vector<Float4> ring;
  for (const PixelGraph::RingEdge& edge : graph.ring) {
    const auto v = static_cast<float>(value(edge.x, edge.y));
    ring.push_back({Float4::Lanes{0, v, -v / 2, 0}});
  }
  return ring;
}

/// Channel 1 by pixel number.
std::vector<double> span_ring(const Membrane& membrane, const PixelGraph& graph, const Ring& value) {
  const MembraneValues values = membrane.solve(float_ring(graph, value));
  std::vector<double> out;
  const auto add = [&](const Float4& u) {
    EXPECT_EQ(u[0], 0);
    EXPECT_NEAR(u[2], -u[1] / 2, 1e-4F * std::abs(u[1]) + 1e-5F);
    out.push_back(u[1]);
  };
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  for (std::size_t run = 0; run < runs.size(); ++run) {
    membrane.walk(
        values, run, runs[run].y, [&](const Float4* at, int count) { std::for_each(at, at + count, add); },
        [&](const Float4& first, const Float4& step, int count) {
          for (int i = 0; i < count; ++i)
            add(first + static_cast<float>(i) * step);
        });
    EXPECT_EQ(static_cast<int>(out.size()), graph.first[run] + runs[run].x1 - runs[run].x0);
  }
  return out;
}

std::vector<double> solve_exactly(const PixelGraph& graph, const Ring& value) {
  const Result<PixelSolver> solver = PixelSolver::make(graph.mask);
  EXPECT_TRUE(solver.ok());
  std::vector<Channels> side(static_cast<std::size_t>(graph.count));
  for (const PixelGraph::RingEdge& edge : graph.ring)
    side[static_cast<std::size_t>(edge.pixel)].v[1] += value(edge.x, edge.y);
  std::vector<double> out;
  for (const Channels& u : solver->solve(side))
    out.push_back(u.v[1]);
  return out;
}

double worst_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

/// The same value for the same pixel, white noise over 255 levels.
double white_noise(int x, int y) {
  std::mt19937 random(static_cast<unsigned>(x * 7919 + y * 104729));
  random.discard(3);
  return 255 * (static_cast<double>(random()) / 4294967295.0 - 0.5);
}

/// Waves whose height falls with their frequency, as photographs have it; over about 255 levels.
double photograph(int x, int y) {
  double sum = 0;
  for (int i = 0; i < 9; ++i) {
    const double f = 0.01 * std::pow(1.7, i), turn = 2.4 * i;
    sum += 0.7 / std::pow(1.7, i) * std::sin(f * (std::cos(turn) * x + std::sin(turn) * y) + i);
  }
  return 80 * sum;
}

TEST(Membrane, RefusesEmptyAndHugeMasksAndStops) {
  EXPECT_EQ(Membrane::make(PixelGraph(Mask()), 2).error().code, "clone.empty-mask");
  EXPECT_EQ(Membrane::make(PixelGraph(rect_mask({0, 0, 1'000'000, 64})), 4).error().code, "clone.no-membrane");
  const PixelGraph square(rect_mask({0, 0, 30, 30}));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(Membrane::make(square, 2, Watch{stop.get_token(), {}, nullptr}).error(), cancelled());
  EXPECT_THROW((void)Membrane::make(square, 3), BugError);
  const Result<Membrane> membrane = Membrane::make(square, 2);
  ASSERT_TRUE(membrane.ok());
  EXPECT_THROW((void)membrane->solve(std::vector<Float4>(3)), BugError);
}

TEST(Membrane, IsExactWhereThereIsNoRoomForLargeLeaves) {
  for (const Mask& mask : {rect_mask({5, -3, 1, 1}), rect_mask({0, 0, 40, 1}), rect_mask({0, 0, 1, 40}),
                           random_mask({-5, -5, 40, 30}, 0.5, 1), ring_mask(0, 0, 9, 7)})
    for (const int k : kAll) {
      const PixelGraph graph(mask);
      const Result<Membrane> membrane = Membrane::make(graph, k);
      ASSERT_TRUE(membrane.ok());
      EXPECT_EQ(membrane->unknowns(), mask.count());
      EXPECT_LT(worst_difference(span_ring(*membrane, graph, white_noise), solve_exactly(graph, white_noise)), 1e-3);
    }
}

TEST(Membrane, ConstantAndLinearFunctionsAreExactAndZeroIsZero) {
  for (const Mask& mask : large_shapes())
    for (const int k : kAll) {
      const PixelGraph graph(mask);
      const Result<Membrane> membrane = Membrane::make(graph, k);
      ASSERT_TRUE(membrane.ok());
      EXPECT_LT(membrane->unknowns(), mask.count());
      const auto linear = [](int x, int y) { return 40 + 0.5 * x - 0.25 * y; };
      const auto flat = [](int, int) { return 77.0; };
      for (const Ring& function : {Ring(linear), Ring(flat)}) {
        std::vector<double> expected;
        for (const auto& [x, y] : places(mask))
          expected.push_back(function(x, y));
        EXPECT_LT(worst_difference(span_ring(*membrane, graph, function), expected), 2e-3);
      }
      const std::vector<double> zeros(static_cast<std::size_t>(mask.count()));
      EXPECT_EQ(span_ring(*membrane, graph, [](int, int) { return 0.0; }), zeros);
    }
}

TEST(Membrane, ErrorsFallWithKAndStayWithinWhatIsSaid) {
  for (const Mask& mask : large_shapes()) {
    const PixelGraph graph(mask);
    const std::vector<double> noise = solve_exactly(graph, white_noise), picture = solve_exactly(graph, photograph);
    double last_noise = 8, last_picture = 2;
    for (const int k : kAll) {
      const Result<Membrane> membrane = Membrane::make(graph, k);
      ASSERT_TRUE(membrane.ok());
      const double of_noise = worst_difference(span_ring(*membrane, graph, white_noise), noise);
      const double of_picture = worst_difference(span_ring(*membrane, graph, photograph), picture);
      EXPECT_LT(of_noise, last_noise / 2);
      EXPECT_LT(of_picture, last_picture);
      last_noise = of_noise, last_picture = of_picture;
      EXPECT_LT(of_noise, k == 1 ? 4 : k == 2 ? 0.9 : 0.25);
      EXPECT_LT(of_picture, k == 1 ? 2 : k == 2 ? 0.7 : 0.25);
      EXPECT_LT(of_noise, 255 * membrane->error_share());
    }
  }
}

TEST(Membrane, TheErrorShareBoundsTheWorstSigns) {
  // Σ |error at the middle of each size of leaf| over all pixels of the ring: signs against one pixel at a time.
  const PixelGraph graph(disc_mask(0, 0, 24));
  const Result<PixelSolver> solver = PixelSolver::make(graph.mask);
  ASSERT_TRUE(solver.ok());
  for (const int k : kAll) {
    const Result<Membrane> membrane = Membrane::make(graph, k);
    ASSERT_TRUE(membrane.ok());
    std::set<std::pair<int, int>> outer;
    for (const PixelGraph::RingEdge& edge : graph.ring)
      outer.insert({edge.x, edge.y});
    std::vector<double> sums(static_cast<std::size_t>(graph.count));
    for (const auto& [u, v] : outer) {
      const Ring one = [at = std::pair(u, v)](int x, int y) { return std::pair(x, y) == at ? 1.0 : 0.0; };
      std::vector<Channels> side(sums.size());
      for (const PixelGraph::RingEdge& edge : graph.ring)
        side[static_cast<std::size_t>(edge.pixel)].v[1] += one(edge.x, edge.y);
      const std::vector<Channels> exact = solver->solve(side);
      const std::vector<double> near = span_ring(*membrane, graph, one);
      for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] += std::abs(near[i] - exact[i].v[1]) / 2;
    }
    EXPECT_LT(*std::max_element(sums.begin(), sums.end()), membrane->error_share());
  }
}

TEST(Membrane, MovesWithItsMaskToTheBit) {
  const Mask mask = large_shapes()[1];
  const PixelGraph here(mask), there(translated(mask, -1003, 78));
  for (const int k : kAll) {
    const Result<Membrane> a = Membrane::make(here, k), b = Membrane::make(there, k);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(span_ring(*a, here, photograph),
              span_ring(*b, there, [](int x, int y) { return photograph(x + 1003, y - 78); }));
  }
}

TEST(Membrane, IsRefusedWhereHolesAreEverywhereAndOnlyThere) {
  const auto pixel_holes = [](int side, int every) {
    return mask_where({3, -9, side, side}, [=](int x, int y) { return x % every != 0 || y % every != 0; });
  };
  // By the count of operations; before the matrix is made.
  for (const Mask& mask : {pixel_holes(180, 5), pixel_holes(300, 9), random_mask({0, 0, 300, 300}, 0.97, 1)})
    for (const int k : kAll)
      EXPECT_EQ(Membrane::make(PixelGraph(mask), k).error().code, "clone.no-membrane") << mask.count() << " " << k;
  // Large leaves between the holes; narrow though all edge; islands; small.
  const std::vector<Mask> others = {holed_mask(400, 66, 6), snake_mask(300, 3000, 7), pixel_holes(90, 9),
                                    mask_where({0, 0, 400, 400}, [](int x, int y) { return x % 6 < 5 && y % 7 < 5; }),
                                    mask_where({0, 0, 400, 400}, [](int x, int y) { return y < 5 || x % 4 < 3; })};
  for (const Mask& mask : others)
    for (const int k : kAll)
      EXPECT_TRUE(Membrane::make(PixelGraph(mask), k).ok()) << mask.count() << " " << k;
}

TEST(Membrane, MemoryFollowsTheEdge) {
  const Result<Membrane> small = Membrane::make(PixelGraph(rect_mask({0, 0, 128, 128})), 2);
  const Result<Membrane> large = Membrane::make(PixelGraph(rect_mask({0, 0, 512, 512})), 2);
  ASSERT_TRUE(small.ok() && large.ok());
  EXPECT_LT(large->bytes(), 6 * small->bytes());
}

} // namespace
} // namespace oversketch
