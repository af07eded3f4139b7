#include "core/document/command_table.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace oversketch {
namespace {

using namespace testing;

std::string parse_refusal(std::string_view line) {
  const auto command = parse_command(line);
  return command.ok() ? "accepted" : command.error().code;
}

TEST(ParseCommand, refuses_what_is_wrong) {
  EXPECT_EQ(parse_refusal(""), "script.syntax");
  EXPECT_EQ(parse_refusal("{\"do\": \"layer.move\", "), "script.syntax");
  EXPECT_EQ(parse_refusal("[1, 2]"), "script.not-an-object");
  EXPECT_EQ(parse_refusal("{}"), "script.no-do");
  EXPECT_EQ(parse_refusal("{\"do\": 5}"), "script.no-do");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.fly"})"), "script.unknown-command");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.move", "by": [1, 2], "fast": true})"), "script.unknown-key");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.move"})"), "script.missing-key");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.move", "by": [1.5, 2]})"), "script.type");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.move", "by": [1e99, 2]})"), "script.type");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.move", "by": [1, 2], "by": [3, 4]})"), "script.repeated-key");
  EXPECT_EQ(parse_refusal(R"({"do": "region.set", "outline": [[1, 2], [3]]})"), "script.type");
  EXPECT_EQ(parse_refusal(R"({"do": "region.set", "outline": [[1, 2], [3, 1e999]]})"), "script.syntax");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.select", "layer": "L0"})"), "script.type");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.select", "layer": "L99999999999"})"), "script.type");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.select", "layer": 1})"), "script.type");
  EXPECT_EQ(parse_refusal(R"({"do": "layer.set", "mode": "mixd"})"), "script.type");
  EXPECT_EQ(parse_refusal(R"({"do": "document.new", "width": 9, "height": 9, "color": "#12345g"})"), "script.type");
  EXPECT_EQ(parse_refusal(std::string(100000, '[')), "script.syntax");
}

TEST(ParseCommand, asks_whether_you_meant) {
  const auto sentence = [](std::string_view line) { return parse_command(line).error().sentence; };
  EXPECT_NE(sentence(R"({"do": "sketch.sett", "curve": []})").find("did you mean \"sketch.set\"?"), std::string::npos);
  EXPECT_NE(sentence(R"({"do": "sketch.set", "curv": []})").find("did you mean \"curve\"?"), std::string::npos);
  EXPECT_NE(sentence(R"({"do": "layer.set", "mode": "mixd"})").find("did you mean \"mixed\"?"), std::string::npos);
  EXPECT_EQ(sentence(R"({"do": "xyzzy"})").find("did you mean"), std::string::npos);
}

TEST(PrintCommand, is_read_back_equal_for_every_command) {
  RandomCommands random(20261121);
  std::set<std::string_view> seen;
  for (int i = 0; i < 3000; ++i) {
    const Command command = random.next();
    seen.insert(name_of(command));
    const std::string line = print_command(command);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const auto again = parse_command(line);
    ASSERT_TRUE(again.ok()) << line << "\n" << to_string(again.error());
    EXPECT_EQ(*again, command) << line;
  }
  DocumentNew document = new_document(30, 20);
  document.color = Color{{1, 2.5, 255}};
  EXPECT_EQ(*parse_command(print_command(document)), Command(document));
  EXPECT_EQ(seen.size() + 1, std::variant_size_v<Command::variant>);
}

TEST(PrintCommand, leaves_out_what_is_not_set) {
  EXPECT_EQ(print_command(LayerMove{{}, {40, -12}}), R"({"do":"layer.move","by":[40,-12]})");
  EXPECT_EQ(print_command(LayerTransform{LayerId{2}, 0, 2, {}}), R"({"do":"layer.transform","layer":"L2","scale":2})");
}

TEST(CommandTable, describes_every_command_and_field) {
  const auto table = command_table();
  ASSERT_EQ(table.size(), std::variant_size_v<Command::variant>);
  std::set<std::string_view> names;
  for (const CommandInfo& command : table) {
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
    EXPECT_FALSE(command.label.empty());
    EXPECT_FALSE(command.help.empty());
    std::set<std::string_view> fields;
    for (const FieldInfo& field : command.fields) {
      EXPECT_TRUE(fields.insert(field.name).second) << command.name << " " << field.name;
      EXPECT_FALSE(field.help.empty()) << command.name << " " << field.name;
      EXPECT_FALSE(field.type.empty()) << command.name << " " << field.name;
      EXPECT_LT(field.low, field.high) << command.name << " " << field.name;
    }
  }
}

TEST(CommandTable, defaults_named_in_the_help_are_those_of_a_new_layer) {
  const LayerSettings fresh;
  const std::map<std::string_view, double> expected = {
      {"cell_px", fresh.cell_px},       {"stiffness", fresh.stiffness},
      {"follow", fresh.follow},         {"handle_weight", fresh.handle_weight},
      {"iterations", fresh.iterations}, {"strength", fresh.strength},
      {"opacity", fresh.opacity},       {"feather_px", fresh.feather_px},
      {"screening", fresh.screening}};
  std::size_t found = 0;
  for (const CommandInfo& command : command_table()) {
    if (command.name != "layer.set") continue;
    for (const FieldInfo& field : command.fields) {
      const auto value = expected.find(field.name);
      if (value == expected.end()) continue;
      ++found;
      std::string text = nlohmann::json(value->second).dump();
      if (text.ends_with(".0")) text.resize(text.size() - 2);
      EXPECT_NE(field.help.find(text + " from the start"), std::string_view::npos) << field.name;
    }
  }
  EXPECT_EQ(found, expected.size());
}

} // namespace
} // namespace oversketch
