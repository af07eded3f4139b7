#include "app/cli/deform_options.h"

#include "core/session/case_file.h"
#include "core/session/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>

namespace oversketch::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluateArguments {
  std::vector<std::string> given;
  DeformOptions deform;
};

/// The files themselves, and of folders all .json files in them, by name.
Result<std::vector<fs::path>> list_cases(const std::vector<std::string>& given) {
  std::vector<fs::path> files;
  for (const std::string& name : given) {
    std::error_code failure;
    if (!fs::is_directory(name, failure)) {
      files.emplace_back(name);
      continue;
    }
    std::vector<fs::path> inside;
    for (fs::directory_iterator entry(name, failure), end; !failure && entry != end; entry.increment(failure))
      if (entry->path().extension() == ".json") inside.push_back(entry->path());
    if (failure) return Error{"file.unreadable", failure.message(), name};
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  if (files.empty()) return Error{"evaluate.no-cases", "no .json file is there", given.front()};
  return files;
}

/// q-th rank_value, linear between ranks.
double rank_value(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double rank = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank), above = std::min(below + 1, values.size() - 1);
  if (values[below] == values[above]) return values[below];
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

/// Mean, median, 95th percentile, greatest and sum of every number that any of the objects has.
Json statistics_of(const std::vector<Json>& objects) {
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  for (const Json& object : objects)
    for (const auto& [key, value] : object.items()) {
      if (!value.is_number()) continue;
      auto column =
          std::find_if(columns.begin(), columns.end(), [&, &name = key](const auto& c) { return c.first == name; });
      if (column == columns.end()) column = columns.insert(columns.end(), {key, {}});
      column->second.push_back(value.get<double>());
    }
  Json statistics = Json::object();
  for (const auto& [key, values] : columns) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    statistics[key] = {{"mean", sum / static_cast<double>(values.size())},
                       {"median", rank_value(values, 0.5)},
                       {"p95", rank_value(values, 0.95)},
                       {"max", rank_value(values, 1)},
                       {"sum", sum}};
  }
  return statistics;
}

Json summarize(const Json& cases) {
  Json summary;
  summary["cases"] = cases.size();
  summary["cases_with_flips"] =
      std::count_if(cases.begin(), cases.end(), [](const Json& c) { return c["flipped_cells"] > 0; });
  summary.update(statistics_of({cases.begin(), cases.end()}));
  std::vector<Json> stages;
  for (const Json& c : cases)
    stages.push_back(c["stages_ms"]);
  summary["stages_ms"] = statistics_of(stages);
  return summary;
}

void print_row(const std::string& name, const Metrics& m) {
  const auto truth = m.truth_error ? std::to_string(100 * *m.truth_error).substr(0, 5) : std::string("-");
  std::printf("%-20.20s %6d %8.3f %8.3f %9.2f %9.2f %9.2f %8s %7d %7d %6d %8.1f\n", name.c_str(),
              m.distortion.flipped_cells, m.distortion.sigma_ratio_mean, m.distortion.sigma_ratio_max,
              m.distortion.area_spread, m.sketch_distance.mean, m.sketch_distance.max, truth.c_str(), m.vertices,
              m.iterations, m.order_violations, m.cpu_ms);
}

Result<Json> evaluate(const EvaluateArguments& options, const Watch& watch) {
  const auto files = list_cases(options.given);
  if (!files) return files.error();
  std::printf("%-20s %6s %8s %8s %9s %9s %9s %8s %7s %7s %6s %8s\n", "case", "flips", "σ1/σ2", "worst", "area",
              "dist px", "max px", "truth %", "n", "steps", "order", "cpu ms");
  Json cases = Json::array();
  for (std::size_t i = 0; i < files->size(); ++i) {
    watch.report(static_cast<double>(i) / static_cast<double>(files->size()), (*files)[i].filename().string());
    const auto given = read_case((*files)[i]);
    if (!given) return given.error();
    const auto solved = solve_case(*given, options.deform, watch);
    if (!solved) return at((*files)[i].string(), solved.error());
    print_row(given->name, solved->metrics);
    Json row;
    row["name"] = given->name;
    row.update(metrics_json(solved->metrics));
    cases.push_back(std::move(row));
  }
  Json report;
  report["summary"] = summarize(cases);
  const Json& s = report["summary"];
  std::printf("%zu cases, %d with flipped cells; mean σ1/σ2 %.3f", cases.size(), s["cases_with_flips"].get<int>(),
              s.contains("sigma_ratio_mean") ? s["sigma_ratio_mean"]["mean"].get<double>() : NAN);
  if (s.contains("truth_error"))
    std::printf("; median truth error %.3f %%", 100 * s["truth_error"]["median"].get<double>());
  std::printf("\n");
  report["cases"] = std::move(cases);
  return report;
}

} // namespace

void add_evaluate(Cli& cli) {
  const auto options = std::make_shared<EvaluateArguments>();
  CLI::App* sub = cli.add("evaluate", "Deform many cases and measure the distortion; a table on stdout.",
                          "evaluate cases --report report.json --method paper --cell 10");
  sub->add_option("cases", options->given, "case files, or folders of them")->required()->type_name("DIR_OR_FILES");
  add_deform_options(sub, options->deform);
  cli.on_run(sub, [options](const Watch& watch) { return evaluate(*options, watch); });
}

} // namespace oversketch::cli
