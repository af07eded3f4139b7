// The command line as another program sees it: exit codes, what stands on stderr, what is written and what is not.

#include "core/image/compare.h"
#include "core/image/image_io.h"

#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;
using nlohmann::json;

struct Outcome {
  int code = -1;
  std::string text;
};

class CommandLine : public ::testing::Test {
protected:
  CommandLine() {
    EXPECT_TRUE(save_image(wavy_image(90, 70, 1), folder / "source.png").ok());
    EXPECT_TRUE(save_image(wavy_image(200, 150, 4), folder / "target.png").ok());
    EXPECT_TRUE(save_image(disc_mask(90, 70, 28), folder / "mask.png").ok());
    json given;
    given["outline"] = points(blob({50, 50}, 40));
    given["sketch"] = points(blob({80, 60}, 44, 0.3));
    given["truth"] = points(blob({80, 60}, 44, 0.3));
    folder.write("case.json", given.dump());
  }

  static Image disc_mask(int width, int height, double radius) {
    Raster<Rgba> pixels(width, height, {0, 0, 0, 1});
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (std::hypot(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0) < radius) pixels.at(x, y) = {1, 1, 1, 1};
    return Image(std::move(pixels));
  }

  static json points(const Points& list) {
    json array = json::array();
    for (const Point p : list)
      array.push_back({p.x, p.y});
    return array;
  }

  /// Runs the program in the folder; output and errors together.
  Outcome run(const std::string& arguments) const {
    const std::string line =
        "cd '" + folder.path().string() + "' && '" OVERSKETCH_BUILD_DIR "/bin/oversketch-cli' " + arguments + " 2>&1";
    Outcome outcome;
    FILE* pipe = popen(line.c_str(), "r");
    if (pipe == nullptr) return outcome;
    char buffer[4096];
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
      outcome.text.append(buffer, got);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
  }

  /// Refused with exit 1 and that code, and nothing written.
  void refused(const std::string& arguments, const std::string& code) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments << "\n" << outcome.text;
    EXPECT_EQ(outcome.text.rfind("oversketch-cli: " + code + ": ", 0), 0u) << arguments << "\n" << outcome.text;
    EXPECT_FALSE(fs::exists(folder / "out.png")) << arguments;
    EXPECT_FALSE(fs::exists(folder / "out.json")) << arguments;
  }

  TempFolder folder;
};

TEST_F(CommandLine, tells_usage_from_refusal) {
  EXPECT_EQ(run("").code, 2);
  EXPECT_EQ(run("fly").code, 2);
  EXPECT_EQ(run("deform case.json").code, 2);
  EXPECT_EQ(run("deform case.json --out out.json --method best").code, 2);
  EXPECT_EQ(run("deform case.json --out out.json --cell many").code, 2);
  EXPECT_EQ(run("clone --source source.png --target target.png --mask mask.png --out out.png --mode mixd").code, 2);
  const Outcome unknown = run("evalute .");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.text.find("did you mean \"evaluate\"?"), std::string::npos) << unknown.text;
  EXPECT_EQ(run("commands >/dev/full").code, 1);
  EXPECT_EQ(run("--help").code, 0);
  EXPECT_EQ(run("--version").code, 0);
  for (const char* sub : {"run", "render", "deform", "evaluate", "clone", "warp", "commands"}) {
    const Outcome help = run(std::string(sub) + " --help");
    EXPECT_EQ(help.code, 0) << sub;
    EXPECT_NE(help.text.find("Example:"), std::string::npos) << sub;
    EXPECT_NE(help.text.find("--report"), std::string::npos) << sub;
    EXPECT_NE(help.text.find("--threads"), std::string::npos) << sub;
  }
}

TEST_F(CommandLine, refuses_bad_input_and_writes_nothing) {
  refused("run none.jsonl", "file.missing");
  refused("deform none.json --out out.json", "file.missing");
  folder.write("broken.json", "{\"outline\": [[1, 2], ");
  refused("deform broken.json --out out.json", "case.syntax");
  folder.write("eight.json", R"({"outline": [[0,0],[50,50],[50,0],[0,50]], "sketch": [[0,0],[50,0],[50,50]]})");
  refused("deform eight.json --out out.json", "curve.crosses-itself");
  refused("deform case.json --out out.json --cell 500", "mesh.cell-too-large");
  refused("deform case.json --out out.json --cell 0.01", "mesh.too-many-vertices");
  refused("deform case.json --out out.json --cell nan", "mesh.cell");
  refused("deform case.json --out out.json --stiffness -1", "deform.stiffness");
  refused("deform case.json --out out.json --follow nan", "deform.follow");
  refused("deform case.json --out out.json --method paper --handle-weight 0", "deform.handle-weight");
  refused("deform case.json --out out.json --iterations -5", "deform.iterations");
  refused("deform case.json --out none/out.json", "file.write");
  refused("evaluate none", "file.missing");
  folder.write("large.jsonl",
               "{\"oversketch_script\": 1}\n{\"do\": \"document.new\", \"width\": 300, \"height\": 300}\n");
  refused("run large.jsonl --memory 1", "image.too-large");
  refused("render large.jsonl --out out.png --memory 1", "image.too-large");
  const std::string scaled = R"({"oversketch_script": 1}
{"do": "document.new", "target": "source.png"}
{"do": "layer.add", "source": "source.png"}
{"do": "region.set", "outline": [[10, 10], [50, 10], [50, 40], [10, 40]]}
{"do": "layer.transform", "scale": 80}
)";
  folder.write("scaled.jsonl", scaled);
  refused("render scaled.jsonl --out out.png --memory 100", "warp.too-large");
  folder.write("scaled.jsonl", scaled + "{\"do\": \"export\", \"path\": \"out.png\"}\n");
  refused("run scaled.jsonl --memory 100", "warp.too-large");
  fs::create_directory(folder / "empty");
  refused("evaluate empty", "evaluate.no-cases");
  const std::string clone = "clone --source source.png --target target.png --out out.png ";
  refused(clone + "--mask none.png", "image.missing");
  refused(clone + "--mask case.json", "image.unknown-format");
  refused(clone + "--mask target.png", "clone.mask-size");
  refused(clone + "--mask mask.png --at 1.5,2", "clone.at");
  refused(clone + "--mask mask.png --at 99999999,2", "clone.at");
  refused("warp --image source.png --outline case.json --sketch case.json --out out.jpg", "image.no-alpha");
  for (const char* wrong : {"--strength 1.5", "--strength nan", "--feather -1", "--feather 1001", "--screening 100001"})
    refused(clone + "--mask mask.png " + wrong, "value.range");
  ASSERT_TRUE(save_image(wavy_image(250, 250, 1), folder / "wide.png").ok());
  const Outcome large = run("clone --source wide.png --target wide.png --mask wide.png --out out.png --memory 1");
  EXPECT_EQ(large.code, 1) << "of both pictures together";
  EXPECT_NE(large.text.find("at most 3036 pixels are opened"), std::string::npos) << large.text;
  refused("clone --source source.png --target target.png --mask mask.png --out out.gif", "image.unknown-extension");
}

TEST_F(CommandLine, does_not_wait_for_a_pipe_and_shows_what_a_name_hides) {
  ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  refused("clone --source pipe.png --target target.png --mask mask.png --out out.png", "image.unreadable");
  folder.write("nul.jsonl", "{\"oversketch_script\": 1}\n{\"do\": \"document.new\", \"width\": 9, \"height\": 9}\n"
                            "{\"do\": \"export\", \"path\": \"x\\u0000y.png\"}\n");
  const Outcome outcome = run("run nul.jsonl");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.text.find("x\\x00y.png"), std::string::npos) << outcome.text;
}

TEST_F(CommandLine, deforms_a_case) {
  const Outcome outcome = run("deform case.json --out r.json --report report.json");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(outcome.text, "");
  const json result = json::parse(folder.read("r.json")), report = json::parse(folder.read("report.json"));
  EXPECT_EQ(result["positions"].size(), 40u);
  EXPECT_EQ(result["correspondence"].size(), 40u);
  EXPECT_EQ(result["grid"]["source"].size(), result["grid"]["deformed"].size());
  EXPECT_EQ(result["grid"]["cells"][0].size(), 4u);
  EXPECT_EQ(result["metrics"]["flipped_cells"], 0);
  EXPECT_TRUE(result["metrics"].contains("truth_error"));
  EXPECT_EQ(report["command"], "deform");
  for (const char* key : {"version", "wall_ms", "stages_ms"})
    EXPECT_TRUE(report.contains(key)) << key;
}

TEST_F(CommandLine, evaluates_cases_with_a_table_and_a_summary) {
  const Outcome outcome = run("evaluate . case.json --report report.json --method paper");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("2 cases"), std::string::npos) << outcome.text;
  const json report = json::parse(folder.read("report.json"));
  EXPECT_EQ(report["cases"].size(), 2u);
  EXPECT_EQ(report["summary"]["cases"], 2);
  EXPECT_TRUE(report["summary"].contains("cases_with_flips"));
  folder.write("a.json", R"({"outline": [[0,0],[50,0],[50,50],[0,50]], "sketch": [[0,0],[60,0],[50,50],[0,50]]})");
  ASSERT_EQ(run("evaluate a.json case.json --report mixed.json").code, 0);
  EXPECT_TRUE(json::parse(folder.read("mixed.json"))["summary"].contains("truth_error")) << "the first case has none";
  EXPECT_TRUE(report["summary"]["stages_ms"].contains("mesh"));
  for (const char* statistic : {"median", "p95", "max"})
    EXPECT_TRUE(report["summary"]["sigma_ratio_mean"].contains(statistic)) << statistic;
}

TEST_F(CommandLine, clones_a_picture_onto_itself_without_a_trace) {
  for (const char* mode : {"import", "mixed", "monochrome", "average", "none"}) {
    const Outcome outcome = run(
        std::string(
            "clone --source source.png --target source.png --mask mask.png --out same.png --report c.json --mode ") +
        mode);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const auto difference = compare(*load_image(folder / "same.png"), *load_image(folder / "source.png"));
    if (std::string(mode) != "monochrome") EXPECT_LE(difference->max_levels, 1) << mode;
    const json report = json::parse(folder.read("c.json"));
    EXPECT_GT(report["unknowns"], 2000);
    EXPECT_LT(report["residual_levels"], 0.1);
    for (const char* key : {"setup_ms", "solve_ms"})
      EXPECT_TRUE(report.contains(key)) << key;
  }
}

TEST_F(CommandLine, clones_over_any_edge_and_leaves_the_rest_alone) {
  const Image target = *load_image(folder / "target.png"), mask = *load_image(folder / "mask.png");
  for (const auto& [x, y] :
       {std::pair(30, 40), std::pair(-40, -30), std::pair(150, 120), std::pair(500, 0), std::pair(-1000, 0)}) {
    const std::string place = std::to_string(x) + "," + std::to_string(y);
    const Outcome outcome =
        run("clone --source source.png --target target.png --mask mask.png --out cloned.png --at " + place);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const Image cloned = *load_image(folder / "cloned.png");
    for (int py = 0; py < target.height(); ++py)
      for (int px = 0; px < target.width(); ++px) {
        const bool inside = mask.rect().contains(px - x, py - y) && mask.at(px - x, py - y).r > 0.5f;
        if (!inside) ASSERT_EQ(cloned.at(px, py), target.at(px, py)) << place << ": " << px << ", " << py;
      }
  }
}

TEST_F(CommandLine, uses_as_many_threads_as_it_is_told_with_the_same_bits) {
  ASSERT_TRUE(save_image(wavy_image(420, 400, 1), folder / "large.png").ok());
  ASSERT_TRUE(save_image(disc_mask(420, 400, 190), folder / "disc.png").ok());
  for (const char* mode : {"import", "mixed"}) {
    std::string alone;
    for (const int threads : {1, 2, 5}) {
      const Outcome outcome = run("clone --source large.png --target large.png --mask disc.png --at 9,4 --depth 16 "
                                  "--out out.png --report r.json --mode " +
                                  std::string(mode) + " --threads " + std::to_string(threads));
      ASSERT_EQ(outcome.code, 0) << outcome.text;
      EXPECT_EQ(json::parse(folder.read("r.json"))["threads"], threads);
      if (threads == 1) alone = folder.read("out.png");
      EXPECT_EQ(folder.read("out.png"), alone) << mode << ", " << threads;
    }
  }
}

TEST_F(CommandLine, warps_a_region_alone) {
  folder.write("o.json", points(blob({45, 35}, 25)).dump());
  folder.write("s.json", json{{"sketch", points(blob({70, 60}, 35, 0.25))}}.dump());
  const Outcome outcome = run("warp --image source.png --outline o.json --sketch s.json --out warped.png");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Image warped = *load_image(folder / "warped.png");
  EXPECT_EQ(warped.at(70, 60).a, 1);
  EXPECT_EQ(warped.at(1, 1).a, 0);
}

TEST_F(CommandLine, renders_a_scripts_last_state_and_lists_the_commands) {
  folder.write("work.jsonl",
               "{\"oversketch_script\": 1}\n{\"do\": \"document.new\", \"target\": \"target.png\"}\n"
               "{\"do\": \"layer.add\", \"source\": \"source.png\"}\n{\"do\": \"region.set\", \"outline\": " +
                   points(blob({45, 35}, 25)).dump() + "}\n{\"do\": \"export\", \"path\": \"not.png\"}\n");
  ASSERT_EQ(run("render work.jsonl --out shown.png --depth 16").code, 0);
  EXPECT_FALSE(fs::exists(folder / "not.png"));
  EXPECT_EQ(load_image(folder / "shown.png")->width(), 200);
  ASSERT_EQ(run("run work.jsonl --out made").code, 0);
  EXPECT_LE(compare(*load_image(folder / "made/not.png"), *load_image(folder / "shown.png"))->max_levels, 0);
  const json commands = json::parse(run("commands --json").text);
  EXPECT_GE(commands["commands"].size(), 16u);
  EXPECT_NE(run("commands").text.find("sketch.edit"), std::string::npos);
}

} // namespace
} // namespace oversketch
