#include "core/clone/grid_kernels.h"

#include "core/clone/guidance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace oversketch {
namespace {

TEST(GridKernels, AllSetsGiveTheSameBits) {
  std::mt19937 random(8);
  std::normal_distribution<float> value;
  std::vector<float> in(600);
  for (float& v : in)
    v = value(random);
  const GridKernels plain = GridKernels::plain(), best = GridKernels::choose();
  for (const std::size_t count : {1u, 3u, 7u, 8u, 29u, 64u}) {
    const GridNeighbours at{&in[0], &in[71], &in[142], &in[213]};
    const auto same = [&](auto run) {
      std::vector<float> a(in.begin() + 300, in.begin() + 300 + 3 * 64), b = a;
      run(plain, a.data());
      run(best, b.data());
      EXPECT_EQ(a, b) << count;
    };
    same([&](const GridKernels& k, float* out) { k.relax(out, &in[284], at, count, 0.23f); });
    same([&](const GridKernels& k, float* out) { k.relax_zero(out, &in[284], count, 0.23f); });
    same([&](const GridKernels& k, float* out) { k.overrelax(out, &in[284], at, count, 0.3f, -0.4f); });
    same([&](const GridKernels& k, float* out) { k.eliminate(out, &in[284], at, count, 0.23f); });
    same([&](const GridKernels& k, float* out) { k.start_half(out, &in[284], at.north, at.south, count, 0.23f); });
    same([&](const GridKernels& k, float* out) { k.residual(out, &in[284], &in[400], at, count, 0.1f); });
    same([&](const GridKernels& k, float* out) { k.add_half(out, at.north, at.south, count); });
    same([&](const GridKernels& k, float* out) { k.weigh(out, &in[284], at.north, at.south, count); });
    EXPECT_EQ(plain.largest(&in[5], count), best.largest(&in[5], count));
    same([&](const GridKernels& k, float* out) { k.surplus(out, 64, {&in[0], 31}, {&in[1], 31}, count); });
  }
}

/// Of pairs along a row, of given ones above and below; longer than what is summed up at a time.
TEST(GridKernels, SumUpWhatThePairsOfAPixelAreGiven) {
  std::mt19937 random(10);
  std::normal_distribution<float> value(0, 0.1F);
  constexpr std::size_t kMost = 600, kStride = kMost + 2;
  std::vector<float> planes(6 * kStride), above(3 * kStride), below(3 * kStride);
  for (std::vector<float>* values : {&planes, &above, &below})
    for (float& v : *values)
      v = value(random);
  const PixelPlanes row{planes.data() + 1, kStride};
  for (const std::size_t count : {1u, 2u, 5u, 255u, 256u, 257u, 513u, 600u}) {
    std::vector<float> along(3 * kStride);
    GridKernels::plain().surplus(along.data(), kStride, {row.first - 1, kStride}, row, count + 1);
    for (const GridKernels& kernels : {GridKernels::plain(), GridKernels::choose()}) {
      constexpr float kMark = 77;
      std::vector<float> slots(3 * count + 1, kMark);
      const GridSlots<float> sums{slots.data(), slots.data() + 3 * ((count + 1) / 2)};
      EXPECT_TRUE(kernels.sum_pairs(sums, row, {above.data(), kStride}, {below.data(), kStride}, count));
      EXPECT_EQ(slots.back(), kMark);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t at = k * kStride + i;
          ASSERT_EQ(sums.at(i)[k], (along[at + 1] - along[at]) + (below[at] - above[at])) << count << " " << i;
        }
      below[kStride + count - 1] = std::numeric_limits<float>::infinity();
      EXPECT_FALSE(kernels.sum_pairs(sums, row, {above.data(), kStride}, {below.data(), kStride}, count)) << count;
      below[kStride + count - 1] = 0;
    }
  }
}

TEST(GridKernels, JudgeEachPairByItself) {
  // Levels of 8 bits, few of them: many pairs tie.
  std::mt19937 random(9);
  constexpr std::size_t kCount = 201, kStride = kCount + 1;
  std::vector<float> planes(6 * kStride), all(3 * kCount), one(3);
  for (float& v : planes)
    v = static_cast<float>(random() % 5 + 90) / 255;
  for (const GridKernels& kernels : {GridKernels::plain(), GridKernels::choose()}) {
    kernels.surplus(all.data(), kCount, {planes.data(), kStride}, {planes.data() + 1, kStride}, kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      kernels.surplus(one.data(), 1, {&planes[i], kStride}, {&planes[i + 1], kStride}, 1);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(all[k * kCount + i], one[k]) << i;
    }
  }
}

TEST(GridKernels, FindTheLargestWhereverItStands) {
  for (const GridKernels& kernels : {GridKernels::plain(), GridKernels::choose()})
    for (std::size_t count = 0; count < 40; ++count)
      for (std::size_t at = 0; at < count; ++at) {
        std::vector<float> values(count + 1, 0.5f);
        values[at] = at % 2 == 0 ? -2.0f : 2.0f;
        values[count] = 9;
        EXPECT_EQ(kernels.largest(values.data(), count), 2) << count << " " << at;
      }
}

/// Of pairs whose differences are almost equally strong the stronger one is found, whatever float makes of them.
TEST(GridKernels, JudgeNearTiesExactly) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-0.04f, 0.04f);
  constexpr std::size_t kPairs = 20'000;
  std::vector<float> p(6 * kPairs), q(6 * kPairs, 0.0f), out(3 * kPairs);
  const auto in = [&](std::size_t plane, std::size_t i) -> float& { return p[plane * kPairs + i]; };
  const auto strength = [&](std::size_t first, std::size_t i) {
    double sum = 0;
    for (std::size_t k = first; k < first + 3; ++k)
      sum += static_cast<double>(in(k, i)) * in(k, i);
    return sum;
  };
  for (std::size_t i = 0; i < kPairs; ++i) {
    for (std::size_t k = 0; k < 6; ++k)
      in(k, i) = value(random);
    // As far above the source's strength as a tie reaches, up to rounding.
    in(5, i) = 0.1f;
    for (std::size_t k = 0; k < 3; ++k)
      in(k, i) += in(3 + k, i);
    for (int step = 0; step < 20; ++step) {
      const double s = strength(0, i), t = strength(3, i), wanted = s + std::sqrt(kTie * (s + t));
      in(5, i) = static_cast<float>(in(5, i) + (wanted - t) / (2 * in(5, i)));
    }
  }
  for (const GridKernels& kernels : {GridKernels::plain(), GridKernels::choose()}) {
    kernels.surplus(out.data(), kPairs, {p.data(), kPairs}, {q.data(), kPairs}, kPairs);
    int kept = 0;
    for (std::size_t i = 0; i < kPairs; ++i) {
      const double s = strength(0, i), t = strength(3, i), more = t - s;
      const bool keeps = more > 0 && more * more > kTie * (s + t);
      kept += keeps ? 1 : 0;
      ASSERT_EQ(out[i] != 0, keeps) << i;
    }
    EXPECT_GT(kept, static_cast<int>(kPairs / 10));
    EXPECT_LT(kept, static_cast<int>(kPairs - kPairs / 10));
  }
}

} // namespace
} // namespace oversketch
