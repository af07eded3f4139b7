#include "app/cli/cli.h"

#include "core/io/runner.h"

#include <filesystem>
#include <memory>

namespace oversketch::cli {
namespace {

struct RunArguments {
  std::string script, out;
};

Result<Json> run(const RunArguments& options, const IoLimits& limits, const Watch& watch) {
  const std::filesystem::path script(options.script);
  const std::filesystem::path folder = script.has_parent_path() ? script.parent_path() : std::filesystem::path(".");
  Session session;
  session.limit_memory(limits.memory_bytes);
  const std::filesystem::path out = options.out.empty() ? folder : std::filesystem::path(options.out);
  const auto summary = run_script_file(session, script, out, watch, limits);
  if (!summary) return summary.error();
  Json report;
  report["steps"] = summary->steps;
  report["written"] = Json::array();
  for (const auto& path : summary->written)
    report["written"].push_back(path.generic_string());
  return report;
}

} // namespace

void add_run(Cli& cli) {
  const auto options = std::make_shared<RunArguments>();
  CLI::App* sub = cli.add("run", "Replay a script; its exports land in the output folder.",
                          "run assets/samples/puffer.jsonl --out out");
  sub->add_option("script", options->script, "the script, JSON Lines")->required()->type_name("SCRIPT.jsonl");
  sub->add_option("--out", options->out, "output folder (the script's own when left out)")->type_name("DIR");
  cli.add_memory_option(sub);
  cli.on_run(sub, [options, &cli](const Watch& watch) { return run(*options, cli.limits(), watch); });
}

} // namespace oversketch::cli
