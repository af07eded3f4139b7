#include "core/deform/paper_handles.h"

#include "tests/unit/deform/dense_solve.h"
#include "tests/unit/deform/paper_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace oversketch {
namespace {

using namespace dense;
using paper_test::GridMesh;
using paper_test::make_bitten_grid;
using paper_test::make_grid;
using Complex = std::complex<double>;

/// What holds of either form.
class HandleSystemForms : public ::testing::TestWithParam<HandleForm> {
protected:
  static HandleSystem make_system(const GridMesh& grid, double weight = 1) {
    auto made = HandleSystem::make(grid.mesh, grid.loop, weight, {}, GetParam());
    EXPECT_TRUE(made);
    EXPECT_EQ(made->form(), GetParam());
    return *std::move(made);
  }
};

INSTANTIATE_TEST_SUITE_P(HandleSystem, HandleSystemForms, ::testing::Values(HandleForm::kReduced, HandleForm::kSparse),
                         [](const auto& form) { return form.param == HandleForm::kReduced ? "Reduced" : "Sparse"; });

/// All that a system says of its targets.
struct Evaluation {
  ComplexVector positions;
  double energy = 0;
  ComplexVector gradient;
};

Evaluation evaluate(const HandleSystem& system, const ComplexVector& h) {
  const HandleSystem::Slope slope = system.slope(h);
  return {system.place(h), slope.energy, slope.gradient};
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
  Dense<Real> energy;
  Dense<Real> all;
  Dense<Real> right;

  RealSystem(const GridMesh& grid, double weight, const ComplexVector& h) {
    const std::size_t n = grid.mesh.vertices.size(), c = grid.loop.size();
    energy = make_zeros<Real>(2 * n, 2 * n);
    for (std::size_t i = 0; i < n; ++i)
      add_vertex(grid.mesh, static_cast<int>(i));
    all = energy;
    all.resize(2 * n + 2 * c, std::vector<Real>(2 * n));
    right = make_zeros<Real>(2 * n + 2 * c, 1);
    for (std::size_t i = 0; i < c; ++i) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        all[2 * n + 2 * i + axis][2 * static_cast<std::size_t>(grid.loop[i]) + axis] = weight;
        right[2 * n + 2 * i + axis][0] = weight * (axis == 0 ? h[i].real() : h[i].imag());
      }
    }
  }

  std::vector<Complex> positions() const {
    const Dense<Real> x = solve_least_squares(all, right);
    std::vector<Complex> found(x.size() / 2);
    for (std::size_t i = 0; i < found.size(); ++i)
      found[i] = {static_cast<double>(x[2 * i][0]), static_cast<double>(x[2 * i + 1][0])};
    return found;
  }

  double energy_of(const std::vector<Complex>& positions) const {
    Real sum = 0;
    for (const std::vector<Real>& row : energy) {
      Real residual = 0;
      for (std::size_t i = 0; i < positions.size(); ++i)
        residual += row[2 * i] * positions[i].real() + row[2 * i + 1] * positions[i].imag();
      sum += residual * residual;
    }
    return static_cast<double>(sum);
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
    const std::size_t m = patch.size();
    Point mean;
    for (const int k : patch)
      mean += mesh.vertices[k] / static_cast<double>(m);
    Point delta = mesh.vertices[i];
    for (const int k : neighbours)
      delta -= mesh.vertices[k] / static_cast<double>(m - 1);

    // The similarity [a −b; b a] of the centred patch: least squares in (a, b) for deformed points, themselves centred.
    Dense<Real> source = make_zeros<Real>(2 * m, 2), centring = make_zeros<Real>(2 * m, 2 * m);
    for (std::size_t k = 0; k < m; ++k) {
      const Point d = mesh.vertices[patch[k]] - mean;
      source[2 * k] = {d.x, -d.y};
      source[2 * k + 1] = {d.y, d.x};
      for (std::size_t l = 0; l < m; ++l) {
        for (std::size_t axis = 0; axis < 2; ++axis)
          centring[2 * k + axis][2 * l + axis] = (k == l ? Real(1) : Real(0)) - Real(1) / static_cast<Real>(m);
      }
    }
    const Dense<Real> fit = solve_least_squares(source, centring);
    const Dense<Real> turn{{delta.x, -delta.y}, {delta.y, delta.x}};
    for (std::size_t k = 0; k < m; ++k) {
      const std::size_t column = 2 * static_cast<std::size_t>(patch[k]);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        std::vector<Real>& row = energy[2 * static_cast<std::size_t>(i) + axis];
        for (std::size_t from = 0; from < 2; ++from)
          row[column + from] += turn[axis][0] * fit[0][2 * k + from] + turn[axis][1] * fit[1][2 * k + from];
        row[column + axis] -= k == 0 ? Real(1) : Real(-1) / static_cast<Real>(m - 1);
      }
    }
  }
};

TEST_P(HandleSystemForms, RefusesBadInput) {
  const GridMesh grid = make_bitten_grid();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double weight : {0.0, -1.0, 0.0099, 100.1, nan, std::numeric_limits<double>::infinity()}) {
    const auto made = HandleSystem::make(grid.mesh, grid.loop, weight, {}, GetParam());
    ASSERT_FALSE(made) << weight;
    EXPECT_EQ(made.error().code, "deform.handle-weight");
    const auto changed = make_system(grid).with_handle_weight(weight, {});
    ASSERT_FALSE(changed) << weight;
    EXPECT_EQ(changed.error().code, "deform.handle-weight");
  }
  const std::vector<int> none, one{3, 3}, outside{0, static_cast<int>(grid.mesh.vertices.size())};
  EXPECT_THROW((void)HandleSystem::make(grid.mesh, none, 1, {}, GetParam()), BugError);
  EXPECT_THROW((void)HandleSystem::make(grid.mesh, one, 1, {}, GetParam()), BugError);
  EXPECT_THROW((void)HandleSystem::make(grid.mesh, outside, 1, {}, GetParam()), BugError);
  QuadMesh loose = grid.mesh;
  loose.vertices.push_back({1000, 1000});
  EXPECT_THROW((void)HandleSystem::make(loose, grid.loop, 1, {}, GetParam()), BugError);
  EXPECT_THROW((void)make_system(grid).place(ComplexVector::Zero(3)), BugError);
  EXPECT_THROW((void)make_system(grid).slope(ComplexVector::Zero(3)), BugError);
}

TEST_P(HandleSystemForms, StopsWhenAsked) {
  const GridMesh grid = make_bitten_grid();
  std::stop_source stop;
  stop.request_stop();
  const auto made = HandleSystem::make(grid.mesh, grid.loop, 1, {stop.get_token(), {}, nullptr}, GetParam());
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error(), cancelled());
}

TEST_P(HandleSystemForms, AgreesWithTheRealEquations) {
  for (const double weight : {0.1, 1.0, 7.0}) {
    const GridMesh grid = make_bitten_grid(10, {300, -70});
    const ComplexVector h = random_targets(grid, 1);
    const RealSystem real(grid, weight, h);
    const std::vector<Complex> expected = real.positions();
    const Evaluation found = evaluate(make_system(grid, weight), h);
    double size = 0;
    for (const Complex& z : expected)
      size = std::max({size, std::abs(z.real()), std::abs(z.imag())});
    ASSERT_EQ(expected.size(), static_cast<std::size_t>(found.positions.size()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(found.positions[i].real(), expected[i].real(), 1e-9 * size);
      EXPECT_NEAR(found.positions[i].imag(), expected[i].imag(), 1e-9 * size);
    }
    const double energy = real.energy_of(expected);
    EXPECT_GT(energy, 0.01);
    EXPECT_NEAR(found.energy, energy, 1e-9 * energy);
  }
}

TEST_P(HandleSystemForms, GradientIsTheDerivativeOfTheEnergy) {
  for (const double weight : {0.1, 1.0}) {
    const GridMesh grid = make_bitten_grid();
    const HandleSystem system = make_system(grid, weight);
    const ComplexVector h = random_targets(grid, 2);
    const ComplexVector gradient = evaluate(system, h).gradient;
    const double scale = gradient.cwiseAbs().maxCoeff();
    // E_d(w(h)) is quadratic in h, so that central differences are exact but for rounding.
    for (Eigen::Index i = 0; i < h.size(); ++i) {
      const auto slope = [&](Complex along) {
        ComplexVector more = h, less = h;
        more[i] += along;
        less[i] -= along;
        return (evaluate(system, more).energy - evaluate(system, less).energy) / 2;
      };
      EXPECT_NEAR(gradient[i].real(), slope({1, 0}), 1e-9 * scale);
      EXPECT_NEAR(gradient[i].imag(), slope({0, 1}), 1e-9 * scale);
    }
  }
}

TEST_P(HandleSystemForms, VertexPassedTwiceCarriesTwoHandles) {
  GridMesh grid = make_bitten_grid();
  grid.loop.push_back(grid.loop[4]);
  const ComplexVector h = random_targets(grid, 3);
  const RealSystem real(grid, 1, h);
  const std::vector<Complex> expected = real.positions();
  const Evaluation found = evaluate(make_system(grid), h);
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(found.positions.size()));
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(std::abs(found.positions[i] - expected[i]), 0, 1e-8);
  EXPECT_EQ(found.gradient[4], found.gradient[h.size() - 1]);
}

TEST_P(HandleSystemForms, SimilaritiesCostNothing) {
  const GridMesh grid = make_grid(9, 7, [](int x, int y) { return x != 4 || y > 2; }, 8, {50, 60});
  const Complex factor(-0.7, 1.9), offset(400, -1000);
  const ComplexVector h = loop_targets(grid, [&](Complex z, std::size_t) { return factor * z + offset; });
  for (const double weight : {0.01, 1.0, 100.0}) {
    const Evaluation found = evaluate(make_system(grid, weight), h);
    for (Eigen::Index i = 0; i < found.positions.size(); ++i) {
      EXPECT_NEAR(std::abs(found.positions[i] - (factor * to_complex(grid.mesh.vertices[i]) + offset)), 0, 1e-8);
    }
    EXPECT_LT(found.energy, 1e-16);
    EXPECT_LT(found.gradient.cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(HandleSystemForms, FollowsSimilaritiesOfItsTargets) {
  const GridMesh grid = make_bitten_grid();
  const HandleSystem system = make_system(grid, 0.5);
  const ComplexVector h = random_targets(grid, 4);
  const Complex factor(0.3, -2), offset(-5000, 700);
  const Evaluation one = evaluate(system, h), other = evaluate(system, (factor * h).array() + offset);
  EXPECT_LT((other.positions - ((factor * one.positions).array() + offset).matrix()).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((other.gradient - factor * one.gradient).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(other.energy, std::norm(factor) * one.energy, 1e-9 * other.energy);
}

TEST_P(HandleSystemForms, DependsNeitherOnTheSourcesOriginNorItsScale) {
  const GridMesh grid = make_bitten_grid();
  const ComplexVector h = random_targets(grid, 5);
  const Evaluation here = evaluate(make_system(grid), h);
  for (const GridMesh& moved : {make_bitten_grid(10, {90'000, -70'000}), make_bitten_grid(0.5)}) {
    const Evaluation there = evaluate(make_system(moved), h);
    EXPECT_NEAR(there.energy, here.energy, 1e-9 * here.energy);
    EXPECT_LT((there.positions - here.positions).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(HandleSystemForms, AnotherWeightRedoesTheNumericFactorizationAlone) {
  const GridMesh grid = make_bitten_grid();
  const ComplexVector h = random_targets(grid, 6);
  StageTimes times;
  const auto changed = make_system(grid, 1).with_handle_weight(0.3, {{}, {}, &times});
  ASSERT_TRUE(changed);
  ASSERT_EQ(times.stages_ms.size(), 1u);
  EXPECT_EQ(times.stages_ms[0].first, "factor");
  const Evaluation expected = evaluate(make_system(grid, 0.3), h);
  EXPECT_EQ(evaluate(*changed, h).positions, expected.positions);
  EXPECT_EQ(evaluate(*changed, h).gradient, expected.gradient);
  EXPECT_DOUBLE_EQ(changed->handle_weight(), 0.3);
}

TEST(CholeskyFactor, AgreesWithADenseSolve) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  const auto any = [&] { return LongComplex(value(random), value(random)); };
  for (const std::size_t size : {1U, 2U, 17U, 60U}) {
    Dense<LongComplex> half = make_zeros<LongComplex>(size, size), right = make_zeros<LongComplex>(size, 1);
    for (std::size_t i = 0; i < size; ++i) {
      half[i][i] = 2;
      for (int k = 0; k < 3; ++k)
        half[i][random() % size] += any();
      right[i][0] = any();
    }
    Dense<LongComplex> dense = multiply_adjoint(half, half);
    std::vector<Eigen::Triplet<Complex>> entries;
    for (std::size_t i = 0; i < size; ++i) {
      dense[i][i] += Real(0.1);
      for (std::size_t j = 0; j < size; ++j)
        if (dense[i][j] != LongComplex(0)) entries.emplace_back(i, j, Complex(dense[i][j]));
    }
    const auto length = static_cast<Eigen::Index>(size);
    ComplexMatrix matrix(length, length);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const auto factor = CholeskyFactor::make(matrix, analyse(matrix), {});
    ASSERT_TRUE(factor);
    const Dense<LongComplex> expected = solve(dense, right);
    std::vector<Complex> x(size);
    for (std::size_t i = 0; i < size; ++i)
      x[factor->pattern().place[i]] = Complex(right[i][0]);
    factor->solve_permuted(x);
    for (std::size_t i = 0; i < size; ++i)
      EXPECT_NEAR(std::abs(x[factor->pattern().place[i]] - Complex(expected[i][0])), 0, 1e-10);
  }
}

} // namespace
} // namespace oversketch
