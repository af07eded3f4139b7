#include "core/deform/block_cholesky.h"
#include "core/deform/flipfree_align.h"
#include "core/deform/flipfree_energy.h"
#include "core/deform/flipfree_handles.h"
#include "core/deform/flipfree_warm.h"
#include "core/deform/linear_start.h"
#include "core/mesh/region_mesh.h"
#include "tests/support/random_bends.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace oversketch {
namespace {

using Random = std::mt19937;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

QuadMesh small_mesh() {
  const auto mesh = make_region_mesh(ClosedCurve(testing::fish_shape()), 45, MeshKind::kCovering);
  EXPECT_TRUE(mesh.ok());
  return mesh->mesh();
}

/// The mesh in cells, every vertex shaken.
Points shaken(const QuadMesh& mesh, Random& random, double by) {
  Points x;
  for (const Point p : mesh.vertices)
    x.push_back(p / mesh.cell + Point{uniform(random, -by, by), uniform(random, -by, by)});
  return x;
}

/// The matrix that a factorization stands for, by solving for every unit vector.
Eigen::MatrixXd invert(const BlockCholesky& factor, int vertices) {
  Eigen::MatrixXd inverse(2 * vertices, 2 * vertices);
  for (int j = 0; j < 2 * vertices; ++j) {
    Points x(vertices);
    (j % 2 == 0 ? x[j / 2].x : x[j / 2].y) = 1;
    factor.solve(x);
    for (int i = 0; i < vertices; ++i) {
      inverse(2 * i, j) = x[i].x;
      inverse(2 * i + 1, j) = x[i].y;
    }
  }
  return inverse;
}

TEST(BlockCholesky, SolvesWhatADenseFactorizationSolves) {
  Random random(3);
  const int n = 30;
  std::vector<std::pair<int, int>> coupled;
  for (int k = 0; k < 70; ++k)
    coupled.emplace_back(static_cast<int>(random() % n), static_cast<int>(random() % n));
  const auto pattern = std::make_shared<const BlockPattern>(n, coupled);
  BlockCholesky sparse(pattern);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (const auto& [i, j] : coupled) {
    if (i == j) continue;
    const std::array<double, 4> b{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1),
                                  uniform(random, -1, 1)};
    sparse.add(find_block(*pattern, i, j), b);
    Eigen::Matrix2d block;
    block << b[0], b[1], b[2], b[3];
    dense.block<2, 2>(2 * i, 2 * j) += block;
    dense.block<2, 2>(2 * j, 2 * i) += block.transpose();
  }
  EXPECT_FALSE(sparse.factor());
  sparse.add_to_diagonal(25);
  dense += 25 * Eigen::MatrixXd::Identity(2 * n, 2 * n);
  ASSERT_TRUE(sparse.factor());
  EXPECT_LT((invert(sparse, n) - dense.inverse()).cwiseAbs().maxCoeff(), 1e-13);
  sparse.clear();
  EXPECT_FALSE(sparse.factor());
  EXPECT_THROW((void)find_block(BlockPattern(3, {{0, 1}}), 0, 2), BugError);
}

TEST(DistortionEnergy, IsLeastAtRotations) {
  const QuadMesh mesh = small_mesh();
  const DistortionEnergy energy(mesh);
  Random random(1);
  for (const double stiffness : {0.05, 0.5, 2.0}) {
    const Points turned_mesh = transformed(mesh.vertices, {std::polar(1 / mesh.cell, 1.1), {40, -7}});
    const double least = (2 + 2 * stiffness) * energy.total_weight();
    EXPECT_NEAR(energy.value(turned_mesh, {stiffness, 0}), least, 1e-9 * least);
    for (int k = 0; k < 10; ++k)
      EXPECT_GT(energy.value(shaken(mesh, random, 0.1), {stiffness, 0}), least);
    const Points larger = transformed(mesh.vertices, {1.1 / mesh.cell, {}});
    EXPECT_GT(energy.value(larger, {stiffness, 0}), least);
  }
}

TEST(DistortionEnergy, IsInfiniteWhereACellIsFlippedUnlessUntangling) {
  const QuadMesh mesh = small_mesh();
  const DistortionEnergy energy(mesh);
  const Points mirrored = [&] {
    Points x;
    for (const Point p : mesh.vertices)
      x.push_back({-p.x / mesh.cell, p.y / mesh.cell});
    return x;
  }();
  EXPECT_EQ(energy.value(mirrored, {0.5, 0}), HUGE_VAL);
  EXPECT_TRUE(std::isfinite(energy.value(mirrored, {0.5, 0.1})));
  EXPECT_EQ(energy.count_flipped(mirrored), static_cast<int>(mesh.cells.size()));
  EXPECT_NEAR(energy.least_determinant(mirrored), -1, 1e-9);
}

TEST(DistortionEnergy, GradientIsTheSlope) {
  const QuadMesh mesh = small_mesh();
  const DistortionEnergy energy(mesh);
  Random random(2);
  for (const double epsilon : {0.0, 0.3}) {
    const DistortionEnergy::Weights weights{0.4, epsilon};
    // With ε some cells may well be flipped.
    const Points x = shaken(mesh, random, epsilon > 0 ? 0.6 : 0.2);
    Points gradient(x.size());
    BlockCholesky hessian(energy.pattern());
    energy.add_derivatives(x, weights, gradient, hessian);
    for (std::size_t i = 0; i < x.size(); ++i) {
      constexpr double kStep = 1e-6;
      Points more = x, less = x;
      more[i].x += kStep;
      less[i].x -= kStep;
      const double slope = (energy.value(more, weights) - energy.value(less, weights)) / (2 * kStep);
      EXPECT_NEAR(gradient[i].x, slope, 1e-5 * (1 + std::abs(slope)));
      more[i] = less[i] = x[i];
      more[i].y += kStep;
      less[i].y -= kStep;
      const double other = (energy.value(more, weights) - energy.value(less, weights)) / (2 * kStep);
      EXPECT_NEAR(gradient[i].y, other, 1e-5 * (1 + std::abs(other)));
    }
  }
}

TEST(DistortionEnergy, HessianIsTheSlopeOfTheGradientWhereItIsConvex) {
  const QuadMesh mesh = small_mesh();
  const DistortionEnergy energy(mesh);
  const int n = static_cast<int>(mesh.vertices.size());
  const DistortionEnergy::Weights weights{0.7, 0};
  // Near a rotation nothing needs projecting; far from it what is projected must stay positive definite.
  const Points x = transformed(mesh.vertices, {std::polar(1 / mesh.cell, 0.3), {}});
  const auto hessian_at = [&](const Points& at, double diagonal) {
    BlockCholesky hessian(energy.pattern());
    Points gradient(at.size());
    energy.add_derivatives(at, weights, gradient, hessian);
    hessian.add_to_diagonal(diagonal);
    EXPECT_TRUE(hessian.factor());
    return Eigen::MatrixXd(invert(hessian, n).inverse());
  };
  const Eigen::MatrixXd hessian = hessian_at(x, 1) - Eigen::MatrixXd::Identity(2 * n, 2 * n);
  constexpr double kStep = 1e-5;
  for (int j = 0; j < 2 * n; j += 7) {
    Points more = x, less = x;
    (j % 2 == 0 ? more[j / 2].x : more[j / 2].y) += kStep;
    (j % 2 == 0 ? less[j / 2].x : less[j / 2].y) -= kStep;
    Points up(x.size()), down(x.size());
    BlockCholesky unused(energy.pattern());
    energy.add_derivatives(more, weights, up, unused);
    energy.add_derivatives(less, weights, down, unused);
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(hessian(2 * i, j), (up[i].x - down[i].x) / (2 * kStep), 2e-4);
      EXPECT_NEAR(hessian(2 * i + 1, j), (up[i].y - down[i].y) / (2 * kStep), 2e-4);
    }
  }
  Random random(6);
  const Eigen::MatrixXd far = hessian_at(shaken(mesh, random, 0.25), 1e-6);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (far + far.transpose())).eigenvalues().minCoeff(), 0);
}

TEST(DistortionEnergy, LongestStepLeavesEveryCornerATwentieth) {
  const QuadMesh mesh = small_mesh();
  const DistortionEnergy energy(mesh);
  Random random(8);
  for (int trial = 0; trial < 30; ++trial) {
    const Points x = shaken(mesh, random, 0.15), to = shaken(mesh, random, 2);
    const double t = energy.longest_step(x, to);
    Points end = x;
    for (std::size_t i = 0; i < x.size(); ++i)
      end[i] += t * to[i];
    EXPECT_GT(t, 0);
    EXPECT_EQ(energy.count_flipped(end), 0);
    // The least part of its D that a corner keeps is 5 %, unless the whole step was allowed.
    double least = HUGE_VAL;
    for (const auto& c : mesh.cells)
      for (int k = 0; k < 4; ++k) {
        const int here = c[k], next = c[(k + 1) % 4], before = c[(k + 3) % 4];
        least = std::min(least, cross(end[next] - end[here], end[before] - end[here]) /
                                    cross(x[next] - x[here], x[before] - x[here]));
      }
    EXPECT_GE(least, 0.05 - 1e-9);
    if (t < 1) {
      EXPECT_NEAR(least, 0.05, 1e-9);
    }
  }
}

std::vector<Handle> handles_with_pins(std::size_t n, const std::vector<std::size_t>& pins) {
  std::vector<Handle> handles(n);
  for (const std::size_t i : pins)
    handles[i].pinned = true;
  return handles;
}

TEST(OrderHandles, LeavesOrderedOnesAlone) {
  Random random(1);
  std::vector<double> s;
  for (int i = 0; i < 20; ++i)
    s.push_back(10 * i + uniform(random, 0, 8));
  auto ordered = s;
  order_handles(ordered, handles_with_pins(20, {}), 200);
  for (std::size_t i = 0; i < s.size(); ++i)
    EXPECT_NEAR(ordered[i], s[i], 1e-12);
}

TEST(OrderHandles, OrdersWithTheLeastChange) {
  Random random(2);
  constexpr double kLength = 100;
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t n = 12;
    std::vector<double> s;
    for (std::size_t i = 0; i < n; ++i)
      s.push_back(kLength * static_cast<double>(i) / n + uniform(random, -14, 14));
    std::vector<std::size_t> pins;
    if (trial % 2 == 0) pins = {2, 7};
    for (const std::size_t i : pins)
      s[i] = kLength * static_cast<double>(i) / n;
    const auto handles = handles_with_pins(n, pins);
    auto ordered = s;
    order_handles(ordered, handles, kLength);
    const double gap = 0.02 * kLength / n;
    const auto is_ordered = [&](const std::vector<double>& v, double least) {
      for (std::size_t i = 0; i < n; ++i)
        if ((i + 1 < n ? v[i + 1] : v[0] + kLength) - v[i] < least) return false;
      return true;
    };
    const auto cost = [&](const std::vector<double>& v) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i)
        sum += (v[i] - s[i]) * (v[i] - s[i]);
      return sum;
    };
    EXPECT_TRUE(is_ordered(ordered, gap * (1 - 1e-9))) << trial;
    for (const std::size_t i : pins)
      EXPECT_EQ(ordered[i], s[i]);
    // No small change that keeps order and pins comes nearer (the problem is convex).
    for (int k = 0; k < 200; ++k) {
      auto other = ordered;
      const std::size_t from = random() % n, count = 1 + random() % (n - 1);
      const double by = uniform(random, -0.05, 0.05);
      for (std::size_t i = 0; i < count; ++i)
        if (!handles[(from + i) % n].pinned) other[(from + i) % n] += by;
      if (is_ordered(other, gap * (1 - 1e-12))) {
        EXPECT_GE(cost(other), cost(ordered) - 1e-9) << trial;
      }
    }
  }
}

TEST(FindRemap, FindsTheRedrawnPart) {
  const Points before = testing::ellipse_shape();
  Points after = before;
  for (std::size_t i = 40; i < 60; ++i)
    after[i] = 1.2 * after[i];
  std::rotate(after.begin(), after.begin() + 50, after.end());
  const ClosedCurve old_curve(before), new_curve(after);
  const auto remap = find_remap(old_curve, new_curve);
  ASSERT_TRUE(remap.has_value());
  for (int i = 0; i < old_curve.size(); ++i) {
    const double s = old_curve.s_at(i), to = (*remap)(s);
    EXPECT_NEAR((*remap)(s + old_curve.length()) - to, new_curve.length(), 1e-9);
    if (i >= 40 && i < 60) {
      EXPECT_TRUE(remap->redrawn(s)) << i;
      continue;
    }
    EXPECT_LT(distance(new_curve.at(to), before[i]), 1e-9) << i;
  }
  double last = (*remap)(-500);
  for (double s = -499; s < 3000; s += 1) {
    EXPECT_GT((*remap)(s), last);
    last = (*remap)(s);
  }
  EXPECT_FALSE(find_remap(old_curve, ClosedCurve(testing::fish_shape())).has_value());
  Points mostly = before;
  for (std::size_t i = 0; i < 125; ++i)
    mostly[i] = 1.1 * mostly[i];
  EXPECT_FALSE(find_remap(old_curve, ClosedCurve(mostly)).has_value());
}

/// A side drawn over again in its middle, of a curve whose only points are its corners.
TEST(FindRemap, KeepsTheEndsOfASideThatWasRedrawnInItsMiddle) {
  const Points before{{0, 0}, {300, 0}, {300, 100}, {0, 100}};
  for (const std::size_t first : {0U, 2U, 4U}) {
    Points after{{0, 0}, {120, 0}, {150, 40}, {170, 0}, {300, 0}, {300, 100}, {0, 100}};
    std::rotate(after.begin(), after.begin() + static_cast<std::ptrdiff_t>(first), after.end());
    const ClosedCurve old_curve(before), new_curve(after);
    const auto remap = find_remap(old_curve, new_curve);
    ASSERT_TRUE(remap.has_value());
    EXPECT_DOUBLE_EQ(remap->common, 800 - 50);
    for (double s = -700; s < 1700; s += 7) {
      const double along = s - std::floor(s / 800) * 800;
      if (along > 120 && along < 170) {
        EXPECT_TRUE(remap->redrawn(s)) << s;
        continue;
      }
      EXPECT_LT(distance(new_curve.at((*remap)(s)), old_curve.at(s)), 1e-9) << s;
    }
    EXPECT_NEAR((*remap)(145) - (*remap)(120), 0.5 * (50 + std::hypot(20, 40)), 1e-9);
  }
}

TEST(AlignSimilar, FindsTheSimilarityAndNothingElse) {
  const ClosedCurve curve(testing::cactus_shape());
  const Points own = transformed(resample(curve, 150), {std::polar(0.3, 2.0), {5, 6}});
  std::vector<double> near;
  for (int i = 0; i < 150; ++i)
    near.push_back(curve.length() * i / 150 + 4 * std::sin(i));
  const auto s = align_similar(own, curve, near, 0.05);
  ASSERT_TRUE(s.has_value());
  for (int i = 0; i < 150; ++i)
    EXPECT_NEAR(s->s[i], curve.length() * i / 150, 1e-9 * curve.length()) << i;
  Points bent = own;
  for (Point& p : bent)
    p.x *= 1.05;
  EXPECT_FALSE(align_similar(bent, curve, near, 0.05).has_value());
}

TEST(LinearStart, IsASimilarityForSimilarHandles) {
  const auto region = make_region_mesh(ClosedCurve(testing::cactus_shape()), 25, MeshKind::kCovering);
  ASSERT_TRUE(region.ok());
  std::vector<MeshTie> ties;
  Points handles;
  const Similarity by{std::polar(1.7, -1.0), {30, 40}};
  for (int i = 0; i < 60; ++i) {
    const double s = region->outline().length() * i / 60;
    const CellPoint at = region->locate_outline(s);
    ties.push_back({at.cell, {(1 - at.u) * (1 - at.v), at.u * (1 - at.v), at.u * at.v, (1 - at.u) * at.v}});
    handles.push_back(by(region->outline().at(s)));
  }
  const auto start = LinearStart::make(region->mesh(), ties, {});
  ASSERT_TRUE(start.ok());
  const Points positions = start->solve(handles), expected = transformed(region->mesh().vertices, by);
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_LT(distance(positions[i], expected[i]), 1e-6);
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(LinearStart::make(region->mesh(), ties, {source.get_token(), {}, nullptr}).ok());
  EXPECT_THROW((void)start->solve({}), BugError);
}

} // namespace
} // namespace oversketch
