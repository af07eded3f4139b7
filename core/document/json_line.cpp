#include "core/document/json_line.h"

#include <set>

namespace oversketch {

namespace {

/// Deeper than any line of a script.
constexpr int kLineDepth = 16;

Error too_deep(int most_depth) {
  return {"json.too-deep", "values lie within values more than " + std::to_string(most_depth) + " deep", ""};
}

bool opens(Json::parse_event_t event) {
  return event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
}

} // namespace

Result<Json> parse_json(std::string_view text, int most_depth, std::size_t most_bytes) {
  bool deep = false;
  std::size_t bytes = 0;
  const auto watch_size = [&](int depth, Json::parse_event_t event, Json& parsed) {
    deep |= depth >= most_depth && opens(event);
    // Lists grow by doubling; a key stands in a pair.
    if (opens(event) || event == Json::parse_event_t::value) bytes += 3 * sizeof(Json);
    if (event == Json::parse_event_t::key) bytes += 6 * sizeof(Json);
    if (parsed.is_string()) bytes += parsed.get_ref<const std::string&>().size();
    return !deep && bytes <= most_bytes;
  };
  try {
    Json json = Json::parse(text, watch_size);
    if (deep) return too_deep(most_depth);
    if (bytes > most_bytes) return Error{"json.too-large", "its values need more memory than the program may take", ""};
    return json;
  } catch (const Json::exception& problem) {
    if (deep) return too_deep(most_depth);
    return Error{"script.syntax", "not JSON: " + json_reason(problem).substr(0, 300), ""};
  }
}

Result<Json> parse_json_line(std::string_view line) {
  std::set<std::string> keys;
  std::optional<std::string> repeated;
  bool deep = false;
  const auto watch_keys = [&](int depth, Json::parse_event_t event, Json& parsed) {
    deep |= depth >= kLineDepth && opens(event);
    if (deep) return false;
    if (event == Json::parse_event_t::key && depth == 1)
      if (!keys.insert(parsed.get<std::string>()).second) repeated = parsed.get<std::string>();
    return true;
  };
  Json object;
  try {
    object = Json::parse(line, watch_keys);
  } catch (const Json::exception& problem) {
    std::string reason = json_reason(problem);
    // A script's line is the place already.
    if (const auto first = reason.find("at line 1, "); first != std::string::npos)
      reason.erase(first, 11).insert(first, "at ");
    return Error{"script.syntax", "not JSON: " + reason.substr(0, 300), ""};
  }
  if (deep) return too_deep(kLineDepth);
  if (!object.is_object()) return Error{"script.not-an-object", "a line must be an object {…}", ""};
  if (repeated) return Error{"script.repeated-key", "\"" + *repeated + "\" stands there twice", ""};
  return object;
}

std::string json_reason(const Json::exception& problem) {
  // The library's text is "[json.exception.…] parse error at line 1, column 17: …".
  std::string reason = problem.what();
  if (const auto end = reason.find("] "); end != std::string::npos) reason.erase(0, end + 2);
  return reason;
}

std::string print_json_line(const Json& object) {
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<std::string> read_do(const Json& object) {
  const auto found = object.find("do");
  if (found == object.end() || !found->is_string())
    return Error{"script.no-do", "a line needs \"do\" with a command's name", ""};
  return found->get<std::string>();
}

} // namespace oversketch
