#include "core/clone/multigrid.h"

#include "core/base/check.h"
#include "core/clone/pixel_solver.h"
#include "tests/unit/clone/grid_shapes.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

constexpr double kLevel = 1.0 / 255;

/// Noise, with sums that are far from 0: both rough and smooth errors.
std::vector<Channels> noise_side(const Mask& mask, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> value;
  std::vector<Channels> b(static_cast<std::size_t>(mask.count()));
  for (Channels& c : b)
    for (std::size_t k = 0; k < 3; ++k)
      c.v[k] = static_cast<float>(0.05 * value(random) + 0.0005);
  return b;
}

void set_side(MultigridSolve& solve, const Mask& mask, const std::vector<Channels>& b) {
  std::size_t k = 0;
  std::vector<Float4> line;
  for (std::size_t run = 0; run < mask.runs().size(); ++run) {
    line.clear();
    for (int x = mask.runs()[run].x0; x < mask.runs()[run].x1; ++x, ++k)
      line.push_back({Float4::Lanes{static_cast<float>(b[k].v[0]), static_cast<float>(b[k].v[1]),
                                    static_cast<float>(b[k].v[2]), 7}});
    solve.set_side(run, line);
  }
}

std::vector<Float4> get(const MultigridSolve& solve, const Mask& mask) {
  std::vector<Float4> all, line;
  for (std::size_t run = 0; run < mask.runs().size(); ++run) {
    line.resize(static_cast<std::size_t>(mask.runs()[run].x1 - mask.runs()[run].x0));
    solve.get(run, line);
    all.insert(all.end(), line.begin(), line.end());
  }
  return all;
}

double worst_error(const std::vector<Float4>& u, const std::vector<Channels>& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(static_cast<double>(u[i][k]) - exact[i].v[k]));
  return worst;
}

std::vector<Channels> solve_directly(const Mask& mask, const std::vector<Channels>& b) {
  const Result<PixelSolver> solver = PixelSolver::make(mask);
  EXPECT_TRUE(solver.ok());
  return solver->solve(b);
}

MultigridSolve make_solve(const Mask& mask, double screening = 0) {
  const Result<MaskMultigrid> grids = MaskMultigrid::make(mask, screening);
  EXPECT_TRUE(grids.ok());
  return MultigridSolve(*grids);
}

TEST(Multigrid, RefusesEmptyAndHugeMasksAndStops) {
  EXPECT_EQ(MaskMultigrid::make(Mask()).error().code, "clone.empty-mask");
  std::vector<Mask::Run> huge;
  for (int y = 0; y < 201; ++y)
    huge.push_back({y, 0, 1'000'000});
  EXPECT_EQ(MaskMultigrid::make(Mask(huge)).error().code, "clone.too-large");
  const Mask square = rect_mask({0, 0, 200, 200});
  EXPECT_THROW((void)MaskMultigrid::make(square, -1), BugError);
  EXPECT_THROW((void)MaskMultigrid::make(square, std::nan("")), BugError);
  std::stop_source stop;
  stop.request_stop();
  const Watch stopped{stop.get_token(), {}, nullptr};
  EXPECT_EQ(MaskMultigrid::make(square, 0, stopped).error(), cancelled());
  MultigridSolve solve = make_solve(square);
  set_side(solve, square, noise_side(square, 1));
  EXPECT_EQ(solve.solve(0, 1, 5, stopped).error(), cancelled());
  std::vector<Float4> wrong(199);
  EXPECT_THROW(solve.set_side(0, wrong), BugError);
  EXPECT_THROW(solve.set_start(0, wrong), BugError);
  EXPECT_THROW(solve.get(0, wrong), BugError);
}

TEST(Multigrid, SolvesOnMasksOfAnyShape) {
  for (const auto& [name, mask] : all_masks()) {
    const std::vector<Channels> b = noise_side(mask, 2);
    const std::vector<Channels> exact = solve_directly(mask, b);
    MultigridSolve solve = make_solve(mask);
    set_side(solve, mask, b);
    const auto done = solve.solve(0.02 * kLevel, 1, 60);
    ASSERT_TRUE(done.ok()) << name;
    EXPECT_LE(done->error, 0.02 * kLevel) << name;
    EXPECT_LE(done->cycles, 16) << name;
    EXPECT_LT(worst_error(get(solve, mask), exact), 0.02 * kLevel) << name;
  }
}

TEST(Multigrid, SaysHowLargeTheErrorIs) {
  for (const auto& [name, mask] : all_masks()) {
    const std::vector<Channels> b = noise_side(mask, 3);
    const std::vector<Channels> exact = solve_directly(mask, b);
    for (const int cycles : {1, 2, 3, 4, 5}) {
      MultigridSolve solve = make_solve(mask);
      set_side(solve, mask, b);
      const auto done = solve.solve(0, cycles, cycles);
      const double error = worst_error(get(solve, mask), exact);
      if (error > 0.01 * kLevel) EXPECT_GE(done->error, error) << name << " after " << cycles;
      // And not a hundred times too much, once the first guess is past.
      if (cycles > 2 && error > 0.01 * kLevel) EXPECT_LE(done->error, 100 * error) << name << " after " << cycles;
    }
  }
}

/// It ends by half a sweep where that is good enough.
TEST(Multigrid, IsAsNearAsAskedAndSaysSo) {
  for (const auto& [name, mask] : all_masks()) {
    const std::vector<Channels> b = noise_side(mask, 13);
    const std::vector<Channels> exact = solve_directly(mask, b);
    for (const double levels : {8.0, 2.0, 0.5, 0.1}) {
      MultigridSolve solve = make_solve(mask);
      set_side(solve, mask, b);
      const auto done = solve.solve(levels * kLevel, 1, 60);
      EXPECT_LE(done->error, levels * kLevel) << name;
      EXPECT_LE(worst_error(get(solve, mask), exact), done->error + 0.01 * kLevel) << name << " " << levels;
    }
  }
}

/// Row by row while the first cycle looks at it, or before from a start: as if it had been set.
TEST(Multigrid, HasItsSideWritten) {
  for (const NamedMask& named : all_masks()) {
    const Mask& mask = named.mask;
    const std::vector<Channels> b = noise_side(mask, 14);
    for (const int threads : {1, 3})
      for (const bool from_zero : {true, false}) {
        MultigridSolve set = make_solve(mask), written = make_solve(mask), from = make_solve(mask);
        set_side(set, mask, b);
        set_side(from, mask, b);
        const auto copy = [&](std::size_t run) {
          const GridSlots<float> to = written.side(run), side = from.side(run);
          for (std::size_t i = 0; i < static_cast<std::size_t>(mask.runs()[run].x1 - mask.runs()[run].x0); ++i)
            std::copy_n(side.at(i), kGridChannels, to.at(i));
        };
        written.use_threads(threads);
        written.set_side_by([&] {
          return [&](std::size_t begin, std::size_t end) {
            for (std::size_t run = begin; run < end; ++run)
              copy(run);
            return true;
          };
        });
        if (!from_zero)
          for (MultigridSolve* solve : {&set, &written})
            for (std::size_t run = 0; run < mask.runs().size(); ++run)
              solve->set_start(run,
                               std::vector<Float4>(static_cast<std::size_t>(mask.runs()[run].x1 - mask.runs()[run].x0),
                                                   Float4{Float4::Lanes{0.5F, 0.25F, 1, 0}}));
        ASSERT_TRUE(set.solve(0, 2, 2).ok() && written.solve(0, 2, 2).ok());
        EXPECT_TRUE(std::ranges::equal(get(set, mask), get(written, mask), [](const Float4& p, const Float4& q) {
          return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
        })) << named.name;
      }
    MultigridSolve solve = make_solve(mask);
    solve.set_side_by([] { return [](std::size_t, std::size_t) { return false; }; });
    const auto done = solve.solve(0, 2, 2);
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().code, "clone.not-finite");
  }
}

/// How much smaller the error becomes by the third of three cycles.
double contraction_on(const Mask& mask) {
  const std::vector<Channels> b = noise_side(mask, 4);
  const std::vector<Channels> exact = solve_directly(mask, b);
  double before = 0, after = 0;
  for (const int cycles : {2, 3}) {
    MultigridSolve solve = make_solve(mask);
    set_side(solve, mask, b);
    EXPECT_EQ(solve.solve(0, cycles, cycles)->cycles, cycles);
    before = after;
    after = worst_error(get(solve, mask), exact);
  }
  return before == 0 ? 0 : after / before;
}

TEST(Multigrid, ACycleTakesOffFourFifthsOfTheErrorOnWholeRegions) {
  for (const auto& [name, mask] : plain_masks())
    EXPECT_LT(contraction_on(mask), 0.2) << name;
}

TEST(Multigrid, ACycleTakesOffHalfOfTheErrorOnAnyMask) {
  for (const auto& [name, mask] : tricky_masks())
    EXPECT_LT(contraction_on(mask), 0.5) << name;
}

TEST(Multigrid, GivesTheSameBitsWithAnyNumberOfThreads) {
  // Large enough to be cut into bands, on the second grid too; with and without tricks.
  for (const Mask& mask : {rect_mask({3, 5, 700, 650}), holed_mask(600, 40, 6), snake_mask(400, 1500, 60)}) {
    const std::vector<Channels> b = noise_side(mask, 5);
    std::vector<Float4> expected;
    for (const int threads : {1, 2, 3, 7}) {
      MultigridSolve solve = make_solve(mask);
      solve.use_threads(threads);
      set_side(solve, mask, b);
      ASSERT_TRUE(solve.solve(0, 4, 4).ok());
      const std::vector<Float4> u = get(solve, mask);
      if (expected.empty()) expected = u;
      for (std::size_t i = 0; i < u.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k)
          ASSERT_EQ(u[i][k], expected[i][k]) << threads;
    }
  }
}

TEST(Multigrid, ARingsSideGivesTheBitsThatAllOfItGives) {
  std::mt19937 random(5);
  std::normal_distribution<float> value;
  for (const auto& [name, mask] : all_masks()) {
    SCOPED_TRACE(name);
    const PixelGraph graph(mask);
    std::vector<Float4> ring(graph.ring.size());
    for (Float4& v : ring)
      v = {Float4::Lanes{value(random), value(random), value(random), 0}};
    std::vector<Channels> b(static_cast<std::size_t>(mask.count()));
    std::vector<Float4> line;
    MultigridSolve solve = make_solve(mask);
    const auto start = [&, &mask = mask] {
      for (std::size_t run = 0; run < mask.runs().size(); ++run) {
        line.assign(static_cast<std::size_t>(mask.runs()[run].x1 - mask.runs()[run].x0),
                    {Float4::Lanes{0.5F, 0.1F, -0.2F, 0}});
        solve.set_start(run, line);
      }
    };
    const auto solved = [&, &mask = mask] {
      EXPECT_TRUE(solve.solve(0, 3, 3).ok());
      return get(solve, mask);
    };
    // What stands in b from before is not to be read.
    set_side(solve, mask, noise_side(mask, 9));
    start();
    solve.set_ring_side(graph, ring);
    const std::vector<Float4> from_ring = solved();
    solve.start_from_zero();
    solve.set_ring_side(graph, ring);
    const std::vector<Float4> ring_from_zero = solved();
    std::vector<Float4> sums(b.size());
    for (std::size_t edge = 0; edge < ring.size(); ++edge)
      sums[static_cast<std::size_t>(graph.ring[edge].pixel)] += ring[edge];
    for (std::size_t i = 0; i < b.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        b[i].v[k] = sums[i][k];
    set_side(solve, mask, b);
    start();
    const std::vector<Float4> from_all = solved();
    solve.start_from_zero();
    const std::vector<Float4> all_from_zero = solved();
    for (std::size_t i = 0; i < b.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_TRUE(from_ring[i][k] == from_all[i][k] && ring_from_zero[i][k] == all_from_zero[i][k]) << i;
  }
  MultigridSolve solve = make_solve(disc_mask(0, 0, 60));
  const PixelGraph graph(disc_mask(0, 0, 60));
  for (std::size_t run = 0; run < graph.first.size(); ++run)
    solve.set_start(
        run, std::vector<Float4>(static_cast<std::size_t>(graph.mask.runs()[run].x1 - graph.mask.runs()[run].x0)));
  solve.set_ring_side(graph, std::vector<Float4>(graph.ring.size()));
  solve.start_from_zero();
  EXPECT_THROW((void)solve.solve(0, 1, 1), BugError);
}

TEST(Multigrid, MemoryFollowsThePixels) {
  for (const auto& [name, mask] : all_masks()) {
    const Result<MaskMultigrid> grids = MaskMultigrid::make(mask);
    const std::int64_t bytes = grids->bytes() + MultigridSolve(*grids).bytes();
    // What is factored at the end takes less than this, whatever the mask.
    EXPECT_LE(bytes, 40 * mask.count() + 100'000) << name;
  }
  for (const Mask& mask : {random_mask({0, 0, 900, 900}, 0.5, 1), random_mask({0, 0, 900, 900}, 0.7, 2),
                           rect_mask({0, 0, 1, 500'000}), rect_mask({0, 0, 800, 800})}) {
    const Result<MaskMultigrid> grids = MaskMultigrid::make(mask);
    EXPECT_LE(grids->bytes() + MultigridSolve(*grids).bytes(), 37 * mask.count());
  }
}

TEST(Multigrid, GoesOnFromWhereItIsTold) {
  const Mask mask = disc_mask(0, 0, 60);
  const std::vector<Channels> b = noise_side(mask, 6);
  const std::vector<Channels> exact = solve_directly(mask, b);
  MultigridSolve solve = make_solve(mask);
  set_side(solve, mask, b);
  std::vector<Float4> line;
  std::size_t k = 0;
  for (std::size_t run = 0; run < mask.runs().size(); ++run) {
    line.clear();
    for (int x = mask.runs()[run].x0; x < mask.runs()[run].x1; ++x, ++k)
      line.push_back({Float4::Lanes{static_cast<float>(exact[k].v[0]), static_cast<float>(exact[k].v[1]),
                                    static_cast<float>(exact[k].v[2]), 7}});
    solve.set_start(run, line);
  }
  const auto done = solve.solve(0.02 * kLevel, 1, 9);
  EXPECT_EQ(done->cycles, 1);
  EXPECT_LT(worst_error(get(solve, mask), exact), 0.01 * kLevel);
  // From zero again.
  solve.start_from_zero();
  EXPECT_GT(solve.solve(0.02 * kLevel, 1, 9)->cycles, 2);
}

TEST(Multigrid, ForgetsWhatItSolvedBefore) {
  for (const Mask& mask : {disc_mask(0, 0, 60), holed_mask(150, 16, 0)}) {
    const std::vector<Channels> b = noise_side(mask, 9);
    std::vector<Float4> first;
    MultigridSolve solve = make_solve(mask);
    for (const int seed : {0, 10, 11}) {
      if (seed > 0) {
        set_side(solve, mask, noise_side(mask, static_cast<unsigned>(seed)));
        ASSERT_TRUE(solve.solve(0, 5, 5).ok());
      }
      set_side(solve, mask, b);
      solve.start_from_zero();
      ASSERT_TRUE(solve.solve(0, 5, 5).ok());
      const std::vector<Float4> u = get(solve, mask);
      if (first.empty()) first = u;
      for (std::size_t i = 0; i < u.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_EQ(u[i][k], first[i][k]);
    }
  }
}

TEST(Multigrid, OfNothingIsNothing) {
  for (const auto& [name, mask] : all_masks()) {
    MultigridSolve solve = make_solve(mask);
    set_side(solve, mask, std::vector<Channels>(static_cast<std::size_t>(mask.count())));
    ASSERT_TRUE(solve.solve(0, 3, 3).ok());
    for (const Float4& u : get(solve, mask))
      for (std::size_t k = 0; k < 4; ++k)
        ASSERT_EQ(u[k], 0) << name;
  }
}

TEST(Multigrid, ScreeningIsAddedToTheDiagonal) {
  for (const double screening : {1e-4, 0.02, 3.0, 1e6})
    for (const Mask& mask : {disc_mask(0, 0, 50), holed_mask(120, 30, 4), rect_mask({0, 0, 9, 9})}) {
      // b = (A + λ) u, from the definition.
      std::mt19937 random(7);
      std::normal_distribution<double> value;
      const PixelGraph graph(mask);
      std::vector<Channels> u(static_cast<std::size_t>(mask.count())), b(u.size());
      for (Channels& c : u)
        for (std::size_t k = 0; k < 3; ++k)
          c.v[k] = static_cast<float>(0.5 + 0.1 * value(random));
      std::map<std::pair<int, int>, std::size_t> number;
      for (const Mask::Run& run : mask.runs())
        for (int x = run.x0; x < run.x1; ++x)
          number.emplace(std::pair{x, run.y}, number.size());
      for (const auto& [place, p] : number) {
        b[p] = (4 + screening) * u[p];
        for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}})
          if (const auto q = number.find({place.first + dx, place.second + dy}); q != number.end())
            b[p] -= u[q->second];
      }
      MultigridSolve solve = make_solve(mask, screening);
      set_side(solve, mask, b);
      ASSERT_TRUE(solve.solve(0.01 * kLevel, 1, 30).ok());
      EXPECT_LT(worst_error(get(solve, mask), u), 0.02 * kLevel) << screening;
    }
}

} // namespace
} // namespace oversketch
