#include "app/cli/bench_record.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

namespace oversketch::cli {
namespace {

double read_clock_ms(clockid_t clock) {
  timespec now{};
  CHECK(clock_gettime(clock, &now) == 0, "the clocks of POSIX are there");
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

Spent read_clocks() {
  return {read_clock_ms(CLOCK_PROCESS_CPUTIME_ID), read_clock_ms(CLOCK_MONOTONIC)};
}

/// Linear between ranks.
double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double rank = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank), above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

Stopwatch::Stopwatch() : start_(read_clocks()) {}

Spent Stopwatch::spent() const {
  const Spent now = read_clocks();
  return {now.cpu_ms - start_.cpu_ms, now.wall_ms - start_.wall_ms};
}

BenchRecord::Item& BenchRecord::item_of(std::string_view row, std::string_view name) {
  const auto known = std::find_if(items_.rbegin(), items_.rend(),
                                  [&](const Item& item) { return item.row == row && item.name == name; });
  if (known != items_.rend()) return *known;
  return items_.emplace_back(Item{std::string(row), std::string(name), {}, {}});
}

void BenchRecord::add(std::string_view row, std::string_view item, Spent spent, double per) {
  Item& to = item_of(row, item);
  to.values.push_back(per * spent.cpu_ms);
  to.wall.push_back(per * spent.wall_ms);
}

void BenchRecord::add_value(std::string_view row, std::string_view item, double value) {
  item_of(row, item).values.push_back(value);
}

std::optional<BenchSummary> BenchRecord::summarize(std::string_view row) const {
  BenchSummary summary;
  std::vector<double> medians, wall_medians, all;
  for (const Item& item : items_) {
    if (item.row != row) continue;
    medians.push_back(quantile(item.values, 0.5));
    if (!item.wall.empty()) wall_medians.push_back(quantile(item.wall, 0.5));
    all.insert(all.end(), item.values.begin(), item.values.end());
    if (medians.size() == 1 || medians.back() > summary.worst)
      summary.worst = medians.back(), summary.worst_item = item.name;
  }
  if (medians.empty()) return std::nullopt;
  summary.median = quantile(medians, 0.5);
  summary.mean = mean_of(medians);
  summary.p95 = quantile(all, 0.95);
  summary.max = *std::max_element(all.begin(), all.end());
  if (!wall_medians.empty()) summary.wall_median = quantile(wall_medians, 0.5);
  summary.items = static_cast<int>(medians.size());
  summary.runs = static_cast<int>(all.size());
  return summary;
}

} // namespace oversketch::cli
