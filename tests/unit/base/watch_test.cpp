#include "core/base/watch.h"

#include <gtest/gtest.h>

#include <string>

namespace oversketch {
namespace {

TEST(StageTimesTest, NothingToReportWithoutStages) {
  EXPECT_EQ(StageTimes().total_ms(), 0.0);
  StageTimer timer(nullptr, "stage");
  timer.stop();
}

TEST(StageTimesTest, AddsUpByStageInOrderOfFirstRun) {
  StageTimes times;
  times.add("mesh", 1.5);
  times.add("solve", 2);
  times.add("mesh", 0.25);
  ASSERT_EQ(times.stages_ms.size(), 2u);
  EXPECT_EQ(times.stages_ms[0], (std::pair<std::string, double>{"mesh", 1.75}));
  EXPECT_EQ(times.stages_ms[1], (std::pair<std::string, double>{"solve", 2.0}));
  EXPECT_EQ(times.total_ms(), 3.75);
}

TEST(StageTimerTest, AddsItsTimeOnce) {
  StageTimes times;
  {
    StageTimer timer(&times, "a");
    timer.stop();
    const double first = times.total_ms();
    EXPECT_GE(first, 0);
    timer.stop();
    EXPECT_EQ(times.total_ms(), first);
  }
  { const StageTimer timer(&times, "b"); }
  ASSERT_EQ(times.stages_ms.size(), 2u);
  EXPECT_EQ(times.stages_ms[1].first, "b");
}

TEST(WatchTest, ADefaultOneNeverStopsAndTellsNobody) {
  const Watch watch;
  EXPECT_FALSE(watch.stopped());
  watch.report(0.5, "solve");
}

TEST(WatchTest, HoldsWorkToItsThreads) {
  Watch watch;
  EXPECT_EQ(watch.threads_up_to(1), 1);
  EXPECT_GE(watch.threads_up_to(64), 1);
  watch.threads = 3;
  EXPECT_EQ(watch.threads_up_to(2), 2);
  EXPECT_EQ(watch.threads_up_to(8), 3);
  EXPECT_EQ(watch.threads_up_to(0), 1);
}

TEST(WatchTest, CopiesShareTheStopTokenAndTellProgress) {
  std::stop_source source;
  double done = 0;
  std::string stage;
  const Watch watch{source.get_token(), [&](double part, std::string_view name) { done = part, stage = name; },
                    nullptr};
  const Watch copy = watch;
  copy.report(0.5, "solve");
  EXPECT_EQ(done, 0.5);
  EXPECT_EQ(stage, "solve");
  source.request_stop();
  EXPECT_TRUE(watch.stopped());
  EXPECT_TRUE(copy.stopped());
  EXPECT_EQ(cancelled().code, "cancelled");
}

} // namespace
} // namespace oversketch
