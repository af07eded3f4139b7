#include "core/clone/float_factor.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <random>
#include <span>
#include <vector>

namespace oversketch {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// The graph of a `width` × `height` grid with some long edges, positive definite.
Matrix make_matrix(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.2, 1);
  const int n = width * height;
  std::vector<Eigen::Triplet<double>> entries;
  const auto connect = [&](int a, int b) {
    const double w = weight(random);
    entries.insert(entries.end(), {{a, a, w}, {b, b, w}, {a, b, -w}, {b, a, -w}});
  };
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 0.05);
    if (i % width + 1 < width) connect(i, i + 1);
    if (i + width < n) connect(i, i + width);
    if (i % 13 == 0 && i != n / 2) connect(i, n / 2);
  }
  Matrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

std::vector<Float4> noisy_side(int n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-1, 1);
  std::vector<Float4> out(static_cast<std::size_t>(n));
  for (Float4& x : out)
    x = {Float4::Lanes{value(random), value(random), value(random), value(random)}};
  return out;
}

const std::pair<int, int> kSizes[] = {{1, 1}, {2, 1}, {3, 2}, {40, 1}, {9, 9}, {31, 23}};

TEST(FloatFactor, SolvesWhatItsMatrixSays) {
  for (const auto& [width, height] : kSizes) {
    const Matrix a = make_matrix(width, height, 3);
    const Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> exact(a);
    const FloatFactor factor(exact.matrixL().nestedExpression());
    ASSERT_EQ(factor.size(), width * height);
    const std::vector<Float4> side = noisy_side(factor.size());
    std::vector<Float4> x = side;
    factor.substitute(x.data());
    for (std::size_t k = 0; k < 4; ++k) {
      Eigen::VectorXd b(factor.size());
      for (int i = 0; i < factor.size(); ++i)
        b[i] = static_cast<double>(side[static_cast<std::size_t>(i)][k]);
      const Eigen::VectorXd expected = exact.solve(b);
      for (int i = 0; i < factor.size(); ++i)
        EXPECT_NEAR(static_cast<double>(x[static_cast<std::size_t>(i)][k]), expected[i],
                    1e-5 * (1 + expected.lpNorm<Eigen::Infinity>()))
            << width << " " << height << " " << i;
    }
  }
}

TEST(FloatFactor, EveryProcessorGivesTheSameBits) {
  for (const auto& [width, height] : kSizes) {
    const Eigen::SimplicialLLT<Matrix> a(make_matrix(width, height, 4));
    const FloatFactor factor(a.matrixL().nestedExpression());
    std::vector<Float4> x = noisy_side(factor.size()), plain = x;
    factor.substitute(x.data());
    factor.substitute_plainly(plain.data());
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(x)), std::as_bytes(std::span(plain)))) << width;
  }
}

} // namespace
} // namespace oversketch
