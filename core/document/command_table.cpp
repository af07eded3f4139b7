#include "core/document/command_table.h"

#include "core/document/command_specs.h"
#include "core/document/json_line.h"

#include <utility>

namespace oversketch {
namespace {

/// Calls visit.operator()<C>() for each command C, in order.
template <class Visit, std::size_t... i>
void for_each_command(Visit&& visit, std::index_sequence<i...>) {
  (visit.template operator()<std::variant_alternative_t<i, Command::variant>>(), ...);
}
template <class Visit>
void for_each_command(Visit&& visit) {
  for_each_command(std::forward<Visit>(visit), std::make_index_sequence<std::variant_size_v<Command::variant>>());
}

} // namespace

std::vector<CommandInfo> command_table() {
  std::vector<CommandInfo> table;
  for_each_command([&]<class C>() { table.push_back(describe_record<C>()); });
  return table;
}

std::string_view name_of(const Command& command) {
  return std::visit([](const auto& c) { return Spec<std::remove_cvref_t<decltype(c)>>::name; }, command);
}

std::string_view label_word(const Command& command) {
  return std::visit([](const auto& c) { return Spec<std::remove_cvref_t<decltype(c)>>::label; }, command);
}

Json command_json(const Command& command) {
  Json object;
  object["do"] = name_of(command);
  std::visit([&](const auto& c) { write_record(c, object); }, command);
  return object;
}

std::string print_command(const Command& command) {
  return print_json_line(command_json(command));
}

std::optional<Result<Command>> read_command(const Json& object, const std::string& name) {
  std::optional<Result<Command>> read;
  for_each_command([&]<class C>() {
    if (read || name != Spec<C>::name) return;
    auto record = read_record<C>(object, "do");
    if (record)
      read.emplace(Command(std::move(*record)));
    else
      read.emplace(record.error());
  });
  return read;
}

std::vector<std::string_view> command_names() {
  std::vector<std::string_view> names;
  for_each_command([&]<class C>() { names.push_back(Spec<C>::name); });
  return names;
}

Result<Command> parse_command(std::string_view line) {
  const auto object = parse_json_line(line);
  if (!object) return object.error();
  const auto name = read_do(*object);
  if (!name) return name.error();
  if (auto command = read_command(*object, *name)) return *command;
  return Error{"script.unknown-command", "there is no command \"" + *name + "\"" + did_you_mean(*name, command_names()),
               ""};
}

Result<void> check_values(const Command& command) {
  return std::visit([](const auto& c) { return check_ranges(c); }, command);
}

} // namespace oversketch
