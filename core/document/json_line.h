#pragma once

// One line of JSON: a script's line.  Shared by the commands' and the script's readers.

#include "core/base/result.h"
#include "core/document/command.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

using Json = nlohmann::ordered_json;

/// @errors script.syntax (with the column), script.not-an-object, script.repeated-key, json.too-deep.
Result<Json> parse_json_line(std::string_view line);

/// Any JSON text with values within values at most `most_depth` deep, which takes at most about `most_bytes` of memory.
/// @errors script.syntax (with line and column), json.too-deep, json.too-large.
Result<Json> parse_json(std::string_view text, int most_depth, std::size_t most_bytes);

/// The library's words for what is wrong, without its own error number.
std::string json_reason(const Json::exception& problem);

std::string print_json_line(const Json& object);

/// The value of "do".
/// @errors script.no-do.
Result<std::string> read_do(const Json& object);

/// What print_command prints.
Json command_json(const Command& command);

/// The command of that name read from the object, or nothing when no command has it.
std::optional<Result<Command>> read_command(const Json& object, const std::string& name);

std::vector<std::string_view> command_names();

} // namespace oversketch
