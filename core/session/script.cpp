#include "core/session/script.h"

#include "core/session/script_steps.h"

#include "core/document/json_line.h"

#include <utility>

namespace oversketch {
namespace {

/// Calls visit.operator()<S>() for each step that is no command.
template <class Visit, std::size_t... i>
void for_each_step(Visit&& visit, std::index_sequence<i...>) {
  (visit.template operator()<std::variant_alternative_t<i + 1, Step>>(), ...);
}
template <class Visit>
void for_each_step(Visit&& visit) {
  for_each_step(std::forward<Visit>(visit), std::make_index_sequence<std::variant_size_v<Step> - 1>());
}

std::optional<Result<Step>> read_step(const Json& object, const std::string& name) {
  std::optional<Result<Step>> read;
  for_each_step([&]<class S>() {
    if (read || name != Spec<S>::name) return;
    auto record = read_record<S>(object, "do");
    if (!record) return void(read.emplace(record.error()));
    if (auto in_range = check_ranges(*record); !in_range) return void(read.emplace(in_range.error()));
    read.emplace(Step(std::move(*record)));
  });
  return read;
}

Result<void> check_header(std::string_view line) {
  const Error wrong{"script.header", "a script begins with " + std::string(kScriptHeader), ""};
  const auto object = parse_json_line(line);
  if (!object) return wrong;
  const auto version = object->find("oversketch_script");
  if (version == object->end() || !version->is_number_integer() || object->size() != 1) return wrong;
  if (*version != 1)
    return Error{"script.version", "this program reads scripts of version 1, not " + version->dump(), ""};
  return {};
}

std::string_view trimmed(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = line.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlank) - first + 1);
}

} // namespace

Result<Step> parse_step(std::string_view line) {
  const auto object = parse_json_line(line);
  if (!object) return object.error();
  const auto name = read_do(*object);
  if (!name) return name.error();
  if (auto command = read_command(*object, *name)) {
    if (!*command) return command->error();
    return Step(**command);
  }
  if (auto step = read_step(*object, *name)) return *step;
  auto names = command_names();
  for_each_step([&]<class S>() { names.push_back(Spec<S>::name); });
  return Error{"script.unknown-command",
               "there is no command \"" + name->substr(0, 60) + "\"" + did_you_mean(*name, names), ""};
}

std::string print_step(const Step& step) {
  return std::visit(
      [](const auto& s) {
        using S = std::remove_cvref_t<decltype(s)>;
        if constexpr (std::is_same_v<S, Command>) {
          return print_command(s);
        } else {
          Json object;
          object["do"] = Spec<S>::name;
          write_record(s, object);
          return print_json_line(object);
        }
      },
      step);
}

Result<std::vector<ScriptLine>> parse_script(std::string_view text, std::string_view name) {
  std::vector<ScriptLine> lines;
  bool have_header = false;
  int number = 0;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty()) {
    ++number;
    const auto end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line[0] == '#') continue;
    const std::string place = std::string(name) + ":" + std::to_string(number);
    if (!have_header) {
      if (auto header = check_header(line); !header) return at(place, header.error());
      have_header = true;
      continue;
    }
    auto step = parse_step(line);
    if (!step) return at(place, step.error());
    lines.push_back({number, std::move(*step)});
  }
  if (!have_header)
    return Error{"script.header", "a script begins with " + std::string(kScriptHeader), std::string(name)};
  return lines;
}

std::vector<CommandInfo> step_table() {
  std::vector<CommandInfo> table;
  for_each_step([&]<class S>() { table.push_back(describe_record<S>()); });
  return table;
}

} // namespace oversketch
