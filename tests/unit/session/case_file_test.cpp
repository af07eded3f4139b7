#include "core/session/case_file.h"

#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oversketch {
namespace {

using namespace testing;
using Json = nlohmann::ordered_json;

const char* const kSquare = "[[0, 0], [90, 0], [90, 90], [0, 90]]";

std::string case_refusal(const std::string& text) {
  const TempFolder folder;
  folder.write("case.json", text);
  const auto given = read_case(folder / "case.json");
  if (given) return "taken";
  EXPECT_TRUE(given.error().where.starts_with((folder / "case.json").string())) << to_string(given.error());
  EXPECT_FALSE(given.error().sentence.empty());
  return given.error().code;
}

std::string with(const std::string& outline, const std::string& sketch, const std::string& more = "") {
  return R"({"outline": )" + outline + R"(, "sketch": )" + sketch + more + "}";
}

/// No symmetry, so that there is one best match.
Points lopsided(Point centre, double size) {
  Points points;
  for (int i = 0; i < 72; ++i) {
    const double t = 2 * std::numbers::pi * i / 72;
    const double r = size * (1 + 0.25 * std::cos(t) + 0.2 * std::sin(2 * t + 0.4) + 0.12 * std::cos(3 * t));
    points.push_back(centre + r * Point{std::cos(t), 0.7 * std::sin(t)});
  }
  return points;
}

Points bent(Points points) {
  for (Point& p : points)
    p = {p.x + 0.0016 * p.y * p.y, 1.1 * p.y + 20 * std::sin(p.x / 70)};
  return points;
}

Points reversed(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}

DeformedCase solved(const DeformCase& given, Method method = Method::kFlipfree) {
  DeformOptions options;
  options.method = method;
  auto result = solve_case(given, options, {});
  EXPECT_TRUE(result.ok()) << to_string(result.error());
  return std::move(*result);
}

double largest_distance(const Points& a, const Points& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, distance(a[i], b[i]));
  return most;
}

TEST(CaseFile, refuses_what_is_no_case) {
  for (const char* text : {"", "{", "{\"outline\": [[0, 0]", "[NaN]", "{\"outline\": [[0, 1e999]]}"})
    EXPECT_EQ(case_refusal(text), "case.syntax") << text;
  for (const char* text : {"[]", "3", "null", "\"outline\""})
    EXPECT_EQ(case_refusal(text), "case.type") << text;
  EXPECT_EQ(case_refusal("{}"), "case.missing-key");
  EXPECT_EQ(case_refusal(std::string(R"({"outline": )") + kSquare + "}"), "case.missing-key");
  EXPECT_EQ(case_refusal(std::string(R"({"sketch": )") + kSquare + "}"), "case.missing-key");
  EXPECT_EQ(case_refusal(with("null", kSquare)), "case.missing-key");
  for (const char* wrong : {"3", "{}", "[1, 2]", "[[1]]", "[[1, 2, 3]]", R"([[1, "2"]])", R"("none")", "[[1, null]]"}) {
    EXPECT_EQ(case_refusal(with(wrong, kSquare)), "case.type") << wrong;
    EXPECT_EQ(case_refusal(with(kSquare, wrong)), "case.type") << wrong;
    EXPECT_EQ(case_refusal(with(kSquare, kSquare, std::string(", \"truth\": ") + wrong)), "case.type") << wrong;
  }
  for (const char* wrong : {"{}", "[[1, 2]]", R"([{"outline": [1, 2]}])", R"([{"outline": [1], "sketch": [1, 2]}])",
                            R"([{"outline": [1, 2], "sketch": 3}])", "[3]", R"(["outline"])"})
    EXPECT_EQ(case_refusal(with(kSquare, kSquare, std::string(", \"pins\": ") + wrong)), "case.type") << wrong;
  EXPECT_EQ(case_refusal(with(kSquare, kSquare, R"(, "truth": [[1, 2], [3, 4]])")), "case.truth");
  for (const char* misspelt : {"pin", "Pins", "thruth", "sketches", "OUTLINE"})
    EXPECT_EQ(case_refusal(with(kSquare, kSquare, std::string(", \"") + misspelt + "\": []")), "case.unknown-key")
        << misspelt;
  EXPECT_EQ(case_refusal(with("[]", kSquare)), "curve.too-few-points");
  EXPECT_EQ(case_refusal(with("[[0, 0], [9, 9]]", kSquare)), "curve.too-few-points");
  EXPECT_EQ(case_refusal(with("[[0, 0], [9, 9], [18, 18]]", kSquare)), "curve.no-area");
  EXPECT_EQ(case_refusal(with("[[0, 0], [90, 90], [90, 0], [0, 80]]", kSquare)), "curve.crosses-itself");
  EXPECT_EQ(read_case("nowhere/case.json").error().code, "file.missing");
}

TEST(CaseFile, refuses_what_cannot_be_solved) {
  const Points outline = lopsided({0, 0}, 100);
  const auto code = [&](const Points& sketch, std::vector<PinPair> pins = {}, DeformOptions options = {}) {
    const auto result = solve_case({"", outline, sketch, {}, std::move(pins)}, options, {});
    const auto several = solve_case_alternatives({"", outline, sketch, {}, {}}, options, 3, {});
    if (!several) EXPECT_FALSE(result.ok());
    return result ? std::string("taken") : result.error().code;
  };
  EXPECT_EQ(code({}), "sketch.too-few-points");
  EXPECT_EQ(code({{0, 0}, {9, 9}}), "sketch.too-few-points");
  EXPECT_EQ(code({{0, 0}, {9, 9}, {NAN, 3}}), "sketch.not-finite");
  EXPECT_EQ(code({{0, 0}, {90, 90}, {90, 0}, {0, 90}}), "sketch.crosses-itself");
  const std::vector<PinPair> crossing = {
      {outline[0], outline[0]}, {outline[20], outline[50]}, {outline[50], outline[20]}};
  EXPECT_EQ(code(outline, crossing), "deform.pins-cross");
  DeformOptions large;
  large.cell_px = 1000;
  EXPECT_EQ(code(outline, {}, large), "mesh.cell-too-large");
  DeformOptions limp;
  limp.stiffness = 0;
  EXPECT_EQ(code(outline, {}, limp), "deform.stiffness");
  EXPECT_EQ(solve_case_alternatives({"", outline, outline, {}, crossing}, {}, 2, {}).error().code, "deform.pins-cross");
}

TEST(CaseFile, refuses_points_that_are_none) {
  const TempFolder folder;
  folder.write("list.json", kSquare);
  folder.write("object.json", std::string(R"({"curve": )") + kSquare + "}");
  folder.write("number.json", "3");
  EXPECT_EQ(read_points(folder / "number.json", {"sketch"}).error().code, "case.type");
  EXPECT_EQ(read_points(folder / "object.json", {"outline", "points"}).error().code, "case.missing-key");
  ASSERT_TRUE(read_points(folder / "list.json", {"sketch"}).ok());
  EXPECT_EQ(*read_points(folder / "list.json", {}), *read_points(folder / "object.json", {"sketch", "curve"}));
}

TEST(CaseFile, reads_all_that_a_case_has) {
  const TempFolder folder;
  folder.write("bar.json", with(kSquare, "[[-5, 1.5], [90, 0], [0, 90]]",
                                R"(, "truth": [[1, 2], [3, 4], [5, 6], [7, 8]],
                                     "pins": [{"outline": [0, 0], "sketch": [90, 0]}], "note": "of no matter", "kind": 3)"));
  const auto given = read_case(folder / "bar.json");
  ASSERT_TRUE(given.ok()) << to_string(given.error());
  EXPECT_EQ(given->name, "bar");
  EXPECT_EQ(given->outline, (Points{{0, 0}, {90, 0}, {90, 90}, {0, 90}}));
  EXPECT_EQ(given->sketch, (Points{{-5, 1.5}, {90, 0}, {0, 90}}));
  EXPECT_EQ(given->truth, (Points{{1, 2}, {3, 4}, {5, 6}, {7, 8}}));
  EXPECT_EQ(given->pins, (std::vector<PinPair>{{{0, 0}, {90, 0}}}));
}

TEST(CaseFile, sketch_may_run_and_start_anywhere) {
  const Points outline = lopsided({0, 0}, 100), sketch = bent(outline);
  const Points positions = solved({"", outline, sketch, {}, {}}).deformation.outline;
  Points restarted = sketch;
  std::rotate(restarted.begin(), restarted.begin() + 29, restarted.end());
  for (const Points& other : {reversed(sketch), restarted, reversed(restarted)})
    EXPECT_LT(largest_distance(solved({"", outline, other, {}, {}}).deformation.outline, positions), 1e-6 * 200);
}

TEST(CaseFile, correspondence_increases_whichever_way_the_curves_run) {
  const Points outline = lopsided({0, 0}, 100), sketch = bent(outline);
  for (const Method method : {Method::kFlipfree, Method::kInitial})
    for (const Points& from : {outline, reversed(outline)})
      for (const Points& to : {sketch, reversed(sketch)}) {
        const auto s = solved({"", from, to, {}, {}}, method).deformation.correspondence;
        ASSERT_EQ(s.size(), from.size());
        double turns = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
          EXPECT_GE(s[i], 0);
          EXPECT_LT(s[i], 1);
          const double step = s[(i + 1) % s.size()] - s[i];
          EXPECT_NE(step, 0);
          turns += step - std::floor(step);
        }
        EXPECT_NEAR(turns, 1, 1e-9);
      }
}

TEST(CaseFile, correspondence_says_where_on_the_sketch) {
  const Points outline = lopsided({0, 0}, 100), sketch = bent(outline);
  const ClosedCurve curve(sketch);
  const auto result = solved({"", outline, sketch, sketch, {}});
  for (std::size_t i = 0; i < outline.size(); ++i)
    EXPECT_LT(distance(curve.at(result.deformation.correspondence[i] * curve.length()), result.deformation.outline[i]),
              4);
  ASSERT_TRUE(result.metrics.truth_error.has_value());
  EXPECT_LT(*result.metrics.truth_error, 0.02);
}

TEST(CaseFile, similar_sketch_gives_the_similarity) {
  const Points outline = lopsided({0, 0}, 100);
  const Similarity map{std::polar(1.7, 0.6), {300, -120}};
  const auto result = solved({"", outline, transformed(outline, map), {}, {}});
  const Deformation& deformation = result.deformation;
  EXPECT_LT(largest_distance(deformation.outline, transformed(outline, map)), 1e-3 * 1.7 * deformation.mesh->cell);
  EXPECT_LT(largest_distance(deformation.positions, transformed(deformation.mesh->vertices, map)),
            1e-3 * 1.7 * deformation.mesh->cell);
  EXPECT_NEAR(result.metrics.distortion.sigma_ratio_max, 1, 1e-3);
}

Points ellipse(double a, double b) {
  Points points;
  for (int i = 0; i < 96; ++i) {
    const double t = 2 * std::numbers::pi * (i + 0.5) / 96;
    points.push_back({a * std::cos(t), b * std::sin(t)});
  }
  return points;
}

TEST(CaseFile, other_way_to_take_an_ellipse_is_its_half_turn) {
  const Points outline = ellipse(120, 60);
  const auto found = solve_case_alternatives({"", outline, outline, {}, {}}, {}, 2, {});
  ASSERT_TRUE(found.ok()) << to_string(found.error());
  ASSERT_EQ(found->size(), 2u);
  Points turned_round;
  for (const Point p : outline)
    turned_round.push_back(-p);
  EXPECT_LT(largest_distance((*found)[0].deformation.outline, outline), 0.5);
  EXPECT_LT(largest_distance((*found)[1].deformation.outline, turned_round), 0.5);
  EXPECT_LE(*(*found)[0].metrics.match_cost, *(*found)[1].metrics.match_cost);
  for (const DeformedCase& one : *found)
    EXPECT_EQ(one.metrics.distortion.flipped_cells, 0);
}

TEST(CaseFile, best_alternative_is_the_one_solution) {
  const Points outline = lopsided({0, 0}, 100);
  const DeformCase given{"", outline, bent(outline), {}, {}};
  const auto found = solve_case_alternatives(given, {}, 4, {});
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found->front().deformation.outline, solved(given).deformation.outline);
  EXPECT_EQ(solve_case_alternatives(given, {}, 1, {})->size(), 1u);
  DeformCase pinned = given;
  pinned.pins = {{outline[0], given.sketch[0]}};
  EXPECT_EQ(solve_case_alternatives(pinned, {}, 4, {})->size(), 1u);
  DeformOptions paper;
  paper.method = Method::kPaper;
  EXPECT_EQ(solve_case_alternatives(given, paper, 4, {})->size(), 1u);
}

TEST(CaseFile, prints_what_the_contract_names) {
  const Points outline = ellipse(120, 60);
  const auto found = solve_case_alternatives({"", outline, outline, {}, {}}, {}, 2, {});
  ASSERT_TRUE(found.ok());
  const Json plain = result_json(*found), more = result_json(*found, true);
  EXPECT_FALSE(plain.contains("alternatives"));
  for (const char* key : {"positions", "correspondence", "grid", "metrics"})
    EXPECT_EQ(plain[key], more[key]) << key;
  EXPECT_EQ(plain["positions"].size(), outline.size());
  EXPECT_EQ(plain["grid"]["source"].size(), plain["grid"]["deformed"].size());
  EXPECT_EQ(plain["grid"]["cells"][0].size(), 4u);
  ASSERT_EQ(more["alternatives"].size(), 1u);
  const Json& other = more["alternatives"][0];
  EXPECT_EQ(other["positions"][0][0], (*found)[1].deformation.outline[0].x);
  EXPECT_EQ(other["correspondence"].size(), outline.size());
  EXPECT_EQ(other["match_cost"], *(*found)[1].metrics.match_cost);
  EXPECT_EQ(other["metrics"]["match_cost"], other["match_cost"]);
  EXPECT_TRUE(result_json(std::span(*found).first(1), true)["alternatives"].empty());
  EXPECT_THROW(result_json({}), BugError);
}

} // namespace
} // namespace oversketch
