// `bench`: what it refuses, and that its numbers fit together.  How long anything takes is never a test.

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

namespace oversketch {
namespace {

using nlohmann::json;
using testing::TempFolder;

class Bench : public ::testing::Test {
protected:
  Bench() {
    std::filesystem::create_directory(folder_ / "cases");
    folder_.write("cases/bar.json", R"({"name": "bar", "outline": [[0,0],[200,0],[200,40],[0,40]],
                                        "sketch": [[0,0],[100,30],[200,0],[205,40],[100,70],[-5,40]]})");
    folder_.write("cases/disc.json", R"({"name": "disc", "outline": [[0,0],[90,-40],[180,0],[220,90],[180,180],[90,220],
                  [0,180],[-40,90]], "sketch": [[0,0],[190,0],[190,190],[0,190]]})");
  }

  /// Exit code of `bench ARGUMENTS`; what it says is in stdout.txt and stderr.txt.
  int run(const std::string& arguments) {
    const std::string program = std::string(OVERSKETCH_BUILD_DIR) + "/bin/oversketch-cli";
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" + program + "' bench " + arguments + " > stdout.txt 2> stderr.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void expect_refused(const std::string& arguments, const std::string& code) {
    EXPECT_EQ(run(arguments), 1) << arguments;
    EXPECT_NE(folder_.read("stderr.txt").find(code), std::string::npos) << folder_.read("stderr.txt");
  }
  json measure(const std::string& arguments) {
    EXPECT_EQ(run(arguments + " --cases cases --json out.json"), 0) << folder_.read("stderr.txt");
    return json::parse(folder_.read("out.json"), nullptr, false);
  }

  TempFolder folder_;
};

TEST_F(Bench, RefusesWhatItCannotMeasure) {
  for (const char* usage : {"--runs 0", "--runs few", "--case cases", "--runs"})
    EXPECT_EQ(run(usage), 2) << usage;
  expect_refused("deform.mtach --cases cases", "bench.unknown");
  EXPECT_NE(folder_.read("stderr.txt").find("deform.match"), std::string::npos) << "a hint is missing";
  expect_refused("deform.match clone.fast --cases cases", "bench.unknown");
  expect_refused("deform.match --cases nowhere", "file.unreadable");
  std::filesystem::create_directory(folder_ / "empty");
  expect_refused("deform.match --cases empty", "bench.no-cases");
  expect_refused("deform.match --runs 1 --cases cases --json nowhere/out.json", "file.write");
  folder_.write("cases/eight.json", R"({"outline": [[0,0],[9,0],[9,9],[0,9]], "sketch": [[0,0],[9,9],[9,0],[0,9]]})");
  expect_refused("deform.match --cases cases", "eight.json");
}

TEST_F(Bench, NumbersFitTogether) {
  const json report = measure("deform.m deform.follow --runs 3");
  ASSERT_TRUE(report.is_object());
  EXPECT_GE(report["machine"]["cores"], 1);
  EXPECT_EQ(report["cases"], 2);
  std::set<std::string> names;
  for (const json& row : report["benchmarks"]) {
    const std::string name = row["name"];
    SCOPED_TRACE(name);
    EXPECT_TRUE(names.insert(name).second);
    EXPECT_LE(row["median"], row["worst"]);
    EXPECT_LE(row["mean"], row["worst"]);
    EXPECT_LE(row["worst"], row["max"]);
    EXPECT_LE(row["p95"], row["max"]);
    const bool time = row["unit"] == "ms";
    EXPECT_EQ(row.contains("wall_median"), time);
    if (time) {
      EXPECT_GT(row["median"], 0);
      EXPECT_EQ(row["runs"], 3 * row["items"].get<int>());
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{"deform.mesh", "deform.match", "deform.follow", "deform.follow.matches"}));
  // A slider needs no new match, up or down, on either case.
  EXPECT_EQ(report["benchmarks"].back()["items"], 4);
  EXPECT_EQ(report["benchmarks"].back()["max"], 0);
}

TEST_F(Bench, TellsTheGoal) {
  const json report = measure("deform.sketch.20k --runs 1");
  ASSERT_EQ(report["benchmarks"].size(), 1u);
  EXPECT_EQ(report["benchmarks"][0]["goal"], 25);
  EXPECT_EQ(report["benchmarks"][0]["goal_of"], "median");
  EXPECT_NE(folder_.read("stdout.txt").find("<= 25 median"), std::string::npos) << folder_.read("stdout.txt");
}

TEST_F(Bench, PrintsARowForEachNumber) {
  const json report = measure("deform.p deform.similar --runs 1");
  const std::string table = folder_.read("stdout.txt");
  EXPECT_EQ(report["benchmarks"].size(), 6u);
  for (const json& row : report["benchmarks"])
    EXPECT_NE(table.find("\n" + row["name"].get<std::string>() + " "), std::string::npos) << table;
}

TEST_F(Bench, MovingALayerSolvesNothing) {
  const json report = measure("deform.similar.work --runs 1");
  ASSERT_EQ(report["benchmarks"].size(), 1u);
  EXPECT_EQ(report["benchmarks"][0]["items"], 2);
  EXPECT_EQ(report["benchmarks"][0]["max"], 0);
}

TEST_F(Bench, FindsTheCasesOfTheProject) {
  ASSERT_EQ(run("deform.display --runs 1 --json out.json"), 0) << folder_.read("stderr.txt");
  EXPECT_EQ(json::parse(folder_.read("out.json"))["cases"], 14);
}

} // namespace
} // namespace oversketch
