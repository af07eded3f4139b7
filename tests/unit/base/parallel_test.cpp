#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace oversketch {
namespace {

TEST(RunParallel, EachIndexOnce) {
  for (const int threads : {-1, 0, 1, 2, 7})
    for (const int count : {0, 1, 2, 100}) {
      std::vector<std::atomic<int>> times(100);
      run_parallel(count, threads, [&](int i) { ++times[static_cast<std::size_t>(i)]; });
      for (int i = 0; i < 100; ++i)
        ASSERT_EQ(times[static_cast<std::size_t>(i)], i < count ? 1 : 0) << threads << ", " << count << ": " << i;
    }
}

TEST(RunParallel, OneThreadGoesInOrder) {
  std::vector<int> order;
  run_parallel(5, 1, [&](int i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(RunParallel, TwoThreadsRunAtOnce) {
  // Each waits for the other: one thread alone would never get past the first.
  std::atomic<int> here = 0;
  run_parallel(2, 2, [&](int) {
    ++here;
    while (here < 2)
      std::this_thread::yield();
  });
  EXPECT_EQ(here, 2);
}

TEST(RunParallel, WhatIsThrownComesOutAndTheRestIsLeft) {
  for (const int threads : {1, 3}) {
    std::atomic<int> done = 0;
    EXPECT_THROW(run_parallel(1000, threads,
                              [&](int i) {
                                if (i == 0) throw std::runtime_error("stop");
                                ++done;
                                std::this_thread::yield();
                              }),
                 std::runtime_error);
    EXPECT_LT(done, 1000);
  }
}

} // namespace
} // namespace oversketch
