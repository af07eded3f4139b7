// How good the answers are that the other benchmarks time.

#include "app/cli/bench_cases.h"

#include <algorithm>
#include <cmath>

namespace oversketch::cli {
namespace {

Result<void> run_metrics(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const auto solved = solve_case(c.given, {}, input.watch);
    if (!solved) return at(c.given.name, solved.error());
    const Metrics& m = solved->metrics;
    record.add_value("quality.flipped_cells", c.given.name, m.distortion.flipped_cells);
    record.add_value("quality.sigma_ratio", c.given.name, m.distortion.sigma_ratio_mean);
    if (m.truth_error) record.add_value("quality.truth_error", c.given.name, 100 * *m.truth_error);
  }
  return {};
}

/// The same sketch drawn another way, and the map that brings the answer back.
struct Redrawn {
  std::string_view way;
  Points sketch;
  Similarity back;
};

std::vector<Redrawn> redraw(const Points& sketch) {
  Points reversed = sketch, turned = sketch;
  std::reverse(reversed.begin(), reversed.end());
  std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turned.size() / 3), turned.end());
  std::vector<Redrawn> all{{"reversed", reversed, {}}, {"started elsewhere", turned, {}}};
  for (const auto& [way, map] : {std::pair<std::string_view, Similarity>{"scaled by 20", {20.0, 0.0}},
                                 {"scaled by 0.05", {0.05, 0.0}},
                                 {"moved", {1.0, {1000.0, -700.0}}}})
    all.push_back({way, transformed(sketch, map), map.inverse()});
  return all;
}

Result<void> run_invariance(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const auto plain = solve_flipfree(c.flipfree, c.given.sketch, {}, {}, nullptr, input.watch);
    if (!plain) return at(c.given.name, plain.error());
    const double size = bounds(c.given.sketch).diagonal();
    for (const Redrawn& redrawn : redraw(c.given.sketch)) {
      const auto again = solve_flipfree(c.flipfree, redrawn.sketch, {}, {}, nullptr, input.watch);
      const std::string item = c.given.name + ", " + std::string(redrawn.way);
      if (!again) return at(item, again.error());
      double most = 0;
      for (std::size_t i = 0; i < plain->positions.size(); ++i)
        most = std::max(most, distance(redrawn.back(again->positions[i]), plain->positions[i]));
      record.add_value("quality.invariance", item, most / size);
    }
  }
  return {};
}

} // namespace

std::vector<BenchGroup> quality_benches() {
  return {
      {{{"quality.flipped_cells", "count", "cells with a flipped corner", BenchGoal{0, BenchStatistic::kWorst}, 0.0},
        {"quality.sigma_ratio", "ratio", "mean s1/s2 over a case's cells", {}, {}},
        {"quality.truth_error", "%", "distance from the truth, of the sketch's length", BenchGoal{0.5}, 0.54}},
       true,
       run_metrics},
      {{{"quality.invariance",
         "ratio",
         "largest change by size: reversed, restarted, scaled, moved",
         BenchGoal{1e-6, BenchStatistic::kWorst},
         {}}},
       true,
       run_invariance},
  };
}

} // namespace oversketch::cli
