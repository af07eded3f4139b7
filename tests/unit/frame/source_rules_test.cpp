#include "tests/unit/frame/source_rules.h"

#include <gtest/gtest.h>

namespace oversketch::frame {
namespace {

const char* const kProject = OVERSKETCH_SOURCE_DIR;

/// Who may include whom in core, as the design has it; core/CMakeLists.txt must say the same.
RoomTable plan_rooms() {
  return {
      {"base", {}},
      {"image", {"base"}},
      {"geometry", {"base"}},
      {"mesh", {"base", "geometry"}},
      {"deform", {"base", "geometry", "mesh"}},
      {"warp", {"base", "image", "geometry", "mesh"}},
      {"clone", {"base", "image", "geometry"}},
      {"document", {"base", "image", "geometry"}},
      {"session", {"base", "image", "geometry", "mesh", "deform", "warp", "clone", "document"}},
      {"io", {"base", "image", "geometry", "mesh", "deform", "warp", "clone", "document", "session"}},
  };
}

RoomTable read_cmake_rooms() {
  return parse_cmake_rooms(read_text(std::string(kProject) + "/core/CMakeLists.txt"));
}

std::string join(const Offences& offences) {
  std::string text;
  for (const auto& offence : offences)
    text += "\n" + offence;
  return text;
}

/// Holds one check against the whole project.
template <class Check>
void expect_clean_project(const Check& check) {
  const auto sources = read_sources(kProject);
  ASSERT_GT(sources.size(), 10U) << "the sources were not found below " << kProject;
  Offences all;
  for (const auto& source : sources)
    for (const auto& offence : check(source))
      all.push_back(offence);
  EXPECT_TRUE(all.empty()) << join(all);
}

TEST(Includes, OffencesAreFoundWithTheirPlace) {
  const RoomTable rooms = plan_rooms();
  const auto offences = [&](const char* path, const char* text) { return check_includes({path, text}, rooms); };
  EXPECT_EQ(offences("core/mesh/a.cpp", "#include \"core/mesh/a.h\"\n#include \"core/document/b.h\"\n"),
            Offences{"core/mesh/a.cpp:2: core/mesh may not include core/document"});
  EXPECT_EQ(offences("core/base/a.h", "#include \"core/image/b.h\"").size(), 1U);
  EXPECT_EQ(offences("core/session/a.h", "#include \"ui/state/b.h\"").size(), 1U);
  EXPECT_EQ(offences("core/attic/a.h", "#include \"core/base/b.h\"").size(), 1U);
  EXPECT_EQ(offences("core/mesh/a.cpp", "#include \"a.h\"").size(), 1U);
  EXPECT_EQ(offences("core/mesh/a.cpp", "  #  include \"../geometry/b.h\"").size(), 1U);
  EXPECT_EQ(offences("ui/canvas/a.cpp", "#include \"app/gui/b.h\"").size(), 1U);
  EXPECT_EQ(offences("app/cli/a.cpp", "#include \"ui/state/b.h\"").size(), 1U);
  EXPECT_EQ(offences("app/cli/a.cpp", "#include \"app/gui/b.h\"").size(), 1U);
  EXPECT_EQ(offences("ui/canvas/a.cpp", "#include \"app/version.h\"").size(), 1U);
}

TEST(Includes, WhatTheTableAllowsPasses) {
  const RoomTable rooms = plan_rooms();
  EXPECT_EQ(join(check_includes({"core/deform/a.cpp", "#include \"core/mesh/b.h\"\n#include <vector>\n"}, rooms)), "");
  EXPECT_EQ(
      join(check_includes({"ui/panels/a.cpp", "#include \"ui/state/b.h\"\n#include \"core/session/c.h\""}, rooms)), "");
  EXPECT_EQ(join(check_includes({"app/gui/a.cpp", "#include \"ui/state/b.h\"\n#include \"app/gui/c.h\""}, rooms)), "");
  EXPECT_EQ(join(check_includes({"app/cli/a.cpp", "#include \"app/version.h\""}, rooms)), "");
  EXPECT_EQ(join(check_includes({"app/cli/a.cpp", "#include \"core/image/b.h\"\n#include \"app/cli/c.h\""}, rooms)),
            "");
}

TEST(Includes, CMakeHasTheRoomsOfThePlan) {
  EXPECT_EQ(parse_cmake_rooms("function(add_room name)\nadd_room(a)\nadd_room(b ROOMS a c LIBRARIES x y)\n  add_room(c "
                              "PUBLIC_LIBRARIES z\n ROOMS a)"),
            (RoomTable{{"a", {}}, {"b", {"a", "c"}}, {"c", {"a"}}}));
  EXPECT_EQ(read_cmake_rooms(), plan_rooms());
}

TEST(Includes, ProjectKeepsToTheTable) {
  const RoomTable rooms = read_cmake_rooms();
  expect_clean_project([&](const Source& source) { return check_includes(source, rooms); });
}

TEST(Libraries, OffencesAreFound) {
  const auto count = [](const char* path, const char* text) { return check_libraries({path, text}).size(); };
  EXPECT_EQ(count("core/document/a.cpp", "#include <Eigen/Dense>"), 1U);
  EXPECT_EQ(count("core/deform/a.cpp", "#include <Eigen/Dense>"), 0U);
  EXPECT_EQ(count("core/image/a.cpp", "#include <jpeglib.h>"), 0U);
  EXPECT_EQ(count("core/warp/a.cpp", "#include <jpeglib.h>"), 1U);
  EXPECT_EQ(count("core/session/a.cpp", "#include <X11/Xlib.h>"), 1U);
  EXPECT_EQ(count("ui/canvas/a.cpp", "#include <GL/gl.h>"), 1U);
  EXPECT_EQ(count("ui/render/a.cpp", "#include <GL/gl.h>"), 0U);
  EXPECT_EQ(count("ui/render/a.cpp", "#include <GLFW/glfw3.h>"), 1U);
  EXPECT_EQ(count("app/gui/a.cpp", "#include <GLFW/glfw3.h>"), 0U);
  EXPECT_EQ(count("core/document/a.cpp", "#include <nlohmann/json.hpp>"), 0U);
  EXPECT_EQ(count("core/mesh/a.cpp", "#include <nlohmann/json.hpp>"), 1U);
}

TEST(Libraries, ProjectKeepsThemInTheirRooms) {
  expect_clean_project(check_libraries);
}

TEST(Printing, OffencesAreFound) {
  const auto count = [](const char* path, const char* text) { return check_printing({path, text}).size(); };
  EXPECT_EQ(count("core/base/a.cpp", "#include <iostream>\nstd::cerr << 1;\nprintf(\"x\");\nfputs(s, stderr);"), 4U);
  EXPECT_EQ(count("core/base/a.cpp", "// printf(\n/* std::cout */ const char* a = \"puts(\";"), 0U);
  EXPECT_EQ(count("core/base/a.cpp", "std::snprintf(buffer, 9, format, x); print(y);"), 0U);
  EXPECT_EQ(count("app/cli/a.cpp", "std::cout << 1;"), 0U);
}

TEST(Printing, CoreAndUiPrintNothing) {
  expect_clean_project(check_printing);
}

TEST(State, OffencesAreFound) {
  const auto count = [](const char* text) { return check_state({"core/base/a.cpp", text}).size(); };
  EXPECT_EQ(count("int counter = 0;"), 1U);
  EXPECT_EQ(count("std::map<int, std::string> cache;"), 1U);
  EXPECT_EQ(count("double table[3][4] = {};"), 1U);
  EXPECT_EQ(count("std::mutex lock{};"), 1U);
  EXPECT_EQ(count("inline int shared = 1;"), 1U);
  EXPECT_EQ(count("  static int calls = 0;"), 1U);
  EXPECT_EQ(count("  static std::vector<int> scratch;"), 1U);
  EXPECT_EQ(count("  static auto make = []() { return 1; };"), 1U);
  EXPECT_EQ(count("  static thread_local const int x = 0;"), 1U);
  EXPECT_EQ(count("thread_local int x;"), 1U);
}

TEST(State, ConstantsAndFunctionsPass) {
  const auto expect_clean = [](const char* text) {
    EXPECT_EQ(join(check_state({"core/base/a.cpp", text})), "") << text;
  };
  expect_clean("constexpr int kSize = 3;\ninline constexpr double kHalf = 0.5;\nconst std::string kName{\"x\"};");
  expect_clean("  static const std::vector<int> kTable = {1};\n  static constexpr int kN = 1;");
  expect_clean("  const static int n = 2;");
  expect_clean("  static Result<int> make(int x = 0);\nstatic int twice(int x) { return 2 * x; }");
  expect_clean("bool operator==(const A& a, const A& b) = default;\nA::A() = default;\nusing B = int;\nstruct C;");
  expect_clean("template <class T>\nconcept D = true;\nenum class E : int { kOne };\nclass F final : public A {\n};");
  expect_clean("static_assert(sizeof(int) == 4);\n// static int x;\n/* int y = 0;\nint z = 1; */\n");
  expect_clean("const auto text = R\"(\nint inside = 1;\n)\";");
  expect_clean("Result<std::vector<int>> read(int a,\n                              int b) {\n  int local = 1;\n}");
}

TEST(State, ProjectHasNoMutableStatics) {
  expect_clean_project(check_state);
}

TEST(Shape, OffencesAreFound) {
  std::string lines;
  for (int i = 0; i < 400; ++i)
    lines += "x\n";
  EXPECT_EQ(check_shape({"core/base/a.cpp", lines}), Offences{});
  EXPECT_EQ(check_shape({"core/base/a.cpp", lines + "x\n"}), Offences{"core/base/a.cpp:401: more than 400 lines"});
  EXPECT_EQ(check_shape({"core/base/a.h", "// hello\n#pragma once\n"}).size(), 1U);
  EXPECT_EQ(check_shape({"core/base/a.h", "#pragma once\n"}), Offences{});
}

TEST(Shape, ProjectKeepsFilesSmall) {
  expect_clean_project(check_shape);
}

TEST(Blanking, KeepsCodeAndLines) {
  EXPECT_EQ(blank_comments_and_literals("a 'b' \"c\\\"d\" e"), "a            e");
  EXPECT_EQ(blank_comments_and_literals("1'000 // x\ny /* z\n*/ w"), "1'000     \ny     \n   w");
  EXPECT_EQ(blank_comments_and_literals("R\"q(a\" b\n)q\" c"), "        \n    c");
}

} // namespace
} // namespace oversketch::frame
