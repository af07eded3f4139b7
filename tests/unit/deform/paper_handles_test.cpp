#include "core/deform/paper_handles.h"

#include "tests/unit/deform/paper_grid.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace oversketch {
namespace {

using paper_test::GridMesh;
using paper_test::make_bitten_grid;
using paper_test::make_grid;
using Complex = std::complex<double>;

HandleSystem make_system(const GridMesh& grid, double weight = 1) {
  auto made = HandleSystem::make(grid.mesh, grid.loop, weight, {});
  EXPECT_TRUE(made);
  return *std::move(made);
}

ComplexVector loop_targets(const GridMesh& grid, auto&& map) {
  ComplexVector h(static_cast<Eigen::Index>(grid.loop.size()));
  for (std::size_t i = 0; i < grid.loop.size(); ++i)
    h[i] = map(to_complex(grid.mesh.vertices[grid.loop[i]]), i);
  return h;
}

ComplexVector random_targets(const GridMesh& grid, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-8, 8);
  return loop_targets(
      grid, [&](Complex z, std::size_t) { return z * Complex(1.2, 0.5) + Complex(jitter(random), jitter(random)); });
}

/// The paper's equations in real numbers, unknowns x_0, y_0, x_1, y_1, …: [A_d; ω A_h] and its right-hand side.
struct RealSystem {
  Eigen::MatrixXd energy;
  Eigen::MatrixXd all;
  Eigen::VectorXd right;

  RealSystem(const GridMesh& grid, double weight, const ComplexVector& h) {
    const int n = static_cast<int>(grid.mesh.vertices.size()), c = static_cast<int>(grid.loop.size());
    energy = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    for (int i = 0; i < n; ++i)
      add_vertex(grid.mesh, i);
    all = Eigen::MatrixXd::Zero(2 * n + 2 * c, 2 * n);
    all.topRows(2 * n) = energy;
    right = Eigen::VectorXd::Zero(2 * n + 2 * c);
    for (int i = 0; i < c; ++i) {
      for (int axis = 0; axis < 2; ++axis) {
        all(2 * n + 2 * i + axis, 2 * grid.loop[i] + axis) = weight;
        right(2 * n + 2 * i + axis) = weight * (axis == 0 ? h[i].real() : h[i].imag());
      }
    }
  }

  void add_vertex(const QuadMesh& mesh, int i) {
    std::set<int> neighbours;
    for (const auto& cell : mesh.cells) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (cell[k] == i) neighbours.insert({cell[(k + 1) % 4], cell[(k + 3) % 4]});
      }
    }
    std::vector<int> patch{i};
    patch.insert(patch.end(), neighbours.begin(), neighbours.end());
    const int m = static_cast<int>(patch.size());
    Point mean;
    for (const int k : patch)
      mean += mesh.vertices[k] / m;
    Point delta = mesh.vertices[i];
    for (const int k : neighbours)
      delta -= mesh.vertices[k] / static_cast<double>(m - 1);

    // The similarity [a −b; b a] of the centred patch: least squares in (a, b) for deformed points, themselves centred.
    Eigen::MatrixXd source(2 * m, 2);
    Eigen::MatrixXd centring = Eigen::MatrixXd::Zero(2 * m, 2 * m);
    for (int k = 0; k < m; ++k) {
      const Point d = mesh.vertices[patch[k]] - mean;
      source.row(2 * k) << d.x, -d.y;
      source.row(2 * k + 1) << d.y, d.x;
      for (int l = 0; l < m; ++l) {
        for (int axis = 0; axis < 2; ++axis)
          centring(2 * k + axis, 2 * l + axis) = (k == l ? 1.0 : 0.0) - 1.0 / m;
      }
    }
    const Eigen::MatrixXd fit = source.completeOrthogonalDecomposition().pseudoInverse() * centring;
    Eigen::Matrix2d turn;
    turn << delta.x, -delta.y, delta.y, delta.x;
    const Eigen::MatrixXd rotated = turn * fit;
    for (int k = 0; k < m; ++k) {
      for (int axis = 0; axis < 2; ++axis) {
        for (int from = 0; from < 2; ++from)
          energy(2 * i + axis, 2 * patch[k] + from) += rotated(axis, 2 * k + from);
        energy(2 * i + axis, 2 * patch[k] + axis) -= k == 0 ? 1.0 : -1.0 / (m - 1);
      }
    }
  }
};

TEST(HandleSystem, RefusesBadInput) {
  const GridMesh grid = make_bitten_grid();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double weight : {0.0, -1.0, 0.0099, 100.1, nan, std::numeric_limits<double>::infinity()}) {
    const auto made = HandleSystem::make(grid.mesh, grid.loop, weight, {});
    ASSERT_FALSE(made) << weight;
    EXPECT_EQ(made.error().code, "deform.handle-weight");
    const auto changed = make_system(grid).with_handle_weight(weight, {});
    ASSERT_FALSE(changed) << weight;
    EXPECT_EQ(changed.error().code, "deform.handle-weight");
  }
  const std::vector<int> none, one{3, 3}, outside{0, static_cast<int>(grid.mesh.vertices.size())};
  EXPECT_THROW((void)HandleSystem::make(grid.mesh, none, 1, {}), BugError);
  EXPECT_THROW((void)HandleSystem::make(grid.mesh, one, 1, {}), BugError);
  EXPECT_THROW((void)HandleSystem::make(grid.mesh, outside, 1, {}), BugError);
  QuadMesh loose = grid.mesh;
  loose.vertices.push_back({1000, 1000});
  EXPECT_THROW((void)HandleSystem::make(loose, grid.loop, 1, {}), BugError);
  EXPECT_THROW((void)make_system(grid).place(ComplexVector::Zero(3)), BugError);
}

TEST(HandleSystem, StopsWhenAsked) {
  const GridMesh grid = make_bitten_grid();
  std::stop_source stop;
  stop.request_stop();
  const auto made = HandleSystem::make(grid.mesh, grid.loop, 1, {stop.get_token(), {}, nullptr});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error(), cancelled());
}

TEST(HandleSystem, AgreesWithTheRealEquations) {
  for (const double weight : {0.1, 1.0, 7.0}) {
    const GridMesh grid = make_bitten_grid(10, {300, -70});
    const ComplexVector h = random_targets(grid, 1);
    const RealSystem real(grid, weight, h);
    const Eigen::VectorXd expected = real.all.householderQr().solve(real.right);
    const HandleSystem::Evaluation found = make_system(grid, weight).evaluate(h);
    const double size = expected.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < found.positions.size(); ++i) {
      EXPECT_NEAR(found.positions[i].real(), expected[2 * i], 1e-9 * size);
      EXPECT_NEAR(found.positions[i].imag(), expected[2 * i + 1], 1e-9 * size);
    }
    const double energy = (real.energy * expected).squaredNorm();
    EXPECT_GT(energy, 0.01);
    EXPECT_NEAR(found.energy, energy, 1e-9 * energy);
  }
}

TEST(HandleSystem, GradientIsTheDerivativeOfTheEnergy) {
  for (const double weight : {0.1, 1.0}) {
    const GridMesh grid = make_bitten_grid();
    const HandleSystem system = make_system(grid, weight);
    const ComplexVector h = random_targets(grid, 2);
    const ComplexVector gradient = system.evaluate(h).gradient;
    const double scale = gradient.cwiseAbs().maxCoeff();
    // E_d(w(h)) is quadratic in h, so that central differences are exact but for rounding.
    for (Eigen::Index i = 0; i < h.size(); ++i) {
      const auto slope = [&](Complex along) {
        ComplexVector more = h, less = h;
        more[i] += along;
        less[i] -= along;
        return (system.evaluate(more).energy - system.evaluate(less).energy) / 2;
      };
      EXPECT_NEAR(gradient[i].real(), slope({1, 0}), 1e-9 * scale);
      EXPECT_NEAR(gradient[i].imag(), slope({0, 1}), 1e-9 * scale);
    }
  }
}

TEST(HandleSystem, VertexPassedTwiceCarriesTwoHandles) {
  GridMesh grid = make_bitten_grid();
  grid.loop.push_back(grid.loop[4]);
  const ComplexVector h = random_targets(grid, 3);
  const RealSystem real(grid, 1, h);
  const Eigen::VectorXd expected = real.all.householderQr().solve(real.right);
  const HandleSystem::Evaluation found = make_system(grid).evaluate(h);
  for (Eigen::Index i = 0; i < found.positions.size(); ++i) {
    EXPECT_NEAR(std::abs(found.positions[i] - Complex(expected[2 * i], expected[2 * i + 1])), 0, 1e-8);
  }
  EXPECT_EQ(found.gradient[4], found.gradient[h.size() - 1]);
}

TEST(HandleSystem, SimilaritiesCostNothing) {
  const GridMesh grid = make_grid(9, 7, [](int x, int y) { return x != 4 || y > 2; }, 8, {50, 60});
  const Complex factor(-0.7, 1.9), offset(400, -1000);
  const ComplexVector h = loop_targets(grid, [&](Complex z, std::size_t) { return factor * z + offset; });
  for (const double weight : {0.01, 1.0, 100.0}) {
    const HandleSystem::Evaluation found = make_system(grid, weight).evaluate(h);
    for (Eigen::Index i = 0; i < found.positions.size(); ++i) {
      EXPECT_NEAR(std::abs(found.positions[i] - (factor * to_complex(grid.mesh.vertices[i]) + offset)), 0, 1e-8);
    }
    EXPECT_LT(found.energy, 1e-16);
    EXPECT_LT(found.gradient.cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(HandleSystem, FollowsSimilaritiesOfItsTargets) {
  const GridMesh grid = make_bitten_grid();
  const HandleSystem system = make_system(grid, 0.5);
  const ComplexVector h = random_targets(grid, 4);
  const Complex factor(0.3, -2), offset(-5000, 700);
  const HandleSystem::Evaluation one = system.evaluate(h), other = system.evaluate((factor * h).array() + offset);
  EXPECT_LT((other.positions - ((factor * one.positions).array() + offset).matrix()).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((other.gradient - factor * one.gradient).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(other.energy, std::norm(factor) * one.energy, 1e-9 * other.energy);
}

TEST(HandleSystem, DependsNeitherOnTheSourcesOriginNorItsScale) {
  const GridMesh grid = make_bitten_grid();
  const ComplexVector h = random_targets(grid, 5);
  const HandleSystem::Evaluation here = make_system(grid).evaluate(h);
  for (const GridMesh& moved : {make_bitten_grid(10, {90'000, -70'000}), make_bitten_grid(0.5)}) {
    const HandleSystem::Evaluation there = make_system(moved).evaluate(h);
    EXPECT_NEAR(there.energy, here.energy, 1e-9 * here.energy);
    EXPECT_LT((there.positions - here.positions).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(HandleSystem, AnotherWeightRedoesTheNumericFactorizationAlone) {
  const GridMesh grid = make_bitten_grid();
  const ComplexVector h = random_targets(grid, 6);
  StageTimes times;
  const auto changed = make_system(grid, 1).with_handle_weight(0.3, {{}, {}, &times});
  ASSERT_TRUE(changed);
  ASSERT_EQ(times.stages_ms.size(), 1u);
  EXPECT_EQ(times.stages_ms[0].first, "factor");
  const HandleSystem::Evaluation expected = make_system(grid, 0.3).evaluate(h);
  EXPECT_EQ(changed->evaluate(h).positions, expected.positions);
  EXPECT_EQ(changed->evaluate(h).gradient, expected.gradient);
  EXPECT_DOUBLE_EQ(changed->handle_weight(), 0.3);
}

TEST(CholeskyFactor, AgreesWithADenseSolve) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  for (const int size : {1, 2, 17, 60}) {
    Eigen::MatrixXcd half = Eigen::MatrixXcd::Zero(size, size);
    for (int i = 0; i < size; ++i) {
      half(i, i) = 2;
      for (int k = 0; k < 3; ++k) {
        half(i, static_cast<Eigen::Index>(random() % static_cast<unsigned>(size))) +=
            Complex(value(random), value(random));
      }
    }
    const Eigen::MatrixXcd dense = half.adjoint() * half + 0.1 * Eigen::MatrixXcd::Identity(size, size);
    ComplexMatrix matrix = dense.sparseView();
    matrix.makeCompressed();
    const auto factor = CholeskyFactor::make(matrix, analyse(matrix), {});
    ASSERT_TRUE(factor);
    const Eigen::VectorXcd right = Eigen::VectorXcd::Random(size), expected = dense.ldlt().solve(right);
    std::vector<Complex> x(size);
    for (int i = 0; i < size; ++i)
      x[factor->pattern().place[i]] = right[i];
    factor->solve_permuted(x);
    for (int i = 0; i < size; ++i)
      EXPECT_NEAR(std::abs(x[factor->pattern().place[i]] - expected[i]), 0, 1e-10);
  }
}

} // namespace
} // namespace oversketch
