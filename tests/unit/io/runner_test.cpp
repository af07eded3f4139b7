#include "core/io/runner.h"

#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/io/ora_file.h"
#include "core/io/recorder.h"
#include "core/session/live_session.h"

#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

const std::string kHeader = "{\"oversketch_script\": 1}\n";

/// A folder with two pictures, and a script that pastes the one into the other.
class Runner : public ::testing::Test {
protected:
  Runner() {
    EXPECT_TRUE(save_image(wavy_image(120, 90, 0), folder / "target.png").ok());
    EXPECT_TRUE(save_image(wavy_image(100, 100, 2), folder / "source.png").ok());
    fs::create_directory(folder / "out");
  }

  static std::string points(const Points& list) {
    nlohmann::json json = nlohmann::json::array();
    for (const Point p : list)
      json.push_back({p.x, p.y});
    return json.dump();
  }

  static std::string body() {
    return "{\"do\": \"document.new\", \"target\": \"target.png\"}\n"
           "{\"do\": \"layer.add\", \"source\": \"source.png\", \"name\": \"fish\"}\n"
           "{\"do\": \"region.set\", \"outline\": " +
           points(blob({50, 50}, 30)) +
           "}\n"
           "{\"do\": \"sketch.set\", \"curve\": " +
           points(blob({60, 45}, 28, 0.3)) + "}\n";
  }

  Result<RunSummary> run(const std::string& lines) {
    folder.write("work.jsonl", kHeader + lines);
    return run_script_file(session, folder / "work.jsonl", folder / "out", {});
  }

  std::string refusal(const std::string& lines) {
    const auto done = run(lines);
    return done.ok() ? "accepted" : done.error().code;
  }

  TempFolder folder;
  Session session;
};

TEST_F(Runner, knows_a_project_by_its_ending_in_any_case) {
  EXPECT_EQ(refusal(body() + "{\"do\": \"save\", \"path\": \"A.ORA\"}\n{\"do\": \"open\", \"path\": \"A.ORA\"}"),
            "accepted");
  EXPECT_EQ(session.document().layers.size(), 1U);
  EXPECT_TRUE(OraFile::open(folder / "out/A.ORA").ok());
}

TEST_F(Runner, refuses_what_it_cannot_do) {
  EXPECT_EQ(run_script_file(session, folder / "none.jsonl", folder / "out", {}).error().code, "file.missing");
  EXPECT_EQ(refusal("{\"do\": \"export\", \"path\": \"a.png\"}"), "document.none");
  EXPECT_EQ(refusal("{\"do\": \"undo\"}"), "history.nothing-to-undo");
  EXPECT_EQ(refusal("{\"do\": \"document.new\", \"target\": \"none.png\"}"), "image.missing");
  EXPECT_EQ(refusal("{\"do\": \"document.new\", \"target\": \"work.jsonl\"}"), "image.unknown-format");
  EXPECT_EQ(refusal(body() + "{\"do\": \"export\", \"path\": \"a.tiff\"}"), "image.unknown-extension");
  EXPECT_EQ(refusal(body() + "{\"do\": \"export\", \"path\": \"a.jpg\", \"depth\": 16}"), "image.depth");
  EXPECT_EQ(refusal(body() + "{\"do\": \"export\", \"path\": \"a.png\", \"depth\": 12}"), "script.depth");
  EXPECT_EQ(refusal(body() + "{\"do\": \"save\", \"path\": \"a.xyz\"}"), "save.unknown-kind");
  EXPECT_EQ(refusal(body() + "{\"do\": \"open\", \"path\": \"none.jsonl\"}"), "file.missing");
  EXPECT_EQ(refusal(body() + "{\"do\": \"open\", \"path\": \"target.png\"}"), "script.header");
}

TEST_F(Runner, opens_no_more_than_the_memory_it_is_given) {
  ASSERT_TRUE(run(body() + "{\"do\": \"save\", \"path\": \"a.ora\"}\n{\"do\": \"save\", \"path\": \"a.jsonl\"}").ok());
  const auto refusal_with = [&](std::size_t memory_bytes, const std::string& lines) {
    folder.write("work.jsonl", kHeader + lines);
    IoLimits limits;
    limits.memory_bytes = memory_bytes;
    Session fresh;
    const auto done = run_script_file(fresh, folder / "work.jsonl", folder / "out", {}, limits);
    return done.ok() ? "accepted" : done.error().code;
  };
  const std::size_t both = load_image(folder / "target.png")->bytes() + load_image(folder / "source.png")->bytes();
  EXPECT_EQ(refusal_with(both, body()), "accepted");
  EXPECT_EQ(refusal_with(both - 1, body()), "image.too-large");
  std::size_t saved = 0, pixels = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out/a.files"))
    if (entry.is_regular_file()) {
      const auto picture = load_image(entry.path());
      saved += picture->bytes();
      pixels += picture->pixels().values().size_bytes();
    }
  EXPECT_EQ(refusal_with(saved, "{\"do\": \"open\", \"path\": \"a.jsonl\"}"), "accepted");
  EXPECT_EQ(refusal_with(saved - 1, "{\"do\": \"open\", \"path\": \"a.jsonl\"}"), "image.too-large");
  EXPECT_EQ(refusal_with(pixels, "{\"do\": \"open\", \"path\": \"a.ora\"}"), "accepted");
  EXPECT_EQ(refusal_with(pixels - 1, "{\"do\": \"open\", \"path\": \"a.ora\"}"), "project.too-large");
  const std::string canvas = "{\"do\": \"document.new\", \"width\": 100, \"height\": 10}\n";
  EXPECT_EQ(refusal_with(16'000, canvas), "accepted");
  EXPECT_EQ(refusal_with(15'999, canvas), "image.too-large");
  EXPECT_EQ(refusal_with(31'999, canvas + canvas), "image.too-large");
}

TEST_F(Runner, writes_nothing_outside_its_folder) {
  for (const char* path : {"/tmp/oversketch-stray.png", "../stray.png", "a/../../stray.png", "", "a/", ".."}) {
    const std::string line = "{\"do\": \"export\", \"path\": \"" + std::string(path) + "\"}";
    EXPECT_EQ(refusal(body() + line), "script.path") << path;
  }
  const auto too_long = run(body() + "{\"do\": \"export\", \"path\": \"" + std::string(300, 'a') + ".png\"}");
  ASSERT_FALSE(too_long.ok());
  EXPECT_NE(too_long.error().sentence.find("too long"), std::string::npos) << too_long.error().sentence;
  EXPECT_FALSE(fs::exists(folder / "stray.png"));
  fs::create_directory_symlink(folder.path(), folder / "out/link");
  EXPECT_EQ(refusal(body() + "{\"do\": \"report\", \"path\": \"link/stray.json\"}"), "script.path");
  folder.write("kept.png", "keep");
  fs::create_symlink(folder / "kept.png", folder / "out/file.png");
  fs::create_symlink("../new.png", folder / "out/dangling.png");
  EXPECT_EQ(refusal(body() + "{\"do\": \"export\", \"path\": \"file.png\"}"), "script.path");
  EXPECT_EQ(refusal(body() + "{\"do\": \"export\", \"path\": \"dangling.png\"}"), "script.path");
  EXPECT_EQ(folder.read("kept.png"), "keep");
  EXPECT_FALSE(fs::exists(folder / "new.png"));
  fs::create_directory(folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / "out/s.files");
  EXPECT_EQ(refusal(body() + "{\"do\": \"save\", \"path\": \"s.jsonl\"}"), "file.write");
  EXPECT_TRUE(fs::is_empty(folder / "elsewhere"));
  EXPECT_EQ(refusal(body() + "{\"do\": \"export.layer\", \"path\": \"layer.jpg\"}"), "image.no-alpha");
  EXPECT_EQ(refusal(body() + "{\"do\": \"export\", \"path\": \"deep/er/a.png\"}"), "accepted");
  EXPECT_TRUE(fs::exists(folder / "out/deep/er/a.png"));
}

TEST_F(Runner, stops_at_the_first_error_with_its_place_and_keeps_the_document) {
  std::string lines = body();
  for (int i = 6; i < 1000; ++i)
    lines += "{\"do\": \"layer.move\", \"by\": [1, 0]}\n";
  const auto done =
      run(lines + "{\"do\": \"layer.move\", \"layer\": \"L9\", \"by\": [1, 0]}\n{\"do\": \"layer.remove\"}\n");
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, "layer.unknown");
  EXPECT_EQ(done.error().where, (folder / "work.jsonl").string() + ":1000");
  ASSERT_EQ(session.document().layers.size(), 1u);
  EXPECT_EQ(session.document().layers[0].placement.dx, 994);
}

TEST_F(Runner, runs_nothing_of_a_script_with_a_broken_line) {
  EXPECT_EQ(refusal(body() + "{\"do\": \"export\", \"path\": \"a.png\"}\n{\"do\": \"exprt\"}"),
            "script.unknown-command");
  EXPECT_TRUE(session.document().empty());
  EXPECT_FALSE(fs::exists(folder / "out/a.png"));
}

TEST_F(Runner, exports_reports_and_expects) {
  const auto done =
      run(body() +
          "{\"do\": \"layer.move\", \"by\": [3, 4]}\n"
          "{\"do\": \"pin.add\", \"outline\": [80, 50], \"sketch\": [90, 45]}\n"
          "{\"do\": \"export\", \"path\": \"a.png\"}\n"
          "{\"do\": \"export\", \"path\": \"a16.png\", \"depth\": 16}\n"
          "{\"do\": \"export\", \"path\": \"a.jpg\"}\n"
          "{\"do\": \"export.layer\", \"path\": \"layer.png\"}\n"
          "{\"do\": \"report\", \"path\": \"r.json\"}\n"
          "{\"do\": \"expect\", \"layers\": 1, \"pins\": 1, \"history\": 6, \"modified\": true, \"image\": \"a.png\"}\n"
          "{\"do\": \"undo\", \"steps\": 2}\n{\"do\": \"redo\", \"steps\": 2}\n"
          "{\"do\": \"expect\", \"image\": \"a16.png\", \"max_difference\": 1}\n");
  ASSERT_TRUE(done.ok()) << to_string(done.error());
  EXPECT_EQ(done->written.size(), 5u);

  const auto report = nlohmann::json::parse(folder.read("out/r.json"));
  ASSERT_EQ(report["layers"].size(), 1u);
  EXPECT_EQ(report["layers"][0]["id"], "L1");
  EXPECT_EQ(report["layers"][0]["name"], "fish");
  EXPECT_EQ(report["layers"][0]["placement"]["offset"], nlohmann::json::array({3, 4}));
  EXPECT_EQ(report["layers"][0]["outline"].size(), 40u);
  EXPECT_EQ(report["layers"][0]["pins"][0]["id"], "P1");
  for (const char* metric : {"flipped_cells", "sigma_ratio_mean", "sigma_ratio_p95", "sigma_ratio_max", "area_spread",
                             "sketch_distance_mean", "sketch_distance_max", "energy", "iterations", "match_cost",
                             "vertices", "handles", "order_violations", "cpu_ms", "stages_ms"})
    EXPECT_TRUE(report["layers"][0]["metrics"].contains(metric)) << metric;
  EXPECT_EQ(report["history"],
            nlohmann::json::parse(R"(["Open target.png", "Add layer fish", "Outline", "Sketch", "Move 3, 4", "Pin"])"));
  EXPECT_EQ(report["cursor"], 5);
  for (const char* counter :
       {"meshings", "symbolic_factorizations", "numeric_factorizations", "matches", "mask_setups", "clone_solves"})
    EXPECT_GE(report["counters"][counter], 1) << counter;
}

TEST_F(Runner, an_expectation_that_fails_says_what_is_there) {
  const auto sentence = [&](const std::string& expect) {
    const auto done = run(body() + "{\"do\": \"expect\", " + expect + "}");
    EXPECT_FALSE(done.ok()) << expect;
    if (done.ok()) return std::string();
    EXPECT_EQ(done.error().code, "expect.failed") << expect;
    return done.error().sentence;
  };
  EXPECT_EQ(sentence("\"layers\": 2"), "\"layers\" is 1, not 2");
  EXPECT_EQ(sentence("\"pins\": 1"), "\"pins\" is 0, not 1");
  EXPECT_EQ(sentence("\"history\": 3"), "\"history\" is 4, not 3");
  EXPECT_EQ(sentence("\"modified\": false"), "\"modified\" is true");
  EXPECT_NE(sentence("\"image\": \"target.png\"").find("differs from target.png by up to"), std::string::npos);
}

TEST_F(Runner, a_saved_session_opens_as_it_was) {
  ASSERT_TRUE(run(body() +
                  "{\"do\": \"layer.add\", \"source\": \"source.png\"}\n"
                  "{\"do\": \"layer.add\", \"source\": \"@target\"}\n"
                  "{\"do\": \"undo\"}\n{\"do\": \"layer.select\", \"layer\": \"L1\"}\n{\"do\": \"layer.move\", \"by\": "
                  "[5, 5]}\n{\"do\": \"undo\"}\n"
                  "{\"do\": \"save\", \"path\": \"kept/work.jsonl\"}\n{\"do\": \"expect\", \"modified\": false}\n")
                  .ok());
  const Document saved = session.document();
  const Image picture = *session.composite();
  fs::remove(folder / "target.png");
  fs::remove(folder / "source.png");
  Session again;
  const auto opened = open_session(again, folder / "out/kept/work.jsonl", {});
  ASSERT_TRUE(opened.ok()) << to_string(opened.error());
  EXPECT_EQ(again.document(), saved);
  EXPECT_FALSE(again.history().modified());
  EXPECT_EQ(again.history().cursor(), session.history().cursor());
  EXPECT_TRUE(again.history().can_redo());
  EXPECT_EQ(*again.composite(), picture);
  std::size_t pictures = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out/kept/work.files"))
    pictures += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(pictures, 2u) << "each content once";
}

TEST_F(Runner, a_match_that_was_taken_is_taken_again) {
  const Points curve = testing::bar({55, 50}, 38, 18);
  DocumentNew begin;
  begin.target = loaded_ref("target.png", *load_image(folder / "target.png"));
  LiveSession live;
  live.want_alternatives(true);
  live.execute(begin);
  live.execute(LayerAdd{loaded_ref("source.png", *load_image(folder / "source.png")), "bar"});
  live.execute(RegionSet{{}, curve});
  live.execute(SketchSet{{}, curve});
  live.wait_until_idle();
  ASSERT_EQ(live.snapshot()->alternatives.size(), 2U) << "a bar and its half turn";
  live.execute(live.snapshot()->alternatives[1].take);
  const auto record = [&](Session& recorded, const Watch&) { return save_session(recorded, folder / "match.jsonl"); };
  live.run("Recording", record);
  live.wait_until_idle();

  Session again;
  const auto opened = open_session(again, folder / "match.jsonl", {});
  ASSERT_TRUE(opened.ok()) << to_string(opened.error());
  EXPECT_EQ(again.document(), live.snapshot()->document);
  EXPECT_EQ(again.history().entries().back().label, "Other match");
  const LayerId layer = again.document().layers.at(0).id;
  const auto solved = again.deformation(layer);
  ASSERT_TRUE(solved.ok());
  EXPECT_LT(distance((*solved)->outline[0], live.snapshot()->layers.at(0).deformation->outline[0]), 0.5);
  EXPECT_GT(distance((*solved)->outline[0], curve[0]), 40) << "turned";
}

TEST_F(Runner, what_is_no_session_is_not_opened_and_nothing_is_lost) {
  ASSERT_TRUE(run(body()).ok());
  const Document before = session.document();
  folder.write(
      "out/export.jsonl",
      kHeader + "{\"do\": \"document.new\", \"width\": 9, \"height\": 9}\n{\"do\": \"export\", \"path\": \"x.png\"}\n");
  EXPECT_EQ(open_session(session, folder / "out/export.jsonl", {}).error().code, "open.not-a-session");
  folder.write("out/empty.jsonl", kHeader);
  EXPECT_EQ(open_session(session, folder / "out/empty.jsonl", {}).error().code, "open.not-a-session");
  EXPECT_EQ(session.document(), before);
}

} // namespace
} // namespace oversketch
