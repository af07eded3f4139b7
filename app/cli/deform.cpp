#include "app/cli/deform_options.h"

#include "core/base/file.h"
#include "core/session/case_file.h"
#include "core/session/report.h"

#include <memory>
#include <optional>
#include <vector>

namespace oversketch::cli {
namespace {

constexpr int kMostAlternatives = 20;

struct DeformArguments {
  std::string given, out;
  /// None: not asked for.
  std::optional<int> alternatives;
  DeformOptions deform;
};

Result<std::vector<DeformedCase>> solve(const DeformCase& given, const DeformArguments& options, const Watch& watch) {
  if (options.alternatives) return solve_case_alternatives(given, options.deform, *options.alternatives + 1, watch);
  auto solved = solve_case(given, options.deform, watch);
  if (!solved) return solved.error();
  std::vector<DeformedCase> one;
  one.push_back(std::move(*solved));
  return one;
}

Result<Json> deform(const DeformArguments& options, const Watch& watch) {
  const auto given = read_case(options.given);
  if (!given) return given.error();
  const auto solved = solve(*given, options, watch);
  if (!solved) return at(options.given, solved.error());
  const auto written = write_file(options.out, result_json(*solved, options.alternatives.has_value()).dump() + "\n");
  if (!written) return written.error();
  Json report;
  report["name"] = given->name;
  report["metrics"] = metrics_json(solved->front().metrics);
  return report;
}

} // namespace

void add_deform(Cli& cli) {
  const auto options = std::make_shared<DeformArguments>();
  CLI::App* sub = cli.add("deform", "Deform one outline to one sketch, without pictures.",
                          "deform fish.json --out result.json --cell 8");
  sub->add_option("case", options->given, "{\"outline\", \"sketch\", \"truth\"?, \"pins\"?}")
      ->required()
      ->type_name("CASE.json");
  sub->add_option("--out", options->out, "positions, correspondence, mesh and metrics")
      ->required()
      ->type_name("RESULT.json");
  sub->add_option("--alternatives", options->alternatives,
                  "also solve at most K other ways to match the curves, into \"alternatives\" (flipfree, no pins)")
      ->type_name("K")
      ->check(CLI::Range(0, kMostAlternatives));
  add_deform_options(sub, options->deform);
  cli.on_run(sub, [options](const Watch& watch) { return deform(*options, watch); });
}

} // namespace oversketch::cli
