#include "core/session/case_file.h"

#include "core/base/file.h"
#include "core/base/suggest.h"
#include "core/document/field_values.h"
#include "core/document/json_line.h"
#include "core/geometry/curve.h"
#include "core/session/report.h"

#include <algorithm>
#include <string_view>

namespace oversketch {
namespace {

constexpr std::string_view kCaseKeys[] = {"name", "outline", "sketch", "truth", "pins"};

Result<Json> read_json(const std::filesystem::path& path) {
  const auto text = read_text_file(path);
  if (!text) return text.error();
  try {
    return Json::parse(*text);
  } catch (const Json::exception& problem) {
    return Error{"case.syntax", "not JSON: " + json_reason(problem).substr(0, 300), path.string()};
  }
}

/// Points under a key; `required` or left empty.
Result<Points> points_under(const Json& object, const char* key, bool required) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) {
    if (!required) return Points{};
    return Error{"case.missing-key", std::string("\"") + key + "\" is missing", ""};
  }
  Points points;
  if (auto wrong = read_value(*found, points))
    return Error{"case.type", std::string("\"") + key + "\" must be " + *wrong, ""};
  return points;
}

/// An outline that is simple as it stands; its points keep their number and order, so that results speak of the same
/// ones.
Result<Points> outline_of(const Json& object) {
  auto points = points_under(object, "outline", true);
  if (!points) return points;
  if (auto sound = check_closed_curve(*points, "outline"); !sound) return sound.error();
  return points;
}

Result<std::vector<PinPair>> read_pins(const Json& object) {
  std::vector<PinPair> pins;
  const auto list = object.find("pins");
  if (list == object.end() || list->is_null()) return pins;
  const Error wrong{"case.type", "\"pins\" must be a list of {\"outline\": [x, y], \"sketch\": [x, y]}", ""};
  if (!list->is_array()) return wrong;
  for (const Json& item : *list) {
    PinPair pin;
    if (!item.is_object() || !item.contains("outline") || !item.contains("sketch")) return wrong;
    if (read_value(item["outline"], pin.outline) || read_value(item["sketch"], pin.sketch)) return wrong;
    pins.push_back(pin);
  }
  return pins;
}

/// A misspelt "truth" or "pins" would silently be none.
Result<void> check_keys(const Json& object, std::span<const std::string_view> known) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string lower = key;
    for (char& c : lower)
      c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (const std::string hint = did_you_mean(lower, known); !hint.empty())
      return Error{"case.unknown-key", "there is no key \"" + key + "\"" + hint, ""};
  }
  return {};
}

Result<DeformCase> case_from(const Json& object) {
  if (!object.is_object()) return Error{"case.type", "a case is an object {\"outline\": …, \"sketch\": …}", ""};
  if (auto sound = check_keys(object, kCaseKeys); !sound) return sound.error();
  DeformCase given;
  if (const auto name = object.find("name"); name != object.end() && name->is_string())
    given.name = name->get<std::string>();
  auto outline = outline_of(object);
  if (!outline) return outline.error();
  auto sketch = points_under(object, "sketch", true);
  if (!sketch) return sketch.error();
  auto truth = points_under(object, "truth", false);
  if (!truth) return truth.error();
  if (!truth->empty() && truth->size() != outline->size())
    return Error{"case.truth",
                 "\"truth\" has " + std::to_string(truth->size()) + " points, \"outline\" " +
                     std::to_string(outline->size()),
                 ""};
  auto pins = read_pins(object);
  if (!pins) return pins.error();
  given.outline = std::move(*outline);
  given.sketch = std::move(*sketch);
  given.truth = std::move(*truth);
  given.pins = std::move(*pins);
  return given;
}

Json places_json(const DeformedCase& solved) {
  Json json;
  json["positions"] = write_value(solved.deformation.outline);
  json["correspondence"] = solved.deformation.correspondence;
  return json;
}

Json grid_json(const Deformation& deformation) {
  Json grid;
  grid["source"] = write_value(deformation.mesh->vertices);
  grid["deformed"] = write_value(deformation.positions);
  grid["cells"] = deformation.mesh->cells;
  return grid;
}

DeformedCase measured(const DeformCase& given, Deformation deformation) {
  Metrics metrics = measure(deformation, ClosedCurve(given.sketch), given.truth);
  return {std::move(deformation), std::move(metrics)};
}

} // namespace

Result<DeformCase> read_case(const std::filesystem::path& path) {
  const auto object = read_json(path);
  if (!object) return object.error();
  auto given = case_from(*object);
  if (!given) return at(path.string(), given.error());
  if (given->name.empty()) given->name = path.stem().string();
  return given;
}

Result<Points> read_points(const std::filesystem::path& path, const std::vector<std::string>& keys) {
  const auto json = read_json(path);
  if (!json) return json.error();
  Points points;
  if (json->is_object()) {
    for (const std::string& key : keys)
      if (json->contains(key)) {
        auto found = points_under(*json, key.c_str(), true);
        return found ? found : at(path.string(), found.error());
      }
    return Error{"case.missing-key", "\"" + keys.front() + "\" is missing", path.string()};
  }
  if (auto wrong = read_value(*json, points)) return Error{"case.type", "the file must hold " + *wrong, path.string()};
  return points;
}

Result<DeformedCase> solve_case(const DeformCase& given, const DeformOptions& options, const Watch& watch) {
  DeformCounts counts;
  const auto system = DeformSystem::make(given.outline, options, nullptr, counts, watch);
  if (!system) return system.error();
  auto deformation = system->deform(given.sketch, given.pins, options, nullptr, counts, watch);
  if (!deformation) return deformation.error();
  return measured(given, std::move(*deformation));
}

Result<std::vector<DeformedCase>> solve_case_alternatives(const DeformCase& given, const DeformOptions& options,
                                                          int count, const Watch& watch) {
  CHECK(count >= 1, "there is at least the best match");
  DeformCounts counts;
  const auto system = DeformSystem::make(given.outline, options, nullptr, counts, watch);
  if (!system) return system.error();
  auto deformations = system->alternatives(given.sketch, given.pins, options, count, counts, watch);
  if (!deformations) return deformations.error();
  std::vector<DeformedCase> solved;
  for (Deformation& deformation : *deformations)
    solved.push_back(measured(given, std::move(deformation)));
  return solved;
}

Json result_json(std::span<const DeformedCase> solved, bool with_alternatives) {
  CHECK(!solved.empty(), "a result to print");
  const DeformedCase& best = solved.front();
  Json json = places_json(best);
  json["grid"] = grid_json(best.deformation);
  json["metrics"] = metrics_json(best.metrics);
  if (!with_alternatives) return json;
  json["alternatives"] = Json::array();
  for (const DeformedCase& other : solved.subspan(1)) {
    Json alternative = places_json(other);
    alternative["metrics"] = metrics_json(other.metrics);
    alternative["match_cost"] = alternative["metrics"]["match_cost"];
    json["alternatives"].push_back(std::move(alternative));
  }
  return json;
}

} // namespace oversketch
