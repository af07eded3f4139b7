// `figures`: what it refuses, and that its pictures are there, of the right size, and the same each time.

#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/image/levels.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace oversketch {
namespace {

using nlohmann::json;
using testing::TempFolder;

class Figures : public ::testing::Test {
protected:
  Figures() {
    std::filesystem::create_directory(folder_ / "cases");
    folder_.write("cases/tiny.json", R"({"outline": [[0,0],[40,0],[40,80],[0,80]],
                                         "sketch": [[0,0],[40,5],[50,40],[40,80],[0,75],[10,40]]})");
    folder_.write("cases/eight.json", R"({"outline": [[0,0],[40,0],[40,80],[0,80]],
                                          "sketch": [[0,0],[40,80],[40,0],[0,80]]})");
  }

  /// Exit code of `figures ARGUMENTS`; what it says is in stdout.txt and stderr.txt.
  int run(const std::string& arguments) {
    const std::string program = std::string(OVERSKETCH_BUILD_DIR) + "/bin/oversketch-cli";
    const std::string command = "cd '" + folder_.path().string() + "' && '" + program + "' figures " + arguments +
                                " > stdout.txt 2> stderr.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void expect_refused(const std::string& arguments, const std::string& code) {
    EXPECT_EQ(run(arguments), 1) << arguments;
    EXPECT_NE(folder_.read("stderr.txt").find(code), std::string::npos) << folder_.read("stderr.txt");
  }
  Image picture(const std::string& name) {
    const auto image = load_image(folder_ / name);
    EXPECT_TRUE(image.ok()) << to_string(image.error());
    return image ? *image : Image();
  }

  TempFolder folder_;
};

/// Pixels of that colour, to a few levels.
int count(const Image& image, int r, int g, int b) {
  int found = 0;
  for (const Rgba& p : image.pixels().values())
    found += std::abs(p.r - static_cast<float>(r) / 255) + std::abs(p.g - static_cast<float>(g) / 255) +
                 std::abs(p.b - static_cast<float>(b) / 255) <
             0.02f;
  return found;
}

TEST_F(Figures, RefusesWhatItCannotDraw) {
  for (const char* usage : {"", "compare", "mona-lisa --out out", "--out", "compare --out out --case"})
    EXPECT_EQ(run(usage), 2) << usage;
  expect_refused("compare --cases cases --case none --out out", "file.missing");
  expect_refused("compare --cases cases --out out", "file.missing");
  expect_refused("compare --cases cases --case eight --out out", "sketch.crosses-itself");
  EXPECT_NE(folder_.read("stderr.txt").find("eight.json"), std::string::npos) << folder_.read("stderr.txt");
  folder_.write("file", "");
  expect_refused("compare --cases cases --case tiny --out file/out", "file.write");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/compare.png"));
}

TEST_F(Figures, CompareDrawsARowForEachCase) {
  ASSERT_EQ(run("compare --cases cases --case tiny --out one --report one.json"), 0) << folder_.read("stderr.txt");
  EXPECT_EQ(json::parse(folder_.read("one.json"))["files"], json({"compare.png"}));
  const Image one = picture("one/compare.png");
  EXPECT_EQ(one.width(), 2236);
  EXPECT_EQ(one.height(), 900);
  ASSERT_EQ(run("compare --cases cases --case tiny --case tiny --out two"), 0) << folder_.read("stderr.txt");
  const Image two = picture("two/compare.png");
  EXPECT_EQ(two.width(), 2236);
  EXPECT_EQ(two.height(), 900 + 516);
  // The second row is the first one again.
  bool same = true;
  for (int y = 262; same && y < 262 + 510; ++y)
    for (int x = 0; same && x < two.width(); ++x)
      same = two.at(x, y) == two.at(x, y + 516) && two.at(x, y) == one.at(x, y);
  EXPECT_TRUE(same);
  // Both kinds of squares and the sketch's line fill what they should: four regions half as wide as they are high, 400.
  const int squares = count(one, 0x5C, 0x8A, 0xD0) + count(one, 0xF7, 0xEB, 0xC6);
  EXPECT_GT(squares, 0.6 * 4 * 200 * 400);
  EXPECT_LT(squares, 1.1 * 4 * 200 * 400);
  EXPECT_GT(count(one, 0xDF, 0x29, 0x35), 3 * 800);
}

TEST_F(Figures, SameBytesEachTime) {
  for (const char* out : {"first", "second"})
    ASSERT_EQ(run(std::string("compare alternatives --cases cases --case tiny --threads ") +
                  (out[0] == 'f' ? "1" : "2") + " --out " + out),
              0)
        << folder_.read("stderr.txt");
  for (const char* name : {"compare.png", "alternatives.png"}) {
    EXPECT_EQ(folder_.read("first/" + std::string(name)), folder_.read("second/" + std::string(name))) << name;
    EXPECT_FALSE(folder_.read("first/" + std::string(name)).empty()) << name;
  }
}

TEST_F(Figures, ErrorsAreAsSmallAsTheyAreSaidToBe) {
  ASSERT_EQ(run("errors --out out --report r.json"), 0) << folder_.read("stderr.txt");
  EXPECT_EQ(json::parse(folder_.read("r.json"))["files"], json({"errors.png", "errors.json"}));
  const json rows = json::parse(folder_.read("out/errors.json"))["rows"];
  ASSERT_EQ(rows.size(), 3u);
  const double most[] = {1, 0.3, 0.03};
  for (const json& row : rows)
    for (std::size_t i = 0; i < 3; ++i) {
      const json& step = row["steps"][i];
      EXPECT_LE(step["worst_levels"], most[i]) << row["mask"] << step["step"];
      EXPECT_GT(step["mean_levels"], 0) << row["mask"] << step["step"];
    }
  EXPECT_EQ(picture("out/errors.png").width(), 2 * 64 + 4 * 380 + 3 * 36);
}

TEST_F(Figures, PaperHasItsPicturesAndItsTable) {
  folder_.write("cases/wide.json", R"({"outline": [[0,0],[300,0],[300,120],[0,120]],
                                       "sketch": [[0,0],[150,40],[300,0],[300,120],[150,160],[0,120]]})");
  ASSERT_EQ(run("paper --cases cases --case wide --out out --report r.json"), 0) << folder_.read("stderr.txt");
  const json report = json::parse(folder_.read("r.json"));
  for (const json& name : report["files"])
    EXPECT_TRUE(std::filesystem::exists(folder_ / ("out/" + name.get<std::string>()))) << name;
  for (const char* name : {"mesh", "gradients", "weight", "cells"})
    EXPECT_EQ(picture("out/paper-" + std::string(name) + ".png").width(), 2188) << name;
  const json table = json::parse(folder_.read("out/table.json"));
  ASSERT_EQ(table["rows"].size(), 3u);
  const double cells[] = {20, 10, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    const json& row = table["rows"][i];
    EXPECT_EQ(row["cell_px"], cells[i]);
    // As many as a grid over the rectangle, or one more each way.
    EXPECT_GE(row["vertices"], (300 / cells[i] + 1) * (120 / cells[i] + 1));
    EXPECT_LE(row["vertices"], (300 / cells[i] + 2) * (120 / cells[i] + 2));
    const std::string line = "| " + std::to_string(static_cast<int>(cells[i])) + " | " + row["vertices"].dump() + " |";
    EXPECT_GT(row["energy_start_px2"], row["energy_px2"]);
    for (const char* stage : {"init_s", "factor_s", "iterations_50_s"})
      EXPECT_GT(row[stage], 0) << stage;
    EXPECT_NE(folder_.read("out/table.md").find(line), std::string::npos) << folder_.read("out/table.md");
  }
}

} // namespace
} // namespace oversketch
