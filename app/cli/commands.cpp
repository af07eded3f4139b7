#include "app/cli/cli.h"

#include "core/session/script.h"

#include <cmath>
#include <cstdio>
#include <memory>

namespace oversketch::cli {
namespace {

Json field_json(const FieldInfo& field) {
  Json json;
  json["name"] = field.name;
  json["type"] = field.type;
  json["required"] = field.required;
  json["help"] = field.help;
  if (!field.unit.empty()) json["unit"] = field.unit;
  if (!field.default_value.empty()) json["default"] = Json::parse(field.default_value);
  if (std::isfinite(field.low)) json["min"] = field.low;
  if (std::isfinite(field.high)) json["max"] = field.high;
  if (!field.choices.empty()) json["choices"] = field.choices;
  return json;
}

Json table_json(const std::vector<CommandInfo>& table) {
  Json list = Json::array();
  for (const CommandInfo& command : table) {
    Json json;
    json["name"] = command.name;
    json["label"] = command.label;
    json["help"] = command.help;
    json["fields"] = Json::array();
    for (const FieldInfo& field : command.fields)
      json["fields"].push_back(field_json(field));
    list.push_back(std::move(json));
  }
  return list;
}

std::string bound_text(double value) {
  return value == std::floor(value) ? std::to_string(static_cast<long long>(value)) : Json(value).dump();
}

std::string range_text(const FieldInfo& field) {
  std::string text;
  for (const std::string_view choice : field.choices)
    text += (text.empty() ? "" : " | ") + std::string(choice);
  if (std::isfinite(field.low) && std::isfinite(field.high))
    text += bound_text(field.low) + "…" + bound_text(field.high);
  else if (std::isfinite(field.low))
    text += "≥ " + bound_text(field.low);
  if (!field.unit.empty()) text += (text.empty() ? "" : " ") + std::string(field.unit);
  if (!field.default_value.empty()) text += (text.empty() ? "" : ", ") + std::string("default ") + field.default_value;
  return text;
}

void print_table(const char* title, const std::vector<CommandInfo>& table) {
  std::printf("%s\n", title);
  for (const CommandInfo& command : table) {
    std::printf("\n  %s\n      %s\n", std::string(command.name).c_str(), std::string(command.help).c_str());
    for (const FieldInfo& field : command.fields) {
      const std::string range = range_text(field);
      std::printf("      %-14s %s%s; %s%s\n", std::string(field.name).c_str(), field.type.c_str(),
                  field.required ? "" : ", optional", std::string(field.help).c_str(),
                  range.empty() ? "" : (" (" + range + ")").c_str());
    }
  }
}

} // namespace

void add_commands(Cli& cli) {
  const auto as_json = std::make_shared<bool>(false);
  CLI::App* sub =
      cli.add("commands", "List the script commands with their fields, units, defaults and ranges.", "commands --json");
  sub->add_flag("--json", *as_json, "as JSON");
  cli.on_run(sub, [as_json](const Watch&) -> Result<Json> {
    if (*as_json) {
      Json all;
      all["commands"] = table_json(command_table());
      all["steps"] = table_json(step_table());
      std::printf("%s\n", all.dump(1).c_str());
    } else {
      print_table("Commands (undoable; a script's line is {\"do\": NAME, FIELD: VALUE, …})", command_table());
      std::printf("\n");
      print_table("Steps (no commands: they are not undone)", step_table());
    }
    return Json::object();
  });
}

} // namespace oversketch::cli
