#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/io/limits.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace oversketch::cli {

using Json = nlohmann::ordered_json;

/// What the program was asked to do, and how it speaks of it.  One object for one call.
class Cli {
public:
  Cli();

  /// Exit code: 0 done, 1 the input was refused, 2 usage.
  int run(int argc, char** argv);

  /// Adds a subcommand with the options that all of them have; the caller adds its own and sets what it does.
  CLI::App* add(const std::string& name, const std::string& description, const std::string& example);
  /// What the subcommand does when it was chosen; returns what the report holds beyond the common keys.
  void on_run(CLI::App* subcommand, std::function<Result<Json>(const Watch&)> work);
  /// For subcommands that open pictures or projects; limits() says what was asked for.
  void add_memory_option(CLI::App* subcommand);
  IoLimits limits() const;

private:
  int perform(const std::string& name, const std::function<Result<Json>(const Watch&)>& work);

  CLI::App app_;
  std::vector<std::string> names_;
  std::string report_path_;
  int threads_ = 0;
  std::size_t memory_mb_ = IoLimits{}.memory_bytes >> 20;
  std::string chosen_;
  std::function<Result<Json>(const Watch&)> work_;
};

// One file each.
void add_run(Cli& cli);
void add_render(Cli& cli);
void add_info(Cli& cli);
void add_deform(Cli& cli);
void add_evaluate(Cli& cli);
void add_clone(Cli& cli);
void add_warp(Cli& cli);
void add_bench(Cli& cli);
void add_figures(Cli& cli);
void add_commands(Cli& cli);

} // namespace oversketch::cli
