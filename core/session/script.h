#pragma once

#include "core/base/result.h"
#include "core/document/command.h"
#include "core/document/command_table.h"

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace oversketch {

// What a script may do besides commands.  The table in script_steps.h says what each field means.

struct UndoStep {
  int steps = 1;
  bool operator==(const UndoStep&) const = default;
};
struct RedoStep {
  int steps = 1;
  bool operator==(const RedoStep&) const = default;
};
struct SaveStep {
  std::string path;
  bool operator==(const SaveStep&) const = default;
};
struct OpenStep {
  std::string path;
  bool operator==(const OpenStep&) const = default;
};
struct ExportStep {
  std::string path;
  int depth = 8;
  bool operator==(const ExportStep&) const = default;
};
struct ExportLayerStep {
  LayerRef layer;
  std::string path;
  int depth = 8;
  bool operator==(const ExportLayerStep&) const = default;
};
struct ReportStep {
  std::string path;
  bool operator==(const ReportStep&) const = default;
};
struct ExpectStep {
  std::optional<int> layers, pins, history, flipped_cells;
  std::optional<std::string> image;
  double max_difference = 0;
  std::optional<bool> modified;
  bool operator==(const ExpectStep&) const = default;
};

using Step =
    std::variant<Command, UndoStep, RedoStep, SaveStep, OpenStep, ExportStep, ExportLayerStep, ReportStep, ExpectStep>;

struct ScriptLine {
  /// From 1, as an editor counts.
  int number = 0;
  Step step;
};

/// Reads a whole script: a first line {"oversketch_script": 1}, then one object a line; empty lines and lines beginning
/// with
/// '#' are skipped.  Nothing is run when a line is wrong.
///
/// @param name  of the file, for the place of errors: "name:line".
/// @errors script.header, script.version, and those of parse_command.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, std::string_view name);

/// One line: a command or another step.
Result<Step> parse_step(std::string_view line);
std::string print_step(const Step& step);

/// Of the steps that are no commands.
std::vector<CommandInfo> step_table();

inline constexpr std::string_view kScriptHeader = "{\"oversketch_script\": 1}";

} // namespace oversketch
