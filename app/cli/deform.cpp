#include "app/cli/deform_options.h"

#include "core/base/file.h"
#include "core/session/case_file.h"
#include "core/session/report.h"

#include <memory>

namespace oversketch::cli {
namespace {

struct Options {
  std::string given, out;
  DeformOptions deform;
};

Result<Json> deform(const Options& options, const Watch& watch) {
  const auto given = read_case(options.given);
  if (!given) return given.error();
  const auto solved = solve_case(*given, options.deform, watch);
  if (!solved) return at(options.given, solved.error());
  const auto written = write_file(options.out, result_json(*solved).dump() + "\n");
  if (!written) return written.error();
  Json report;
  report["name"] = given->name;
  report["metrics"] = metrics_json(solved->metrics);
  return report;
}

} // namespace

void add_deform(Cli& cli) {
  const auto options = std::make_shared<Options>();
  CLI::App* sub = cli.add("deform", "Deform one outline to one sketch, without pictures.",
                          "deform fish.json --out result.json --cell 8");
  sub->add_option("case", options->given, "{\"outline\", \"sketch\", \"truth\"?, \"pins\"?}")
      ->required()
      ->type_name("CASE.json");
  sub->add_option("--out", options->out, "positions, correspondence, mesh and metrics")
      ->required()
      ->type_name("RESULT.json");
  add_deform_options(sub, options->deform);
  cli.on_run(sub, [options](const Watch& watch) { return deform(*options, watch); });
}

} // namespace oversketch::cli
