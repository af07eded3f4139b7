#include "core/deform/paper_dense.h"
#include "core/deform/paper_elimination.h"
#include "core/deform/paper_handles.h"
#include "core/geometry/curve.h"

#include "tests/unit/deform/paper_grid.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace oversketch {
namespace {

using paper_test::GridMesh;
using paper_test::make_bitten_grid;
using paper_test::make_grid;
using Complex = std::complex<double>;
using Dense = Eigen::MatrixXcd;

/// Positive definite, of no structure, its imaginary parts as large as its real ones.
Dense make_definite(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  Dense half(size, size);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i)
      half(i, j) = Complex(value(random), value(random));
  }
  return half * half.adjoint() + Dense::Identity(size, size);
}

/// The lower triangle alone; what lies above must not matter.
SplitMatrix split(const Dense& matrix) {
  SplitMatrix out(static_cast<int>(matrix.rows()));
  for (int j = 0; j < out.size(); ++j) {
    for (int i = 0; i < out.size(); ++i) {
      out.re(j)[i] = i < j ? 1e30 : matrix(i, j).real();
      out.im(j)[i] = i < j ? -1e30 : matrix(i, j).imag();
    }
  }
  return out;
}

/// The lower triangle, mirrored.
Dense join(const SplitMatrix& matrix) {
  Dense out(matrix.size(), matrix.size());
  for (int j = 0; j < matrix.size(); ++j) {
    for (int i = j; i < matrix.size(); ++i) {
      out(i, j) = Complex(matrix.re(j)[i], matrix.im(j)[i]);
      out(j, i) = std::conj(out(i, j));
    }
  }
  return out;
}

Watch stopped_watch() {
  std::stop_source stop;
  stop.request_stop();
  return {stop.get_token(), {}, nullptr};
}

ComplexVector random_vector(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  ComplexVector out(size);
  for (int i = 0; i < size; ++i)
    out[i] = Complex(value(random), value(random));
  return out;
}

ComplexVector solve(const DenseFactor& factor, const ComplexVector& right) {
  std::vector<double> re(factor.padded()), im(factor.padded());
  for (int i = 0; i < factor.size(); ++i) {
    re[i] = right[i].real();
    im[i] = right[i].imag();
  }
  factor.solve(re, im);
  ComplexVector out(right.size());
  for (int i = 0; i < factor.size(); ++i)
    out[i] = {re[i], im[i]};
  return out;
}

TEST(DenseFactor, RefusesBadInput) {
  const SplitMatrix matrix = split(make_definite(6, 1));
  const std::vector<double> none(6), few(5), less(6, -1e3);
  SplitMatrix copy = matrix;
  EXPECT_THROW((void)factor_columns(copy, 7, Lanes::kTwo, {}), BugError);
  EXPECT_THROW((void)factor_columns(copy, -1, Lanes::kTwo, {}), BugError);
  EXPECT_THROW((void)DenseFactor::make(matrix, few, Lanes::kTwo, {}), BugError);
  EXPECT_THROW((void)DenseFactor::make(matrix, less, Lanes::kTwo, {}), BugError) << "not positive definite";
  const auto cancelled_one = DenseFactor::make(matrix, none, Lanes::kTwo, stopped_watch());
  ASSERT_FALSE(cancelled_one);
  EXPECT_EQ(cancelled_one.error(), cancelled());
  const auto factor = DenseFactor::make(matrix, none, Lanes::kTwo, {});
  ASSERT_TRUE(factor);
  std::vector<double> whole(8), short_one(6);
  EXPECT_THROW(factor->solve(short_one, short_one), BugError);
  EXPECT_THROW(factor->solve(whole, short_one), BugError);
}

TEST(DenseFactor, SolvesWithWhatWasAdded) {
  for (const int size : {1, 2, 3, 4, 5, 8, 11, 64, 131, 150, 261}) {
    const Dense matrix = make_definite(size, 2);
    std::vector<double> added(size);
    Dense sum = matrix;
    for (int i = 0; i < size; ++i)
      sum(i, i) += added[i] = 0.5 + 0.1 * i;
    const ComplexVector right = random_vector(size, 3), expected = sum.ldlt().solve(right);
    for (const Lanes lanes : {Lanes::kTwo, widest_lanes()}) {
      const auto factor = DenseFactor::make(split(matrix), added, lanes, {});
      ASSERT_TRUE(factor);
      EXPECT_LT((solve(*factor, right) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff() * size)
          << size;
    }
  }
}

TEST(DenseFactor, LanesDoNotChangeABit) {
  for (const int size : {3, 10, 77, 270}) {
    const SplitMatrix matrix = split(make_definite(size, 4));
    const std::vector<double> added(size, 0.25);
    const ComplexVector right = random_vector(size, 5);
    const auto two = DenseFactor::make(matrix, added, Lanes::kTwo, {});
    const auto most = DenseFactor::make(matrix, added, widest_lanes(), {});
    ASSERT_TRUE(two && most);
    EXPECT_EQ(solve(*two, right), solve(*most, right)) << size;
  }
}

TEST(FactorColumns, LeavesTheComplementOfTheFirstColumns) {
  for (const int size : {1, 4, 7, 30, 149}) {
    const Dense matrix = make_definite(size, 6);
    for (const int columns : {0, 1, 3, 4, 6, 29, 140}) {
      if (columns > size) continue;
      const int rest = size - columns;
      SplitMatrix found = split(matrix);
      ASSERT_TRUE(factor_columns(found, columns, widest_lanes(), {}));
      const Dense all = join(found);
      const Dense first = matrix.topLeftCorner(columns, columns), below = matrix.bottomLeftCorner(rest, columns);
      Dense complement = matrix.bottomRightCorner(rest, rest);
      if (columns > 0 && rest > 0) complement -= below * first.ldlt().solve(below.adjoint());
      EXPECT_LT((all.bottomRightCorner(rest, rest) - complement).norm(), 1e-11 * matrix.norm());
      const Dense lower = all.leftCols(columns).triangularView<Eigen::Lower>();
      EXPECT_LT((lower * lower.topRows(columns).adjoint() - matrix.leftCols(columns)).norm(), 1e-11 * matrix.norm());
    }
  }
}

TEST(SplitMatrix, IsZeroAgainAfterReset) {
  SplitMatrix matrix = split(make_definite(21, 7));
  for (const int size : {13, 5, 40, 0}) {
    matrix.reset(size);
    EXPECT_EQ(matrix.size(), size);
    for (int j = 0; j < matrix.padded(); ++j) {
      for (int i = j; i < matrix.padded(); ++i) {
        EXPECT_EQ(matrix.re(j)[i], 0);
        EXPECT_EQ(matrix.im(j)[i], 0);
      }
    }
  }
}

ComplexMatrix make_sparse(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  Dense half = Dense::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    half(i, i) = 2;
    for (int k = 0; k < 2; ++k)
      half(i, static_cast<Eigen::Index>(random() % static_cast<unsigned>(size))) +=
          Complex(value(random), value(random));
  }
  ComplexMatrix out = Dense(half.adjoint() * half + 0.1 * Dense::Identity(size, size)).sparseView();
  out.makeCompressed();
  return out;
}

TEST(Elimination, RefusesBadInput) {
  const ComplexMatrix matrix = make_sparse(9, 1);
  const std::vector<int> none, twice{3, 4, 3}, outside{9}, negative{-1}, fine{2, 5};
  for (const std::vector<int>& kept : {none, twice, outside, negative})
    EXPECT_THROW((void)Elimination::make(matrix, kept, Lanes::kTwo, {}), BugError);
  EXPECT_THROW((void)Elimination::make(ComplexMatrix(-matrix), fine, Lanes::kTwo, {}), BugError);
  const auto stopped = Elimination::make(matrix, fine, Lanes::kTwo, stopped_watch());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error(), cancelled());
  const auto made = Elimination::make(matrix, fine, Lanes::kTwo, {});
  ASSERT_TRUE(made);
  EXPECT_THROW((void)made->extend(ComplexVector::Zero(3)), BugError);
}

TEST(Elimination, AgreesWithTheDenseComplement) {
  std::mt19937 random(8);
  for (const int size : {2, 9, 40, 130}) {
    for (const int keep : {1, 2, 7, size}) {
      if (keep > size) continue;
      const ComplexMatrix matrix = make_sparse(size, static_cast<unsigned>(size));
      std::vector<int> order(size);
      std::iota(order.begin(), order.end(), 0);
      std::shuffle(order.begin(), order.end(), random);
      const std::vector<int> kept(order.begin(), order.begin() + keep);
      const auto made = Elimination::make(matrix, kept, widest_lanes(), {});
      ASSERT_TRUE(made);
      const Dense all = Dense(matrix)(order, order);
      const int rest = size - keep;
      const Dense inside = all.bottomRightCorner(rest, rest), between = all.bottomLeftCorner(rest, keep);
      const Dense way = rest > 0 ? Dense(-inside.ldlt().solve(between)) : Dense(0, keep);
      const Dense expected = all.topLeftCorner(keep, keep) + between.adjoint() * way;
      EXPECT_LT((join(made->complement()) - expected).norm(), 1e-11 * expected.norm());
      const ComplexVector values = random_vector(keep, 9), found = made->extend(values), inner = way * values;
      for (int k = 0; k < size; ++k)
        EXPECT_LT(std::abs(found[order[k]] - (k < keep ? values[k] : inner[k - keep])), 1e-10);
    }
  }
}

ClosedCurve make_clover() {
  Points points;
  for (int k = 0; k < 90; ++k) {
    const double angle = 2 * std::numbers::pi * k / 90, radius = 60 + 25 * std::cos(3 * angle) + 9 * std::sin(angle);
    points.push_back({200 + radius * std::cos(angle), 90 + 0.7 * radius * std::sin(angle)});
  }
  return ClosedCurve(std::move(points));
}

/// The paper's descent from handles at even distances, 50 steps: all that the handles and energies went through.
std::vector<ComplexVector> descend(const HandleSystem& system, std::vector<double>& energies) {
  const ClosedCurve sketch = make_clover();
  ComplexVector h(system.handle_count());
  for (int i = 0; i < system.handle_count(); ++i)
    h[i] = to_complex(sketch.at(sketch.length() * i / system.handle_count()));
  std::vector<ComplexVector> out{h};
  for (int step = 0; step < 50; ++step) {
    const HandleSystem::Slope slope = system.slope(h);
    energies.push_back(slope.energy);
    for (int i = 0; i < system.handle_count(); ++i)
      h[i] = to_complex(sketch.nearest(to_point(h[i] - 0.5 * slope.gradient[i])).point);
    out.push_back(h);
  }
  out.push_back(system.place(h));
  return out;
}

HandleSystem make_system(const GridMesh& grid, double weight, std::optional<HandleForm> form = {}) {
  auto made = HandleSystem::make(grid.mesh, grid.loop, weight, {}, form);
  EXPECT_TRUE(made);
  return *std::move(made);
}

GridMesh make_notched_grid() {
  return make_grid(17, 14, [](int x, int y) { return (x != 8 || y > 5) && (x < 12 || y < 10); });
}

TEST(HandleForm, BothGoThroughTheSameIterates) {
  const GridMesh grid = make_notched_grid();
  for (const double weight : {0.1, 0.5, 1.0}) {
    std::vector<double> energies, expected_energies;
    const auto found = descend(make_system(grid, weight, HandleForm::kReduced), energies);
    const auto expected = descend(make_system(grid, weight, HandleForm::kSparse), expected_energies);
    EXPECT_LT(expected_energies.back(), 0.95 * expected_energies.front()) << "the steps lead somewhere";
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((found[k] - expected[k]).cwiseAbs().maxCoeff(), 1e-9 * 200) << weight << " " << k;
    for (std::size_t k = 0; k < energies.size(); ++k)
      EXPECT_NEAR(energies[k], expected_energies[k], 1e-9 * expected_energies[k]) << weight << " " << k;
  }
}

TEST(HandleForm, BothAgreeForEveryWeight) {
  GridMesh grid = make_notched_grid();
  grid.loop.push_back(grid.loop[7]);
  const ComplexVector h = 80 * random_vector(static_cast<int>(grid.loop.size()), 10);
  for (const double weight : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    const HandleSystem reduced = make_system(grid, weight, HandleForm::kReduced);
    const HandleSystem sparse = make_system(grid, weight, HandleForm::kSparse);
    const HandleSystem::Slope found = reduced.slope(h), expected = sparse.slope(h);
    const double scale = expected.gradient.cwiseAbs().maxCoeff();
    EXPECT_LT((found.gradient - expected.gradient).cwiseAbs().maxCoeff(), 1e-9 * scale) << weight;
    EXPECT_NEAR(found.energy, expected.energy, 1e-9 * expected.energy) << weight;
    EXPECT_NEAR(found.energy, measure_energy(sparse.energy_operator(), sparse.place(h)), 1e-9 * expected.energy);
    EXPECT_LT((reduced.place(h) - sparse.place(h)).cwiseAbs().maxCoeff(), 1e-9 * 80) << weight;
  }
}

TEST(HandleForm, FollowsTheSizesAlone) {
  EXPECT_EQ(choose_form(606, 148), HandleForm::kReduced);
  EXPECT_EQ(choose_form(400, 154), HandleForm::kReduced);
  EXPECT_EQ(choose_form(400, 155), HandleForm::kSparse);
  EXPECT_EQ(choose_form(200'000, 2000), HandleForm::kReduced);
  EXPECT_EQ(choose_form(200'000, 2001), HandleForm::kSparse);
  EXPECT_EQ(make_system(make_notched_grid(), 1).form(), HandleForm::kReduced);
  const GridMesh strip = make_grid(120, 1, [](int, int) { return true; });
  EXPECT_EQ(make_system(strip, 1).form(), HandleForm::kSparse);
}

TEST(HandleForm, WhatWasSolvedBeforeDoesNotChangeABit) {
  const GridMesh grid = make_notched_grid();
  std::vector<double> fresh_energies, energies, ignored;
  const auto fresh = descend(make_system(grid, 0.4), fresh_energies);
  const HandleSystem first = make_system(grid, 1);
  (void)descend(first, ignored);
  const auto second = first.with_handle_weight(7, {});
  ASSERT_TRUE(second);
  (void)descend(*second, ignored);
  const auto third = second->with_handle_weight(0.4, {});
  ASSERT_TRUE(third);
  (void)third->place(fresh.front());
  EXPECT_EQ(descend(*third, energies), fresh);
  EXPECT_EQ(energies, fresh_energies);
}

TEST(HandleForm, WithNothingInsideBothStillAgree) {
  const GridMesh strip = make_grid(9, 1, [](int, int) { return true; });
  const ComplexVector h = 40 * random_vector(static_cast<int>(strip.loop.size()), 11);
  const HandleSystem reduced = make_system(strip, 1, HandleForm::kReduced);
  const HandleSystem sparse = make_system(strip, 1, HandleForm::kSparse);
  EXPECT_LT((reduced.place(h) - sparse.place(h)).cwiseAbs().maxCoeff(), 1e-9 * 40);
  EXPECT_LT((reduced.slope(h).gradient - sparse.slope(h).gradient).cwiseAbs().maxCoeff(), 1e-9 * 40);
}

} // namespace
} // namespace oversketch
