#include "core/clone/quadtree.h"

#include "core/base/check.h"
#include "core/clone/membrane_matrix.h"
#include "core/clone/pixel_graph.h"
#include "tests/unit/clone/clone_support.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

using Place = std::pair<int, int>;

std::vector<Mask> all_shapes() {
  std::vector<Mask> out = shapes();
  for (Mask& mask : large_shapes())
    out.push_back(std::move(mask));
  return out;
}

/// The leaf that holds each pixel.
std::map<Place, int> leaf_of_pixels(const Quadtree& tree) {
  std::map<Place, int> out;
  for (int i = 0; i < static_cast<int>(tree.leaves.size()); ++i) {
    const auto [x, y, size] = tree.leaf(i);
    for (int v = y; v < y + size; ++v)
      for (int u = x; u < x + size; ++u)
        EXPECT_TRUE(out.insert({{u, v}, i}).second) << "held twice: " << u << "," << v;
  }
  return out;
}

TEST(Quadtree, RefusesWhatIsABug) {
  EXPECT_THROW(Quadtree(Mask(), 2), BugError);
  EXPECT_THROW(Quadtree(rect_mask({0, 0, 9, 9}), 0), BugError);
}

TEST(Quadtree, LeavesHoldEachPixelOnceAndGrowWithTheDistanceFromTheEdge) {
  for (const Mask& mask : all_shapes())
    for (const int k : {1, 2, 4}) {
      const Quadtree tree(mask, k);
      const std::map<Place, int> held = leaf_of_pixels(tree);
      ASSERT_EQ(static_cast<std::int64_t>(held.size()), mask.count());
      for (const auto& [place, leaf] : held)
        ASSERT_TRUE(mask.contains(place.first, place.second));
      for (const auto& [x, y, size] : tree.leaves) {
        if (size == 1) continue;
        const int margin = k * size + 1;
        for (int v = y - margin; v < y + size + margin; ++v)
          for (int u = x - margin; u < x + size + margin; ++u)
            ASSERT_TRUE(mask.contains(u, v));
      }
      // Neighbours, by a corner too, are at most twice as large.
      for (const auto& [place, leaf] : held)
        for (const Place& step : {Place{1, 0}, Place{0, 1}, Place{1, 1}, Place{-1, 1}}) {
          const auto next = held.find({place.first + step.first, place.second + step.second});
          if (next == held.end()) continue;
          const int a = tree.leaf(leaf).size, b = tree.leaf(next->second).size;
          ASSERT_LE(std::max(a, b), 2 * std::min(a, b));
        }
      for (std::size_t run = 0; run < mask.runs().size(); ++run)
        ASSERT_EQ(tree.first_leaf[run], (held.at({mask.runs()[run].x0, mask.runs()[run].y})));
    }
}

TEST(Quadtree, LeavesAreFewWhereTheyMayBe) {
  // Several for each pixel of the edge, whatever the area.
  for (const int radius : {50, 100, 200}) {
    const Mask disc = disc_mask(0, 0, radius);
    const double ring = static_cast<double>(PixelGraph(disc).ring.size());
    EXPECT_LT(static_cast<double>(Quadtree(disc, 1).leaves.size()), 6 * ring);
    EXPECT_LT(static_cast<double>(Quadtree(disc, 2).leaves.size()), 9 * ring);
  }
}

/// Pixel values of the function with the given unknowns, straight from the definition.
std::map<Place, double> expand(const Quadtree& tree, const std::vector<double>& unknowns) {
  std::vector<double> at(static_cast<std::size_t>(tree.points));
  for (std::size_t point = 0; point < at.size(); ++point)
    if (tree.unknown[point] >= 0) at[point] = unknowns[static_cast<std::size_t>(tree.unknown[point])];
  for (const Quadtree::Hanging& h : tree.hanging) {
    EXPECT_GE(tree.unknown[static_cast<std::size_t>(h.ends[0])], 0);
    EXPECT_GE(tree.unknown[static_cast<std::size_t>(h.ends[1])], 0);
    at[static_cast<std::size_t>(h.point)] =
        0.5 * (at[static_cast<std::size_t>(h.ends[0])] + at[static_cast<std::size_t>(h.ends[1])]);
  }
  std::map<Place, double> values;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const auto [x, y, size] = tree.leaves[i];
    const auto corner = [&](std::size_t c) { return at[static_cast<std::size_t>(tree.corners[i][c])]; };
    for (int v = 0; v < size; ++v)
      for (int u = 0; u < size; ++u) {
        const double s = static_cast<double>(u) / size, t = static_cast<double>(v) / size;
        values[{x + u, y + v}] = size == 1 ? at[i]
                                           : (1 - s) * (1 - t) * at[i] + s * (1 - t) * corner(0) +
                                                 (1 - s) * t * corner(1) + s * t * corner(2);
      }
  }
  return values;
}

TEST(Quadtree, FunctionsAreContinuousAndTheMatrixIsTheirEnergyOnThePixels) {
  std::mt19937 random(6);
  std::normal_distribution<double> value;
  for (const Mask& mask : all_shapes())
    for (const int k : {1, 2, 4}) {
      const Quadtree tree(mask, k);
      std::vector<double> unknowns(static_cast<std::size_t>(tree.unknowns));
      for (double& u : unknowns)
        u = value(random);
      const std::map<Place, double> u = expand(tree, unknowns);
      // The corners that another leaf holds.
      std::vector<double> at(static_cast<std::size_t>(tree.points));
      std::vector<int> ring;
      double energy = 0;
      for (const auto& [place, here] : u)
        for (const Place& step : {Place{1, 0}, Place{0, 1}, Place{-1, 0}, Place{0, -1}}) {
          const auto next = u.find({place.first + step.first, place.second + step.second});
          if (next == u.end()) {
            energy += here * here;
            ring.push_back(tree.find(place.first, place.second));
          } else if (step.first + step.second > 0) {
            energy += (here - next->second) * (here - next->second);
          }
        }
      const Eigen::SparseMatrix<double> a = membrane_matrix(tree, ring);
      const Eigen::Map<const Eigen::VectorXd> x(unknowns.data(), tree.unknowns);
      const double form = x.dot(a.selfadjointView<Eigen::Lower>() * x);
      EXPECT_NEAR(form, energy, 1e-10 * energy);
    }
}

} // namespace
} // namespace oversketch
