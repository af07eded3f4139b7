#include "app/assets.h"
#include "app/cli/bench_cases.h"
#include "app/cli/cli.h"

#include "core/base/file.h"
#include "core/base/suggest.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

namespace oversketch::cli {
namespace {

struct BenchArguments {
  std::vector<std::string> names;
  std::string cases, json;
  int runs = 5;
};

std::vector<BenchGroup> all_groups() {
  std::vector<BenchGroup> groups;
  for (auto&& part : {deform_benches(), edit_benches(), quality_benches(), paper_benches(), picture_benches(),
                      warp_benches(), membrane_benches(), mixed_benches(), project_benches()})
    groups.insert(groups.end(), part.begin(), part.end());
  return groups;
}

/// Whether the row's name begins with one of the names, or there are none.
bool is_wanted(const BenchRow& row, const std::vector<std::string>& names) {
  return names.empty() ||
         std::any_of(names.begin(), names.end(), [&](const std::string& name) { return row.name.starts_with(name); });
}

bool has_wanted_row(const BenchGroup& group, const std::vector<std::string>& names) {
  return std::any_of(group.rows.begin(), group.rows.end(), [&](const BenchRow& row) { return is_wanted(row, names); });
}

Result<void> check_names(const std::vector<std::string>& names, const std::vector<BenchGroup>& groups) {
  std::vector<std::string_view> known;
  for (const BenchGroup& group : groups)
    for (const BenchRow& row : group.rows)
      known.push_back(row.name);
  for (const std::string& name : names)
    if (std::none_of(known.begin(), known.end(), [&](std::string_view row) { return row.starts_with(name); }))
      return Error{"bench.unknown", "no benchmark begins with \"" + name + "\"" + did_you_mean(name, known), ""};
  return {};
}

Result<std::vector<BenchCase>> load_cases(const std::string& folder, const Watch& watch) {
  if (!folder.empty()) return prepare_cases(folder, watch);
  const auto assets = find_assets();
  if (!assets) return assets.error();
  return prepare_cases(*assets / "cases", watch);
}

const char* name_of(BenchStatistic statistic) {
  switch (statistic) {
  case BenchStatistic::kMedian:
    return "median";
  case BenchStatistic::kMean:
    return "mean";
  case BenchStatistic::kWorst:
    return "worst";
  case BenchStatistic::kClock:
    return "clock";
  }
  return "";
}

/// Three digits that count.
std::string number(double value) {
  char text[32];
  const double size = std::abs(value);
  const char* format = size >= 99.95 || value == std::round(value) ? "%.0f"
                       : size >= 9.995                             ? "%.1f"
                       : size >= 0.9995                            ? "%.2f"
                                                                   : "%.3g";
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void print_head() {
  std::printf("%-28s %9s %9s %9s %9s %9s  %-14s %9s  %-6s %s\n", "benchmark", "median", "mean", "worst", "max", "clock",
              "goal", "prototype", "unit", "what (worst at)");
}

void print_row(const BenchRow& row, const BenchSummary& s) {
  const std::string goal = row.goal ? "<= " + number(row.goal->most) + " " + name_of(row.goal->of) : "";
  const std::string where = s.items > 1 ? " (" + s.worst_item + ")" : "";
  std::printf("%-28s %9s %9s %9s %9s %9s  %-14s %9s  %-6s %s%s\n", row.name.c_str(), number(s.median).c_str(),
              number(s.mean).c_str(), number(s.worst).c_str(), number(s.max).c_str(),
              s.wall_median ? number(*s.wall_median).c_str() : "", goal.c_str(),
              row.prototype ? number(*row.prototype).c_str() : "", std::string(row.unit).c_str(), row.what.c_str(),
              where.c_str());
  std::fflush(stdout);
}

Json row_json(const BenchRow& row, const BenchSummary& s) {
  Json json{{"name", row.name},   {"unit", row.unit}, {"what", row.what},
            {"median", s.median}, {"mean", s.mean},   {"p95", s.p95},
            {"max", s.max},       {"worst", s.worst}, {"worst_item", s.worst_item},
            {"items", s.items},   {"runs", s.runs}};
  if (s.wall_median) json["wall_median"] = *s.wall_median;
  if (row.goal) json["goal"] = row.goal->most, json["goal_of"] = name_of(row.goal->of);
  if (row.prototype) json["prototype"] = *row.prototype;
  return json;
}

Result<Json> bench(const BenchArguments& options, const Watch& watch) {
  std::vector<BenchGroup> groups = all_groups();
  if (auto sound = check_names(options.names, groups); !sound) return sound.error();
  std::erase_if(groups, [&](const BenchGroup& group) { return !has_wanted_row(group, options.names); });
  BenchInput input;
  input.runs = options.runs;
  input.watch = watch;
  input.watch.times = nullptr;
  input.watch.progress = {};
  // Goals are for one core.
  if (input.watch.threads == 0) input.watch.threads = 1;
  if (std::any_of(groups.begin(), groups.end(), [](const BenchGroup& group) { return group.uses_cases; })) {
    auto cases = load_cases(options.cases, watch);
    if (!cases) return cases.error();
    input.cases = std::move(*cases);
  }

  BenchRecord record;
  Json report;
  report["benchmarks"] = Json::array();
  print_head();
  for (const BenchGroup& group : groups) {
    if (auto done = group.run(input, record); !done) return done.error();
    for (const BenchRow& row : group.rows) {
      const auto summary = is_wanted(row, options.names) ? record.summarize(row.name) : std::nullopt;
      if (!summary) continue;
      print_row(row, *summary);
      report["benchmarks"].push_back(row_json(row, *summary));
    }
  }
  report["cases"] = input.cases.size();
  report["machine"]["cores"] = std::thread::hardware_concurrency();
  if (options.json.empty()) return report;
  const auto written = write_file(options.json, report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!written) return written.error();
  return report;
}

} // namespace

void add_bench(Cli& cli) {
  const auto options = std::make_shared<BenchArguments>();
  CLI::App* sub = cli.add("bench",
                          "Measure how fast this program is: processor time, beside the goals and what a prototype "
                          "took.\nmedian, mean and worst are over the cases, of each case's median; max is the longest "
                          "single run, clock the median by the clock.",
                          "bench deform.sketch clone --json bench.json");
  sub->add_option("names", options->names, "only benchmarks whose names begin so")->type_name("NAME");
  sub->add_option("--cases", options->cases, "folder of curve pairs (default: the project's)")->type_name("DIR");
  sub->add_option("--json", options->json, "write the numbers as JSON")->type_name("FILE");
  sub->add_option("--runs", options->runs, "runs of each piece of work, after one to warm up")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  cli.on_run(sub, [options](const Watch& watch) { return bench(*options, watch); });
}

} // namespace oversketch::cli
