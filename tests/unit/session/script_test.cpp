#include "core/session/script.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

using namespace testing;

const std::string kHeader = "{\"oversketch_script\": 1}\n";

Error script_error(const std::string& text) {
  const auto lines = parse_script(text, "work.jsonl");
  if (lines.ok()) return {"accepted", "", ""};
  return lines.error();
}

TEST(ParseScript, refuses_what_is_wrong_and_says_where) {
  EXPECT_EQ(script_error("").code, "script.header");
  EXPECT_EQ(script_error("\n# nothing\n").code, "script.header");
  EXPECT_EQ(script_error("{\"do\": \"undo\"}\n").code, "script.header");
  EXPECT_EQ(script_error("PNG\x01\x02").code, "script.header");
  EXPECT_EQ(script_error("{\"oversketch_script\": 2}\n").code, "script.version");
  EXPECT_EQ(script_error("{\"oversketch_script\": 1, \"x\": 2}\n").code, "script.header");
  EXPECT_EQ(script_error(kHeader + "{\"do\": \"undoo\"}").code, "script.unknown-command");
  EXPECT_NE(script_error(kHeader + "{\"do\": \"undoo\"}").sentence.find("did you mean \"undo\"?"), std::string::npos);
  EXPECT_EQ(script_error(kHeader + "{\"do\": \"undo\", \"step\": 2}").code, "script.unknown-key");
  EXPECT_EQ(script_error(kHeader + "{\"do\": \"undo\", \"steps\": -2}").code, "value.range");
  EXPECT_EQ(script_error(kHeader + "{\"do\": \"export\"}").code, "script.missing-key");
  EXPECT_EQ(script_error(kHeader + kHeader).code, "script.no-do");
}

TEST(ParseScript, names_the_broken_line_of_a_long_script) {
  std::string text = kHeader;
  for (int i = 2; i < 1000; ++i)
    text += i % 3 == 0 ? "# a remark\n" : i % 3 == 1 ? "\r\n" : "{\"do\": \"undo\"}\n";
  text += "{\"do\": \"layer.move\", \"by\": [1]}\n{\"do\": \"undo\"}\n";
  EXPECT_EQ(script_error(text).where, "work.jsonl:1000");
}

TEST(ParseScript, keeps_line_numbers_over_blank_lines_and_remarks) {
  const auto lines = parse_script(
      "\xEF\xBB\xBF\n# first\n" + kHeader + "\n  {\"do\": \"undo\"}  \r\n\n{\"do\": \"redo\", \"steps\": 3}", "x");
  ASSERT_TRUE(lines.ok());
  ASSERT_EQ(lines->size(), 2u);
  EXPECT_EQ((*lines)[0].number, 5);
  EXPECT_EQ((*lines)[1].number, 7);
  EXPECT_EQ((*lines)[1].step, Step(RedoStep{3}));
}

TEST(PrintStep, is_read_back_equal) {
  ExpectStep expect;
  expect.layers = 2;
  expect.image = "golden/a.png";
  expect.max_difference = 1.5;
  expect.modified = false;
  const Step steps[] = {UndoStep{},
                        UndoStep{7},
                        RedoStep{2},
                        SaveStep{"a.jsonl"},
                        OpenStep{"b.jsonl"},
                        ExportStep{"ä \"q\".png", 16},
                        ExportLayerStep{LayerId{3}, "l.png", 8},
                        ReportStep{"r.json"},
                        expect,
                        Command(LayerMove{{}, {1, 2}})};
  for (const Step& step : steps) {
    const auto again = parse_step(print_step(step));
    ASSERT_TRUE(again.ok()) << print_step(step);
    EXPECT_EQ(*again, step) << print_step(step);
  }
}

} // namespace
} // namespace oversketch
