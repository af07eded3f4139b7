#pragma once

#include "core/base/result.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oversketch::cli {

/// Processor time of the whole process, all threads, and time by the clock, ms.
struct Spent {
  double cpu_ms = 0;
  double wall_ms = 0;
};

/// Starts when it is made.  Resolution: nanoseconds.
class Stopwatch {
public:
  Stopwatch();
  Spent spent() const;

private:
  Spent start_;
};

/// Which number of a benchmark its goal bounds; kClock: wall_median, of what a person waits for.
enum class BenchStatistic { kMedian, kMean, kWorst, kClock };

struct BenchGoal {
  /// At most this, in the row's unit.
  double most = 0;
  BenchStatistic of = BenchStatistic::kMedian;
};

/// One line of the table.  Names are stable: other programs compare by them.
struct BenchRow {
  std::string name;
  std::string_view unit;
  std::string what;
  std::optional<BenchGoal> goal = {};
  /// What the prototype of the design notes took, in the row's unit.
  std::optional<double> prototype = {};
};

/// What was measured of one row.  An item is one piece of work, done several times: a case, or one edit of a case.
///
/// median, mean: of the items' medians.  worst: the greatest of them, so that a hiccup of the machine is no worst case.
/// p95, max: of all single runs.  All but wall_median are processor time where the unit is one of time.
struct BenchSummary {
  double median = 0, mean = 0, worst = 0, p95 = 0, max = 0;
  /// Median of the items' medians by the clock; none where the row is no time.
  std::optional<double> wall_median;
  std::string worst_item;
  int items = 0;
  int runs = 0;
};

/// Takes down what the benchmarks measure.
class BenchRecord {
public:
  /// One run.
  /// @param per  the row's value is ms · per: 1 for ms, 1000 for µs.
  void add(std::string_view row, std::string_view item, Spent spent, double per = 1);
  /// A number that is no time.
  void add_value(std::string_view row, std::string_view item, double value);

  /// Does `work` once to warm up, then `runs` times on the record.  `work` returns a Result; what it holds is let go
  /// after the watch has stopped.
  template <class Work>
  Result<void> repeat(std::string_view row, std::string_view item, int runs, Work work, double per = 1) {
    for (int run = -1; run < runs; ++run) {
      const Stopwatch watch;
      const auto done = work();
      const Spent spent = watch.spent();
      if (!done) return at(std::string(row) + ", " + std::string(item), done.error());
      if (run >= 0) add(row, item, spent, per);
    }
    return {};
  }

  /// None when nothing was measured.
  std::optional<BenchSummary> summarize(std::string_view row) const;

private:
  struct Item {
    std::string row, name;
    std::vector<double> values, wall;
  };
  Item& item_of(std::string_view row, std::string_view name);

  std::vector<Item> items_;
};

} // namespace oversketch::cli
