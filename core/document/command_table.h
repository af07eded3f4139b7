#pragma once

#include "core/document/command.h"

#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

/// What a field of a command is, for help pages, menus and checks.
struct FieldInfo {
  std::string_view name;
  /// "number", "whole number", "text", "yes or no", "point [x, y]", "points [[x, y], …]", "layer id", "picture", …
  std::string type;
  std::string_view unit;
  std::string_view help;
  bool required = false;
  /// As JSON; empty when there is none.
  std::string default_value;
  /// Of numbers; infinite where there is no bound.
  double low = 0;
  double high = 0;
  /// The words a choice may be; empty for other types.
  std::vector<std::string_view> choices;
};

struct CommandInfo {
  /// The script's word: "layer.move".
  std::string_view name;
  /// The menu's and the history's: "Move".
  std::string_view label;
  std::string_view help;
  std::vector<FieldInfo> fields;
};

/// One row a command, in the order of the Command variant.
std::vector<CommandInfo> command_table();

/// The script's word for a command.
std::string_view name_of(const Command& command);

/// The menu's and the history's word for a command.
std::string_view label_word(const Command& command);

/// The command as one line of a script: {"do": …}.
std::string print_command(const Command& command);

/// The reverse of print_command: parse_command(print_command(c)) == c for every c whose texts are UTF-8.
/// @errors script.syntax, script.not-an-object, script.no-do, script.unknown-command, script.unknown-key,
/// script.missing-key,
///   script.type, script.repeated-key.
Result<Command> parse_command(std::string_view line);

/// Every number within its range in the table.
/// @errors value.range.
Result<void> check_values(const Command& command);

} // namespace oversketch
