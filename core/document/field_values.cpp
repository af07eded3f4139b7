#include "core/document/field_values.h"

#include "core/base/suggest.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <span>
#include <utility>

namespace oversketch {
namespace {

template <class E>
using Names = std::span<const std::pair<E, std::string_view>>;

Names<DeformMethod> names_of(DeformMethod) {
  static constexpr std::pair<DeformMethod, std::string_view> names[] = {
      {DeformMethod::kFlipfree, "flipfree"}, {DeformMethod::kPaper, "paper"}, {DeformMethod::kInitial, "initial"}};
  return names;
}

Names<WarpSampling> names_of(WarpSampling) {
  static constexpr std::pair<WarpSampling, std::string_view> names[] = {{WarpSampling::kBilinear, "bilinear"},
                                                                        {WarpSampling::kBicubic, "bicubic"}};
  return names;
}

Names<CloneMode> names_of(CloneMode) {
  static constexpr std::pair<CloneMode, std::string_view> names[] = {{CloneMode::kImport, "import"},
                                                                     {CloneMode::kMixed, "mixed"},
                                                                     {CloneMode::kMonochrome, "monochrome"},
                                                                     {CloneMode::kAverage, "average"},
                                                                     {CloneMode::kNone, "none"}};
  return names;
}

Names<CloneDomain> names_of(CloneDomain) {
  static constexpr std::pair<CloneDomain, std::string_view> names[] = {
      {CloneDomain::kEncoded, "encoded"}, {CloneDomain::kLinear, "linear"}, {CloneDomain::kLog, "log"}};
  return names;
}

Names<StrokeSide> names_of(StrokeSide) {
  static constexpr std::pair<StrokeSide, std::string_view> names[] = {{StrokeSide::kAuto, "auto"},
                                                                      {StrokeSide::kOther, "other"}};
  return names;
}

template <class E>
std::vector<std::string_view> words_of(E) {
  std::vector<std::string_view> words;
  for (const auto& [value, word] : names_of(E{}))
    words.push_back(word);
  return words;
}

template <class E>
Mismatch read_word(const Json& json, E& value) {
  std::string expected = "one of";
  for (const std::string_view word : words_of(E{}))
    expected += (expected.size() > 6 ? ", " : " ") + std::string(word);
  if (!json.is_string()) return expected;
  const auto& text = json.get_ref<const std::string&>();
  for (const auto& [candidate, word] : names_of(E{}))
    if (word == text) return value = candidate, std::nullopt;
  return expected + ", not \"" + text.substr(0, 40) + "\"" + did_you_mean(text, words_of(E{}));
}

template <class E>
Json write_word(E value) {
  for (const auto& [candidate, word] : names_of(E{}))
    if (candidate == value) return std::string(word);
  CHECK(false, "a choice without a word");
  return {};
}

template <class Id>
Mismatch read_id(const Json& json, char letter, Id& value) {
  const std::string expected = std::string("an id such as \"") + letter + "1\"";
  if (!json.is_string()) return expected;
  const auto& text = json.get_ref<const std::string&>();
  if (text.size() < 2 || text[0] != letter || text[1] == '0') return expected;
  const auto [end, failure] = std::from_chars(text.data() + 1, text.data() + text.size(), value.number);
  if (failure != std::errc() || end != text.data() + text.size() || value.number < 1) return expected;
  return std::nullopt;
}

} // namespace

Mismatch read_value(const Json& json, double& value) {
  if (!json.is_number()) return "a number";
  value = json.get<double>();
  return std::nullopt;
}

Mismatch read_value(const Json& json, int& value) {
  if (!json.is_number()) return "a whole number";
  const double number = json.get<double>();
  if (number != std::floor(number) || std::abs(number) > std::numeric_limits<int>::max()) return "a whole number";
  value = static_cast<int>(number);
  return std::nullopt;
}

Mismatch read_value(const Json& json, bool& value) {
  if (!json.is_boolean()) return "true or false";
  value = json.get<bool>();
  return std::nullopt;
}

Mismatch read_value(const Json& json, std::string& value) {
  if (!json.is_string()) return "a text";
  value = json.get<std::string>();
  return std::nullopt;
}

Mismatch read_value(const Json& json, Point& value) {
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) return "a point [x, y]";
  value = {json[0].get<double>(), json[1].get<double>()};
  return std::nullopt;
}

Mismatch read_value(const Json& json, Points& value) {
  if (!json.is_array()) return "a list of points [[x, y], …]";
  value.clear();
  value.reserve(json.size());
  for (const Json& item : json)
    if (auto wrong = read_value(item, value.emplace_back()))
      return "a list of points [[x, y], …]; number " + std::to_string(value.size() - 1) + " (from 0) is none";
  return std::nullopt;
}

Mismatch read_value(const Json& json, WholeOffset& value) {
  if (!json.is_array() || json.size() != 2 || read_value(json[0], value.x) || read_value(json[1], value.y))
    return "two whole numbers [dx, dy]";
  return std::nullopt;
}

Mismatch read_value(const Json& json, Color& value) {
  const std::string expected = "a colour: \"#rrggbb\", or [red, green, blue] with 0…255 each";
  if (json.is_array() && json.size() == 3) {
    for (std::size_t i = 0; i < 3; ++i)
      if (read_value(json[i], value.rgb[i])) return expected;
    return std::nullopt;
  }
  if (!json.is_string()) return expected;
  const auto& text = json.get_ref<const std::string&>();
  if (text.size() != 7 || text[0] != '#') return expected;
  for (std::size_t i = 0; i < 3; ++i) {
    unsigned level = 0;
    const char* first = text.data() + 1 + 2 * i;
    if (std::from_chars(first, first + 2, level, 16).ptr != first + 2) return expected;
    value.rgb[i] = level;
  }
  return std::nullopt;
}

Mismatch read_value(const Json& json, ImageRef& value) {
  if (!json.is_string() || json.get_ref<const std::string&>().empty()) return "a picture's path";
  value = {json.get<std::string>(), std::nullopt};
  return std::nullopt;
}

Mismatch read_value(const Json& json, LayerId& value) {
  return read_id(json, 'L', value);
}
Mismatch read_value(const Json& json, PinId& value) {
  return read_id(json, 'P', value);
}
Mismatch read_value(const Json& json, DeformMethod& value) {
  return read_word(json, value);
}
Mismatch read_value(const Json& json, WarpSampling& value) {
  return read_word(json, value);
}
Mismatch read_value(const Json& json, CloneMode& value) {
  return read_word(json, value);
}
Mismatch read_value(const Json& json, CloneDomain& value) {
  return read_word(json, value);
}
Mismatch read_value(const Json& json, StrokeSide& value) {
  return read_word(json, value);
}

Json write_value(double value) {
  // Whole numbers are printed as such: 40, not 40.0.  -0 and huge values keep their own form.
  constexpr double kWhole = 1LL << 53;
  if (value == std::floor(value) && std::abs(value) < kWhole && !(value == 0 && std::signbit(value)))
    return static_cast<long long>(value);
  return value;
}
Json write_value(int value) {
  return value;
}
Json write_value(bool value) {
  return value;
}
Json write_value(const std::string& value) {
  return value;
}
Json write_value(Point value) {
  return Json::array({write_value(value.x), write_value(value.y)});
}
Json write_value(const Points& value) {
  Json list = Json::array();
  for (const Point p : value)
    list.push_back(write_value(p));
  return list;
}
Json write_value(WholeOffset value) {
  return Json::array({value.x, value.y});
}
Json write_value(const Color& value) {
  return Json::array({write_value(value.rgb[0]), write_value(value.rgb[1]), write_value(value.rgb[2])});
}
Json write_value(const ImageRef& value) {
  return value.name;
}
Json write_value(LayerId value) {
  return to_string(value);
}
Json write_value(PinId value) {
  return to_string(value);
}
Json write_value(DeformMethod value) {
  return write_word(value);
}
Json write_value(WarpSampling value) {
  return write_word(value);
}
Json write_value(CloneMode value) {
  return write_word(value);
}
Json write_value(CloneDomain value) {
  return write_word(value);
}
Json write_value(StrokeSide value) {
  return write_word(value);
}

void describe_value(double, FieldInfo& row) {
  row.type = "number";
}
void describe_value(int, FieldInfo& row) {
  row.type = "whole number";
}
void describe_value(bool, FieldInfo& row) {
  row.type = "true or false";
}
void describe_value(const std::string&, FieldInfo& row) {
  row.type = "text";
}
void describe_value(Point, FieldInfo& row) {
  row.type = "point [x, y]";
}
void describe_value(const Points&, FieldInfo& row) {
  row.type = "points [[x, y], …]";
}
void describe_value(WholeOffset, FieldInfo& row) {
  row.type = "whole numbers [dx, dy]";
}
void describe_value(const Color&, FieldInfo& row) {
  row.type = "colour \"#rrggbb\" or [red, green, blue]";
}
void describe_value(const ImageRef&, FieldInfo& row) {
  row.type = "picture";
}
void describe_value(LayerId, FieldInfo& row) {
  row.type = "layer id";
}
void describe_value(PinId, FieldInfo& row) {
  row.type = "pin id";
}
void describe_value(DeformMethod value, FieldInfo& row) {
  row.type = "choice", row.choices = words_of(value);
}
void describe_value(WarpSampling value, FieldInfo& row) {
  row.type = "choice", row.choices = words_of(value);
}
void describe_value(CloneMode value, FieldInfo& row) {
  row.type = "choice", row.choices = words_of(value);
}
void describe_value(CloneDomain value, FieldInfo& row) {
  row.type = "choice", row.choices = words_of(value);
}
void describe_value(StrokeSide value, FieldInfo& row) {
  row.type = "choice", row.choices = words_of(value);
}

bool within(double value, double low, double high) {
  return value >= low && value <= high && std::isfinite(value);
}
bool within(int value, double low, double high) {
  return value >= low && value <= high;
}
bool within(Point value, double low, double high) {
  return within(value.x, low, high) && within(value.y, low, high);
}
bool within(WholeOffset value, double low, double high) {
  return within(value.x, low, high) && within(value.y, low, high);
}
bool within(const Color& value, double low, double high) {
  return std::all_of(value.rgb.begin(), value.rgb.end(), [&](double level) { return within(level, low, high); });
}

Error out_of_range(std::string_view field, std::string_view unit, double low, double high) {
  const auto number = [](double x) { return write_value(x).dump(); };
  std::string range = std::isinf(low) && std::isinf(high) ? "finite"
                      : std::isinf(high)                  ? "at least " + number(low)
                      : std::isinf(low)                   ? "at most " + number(high)
                                                          : "from " + number(low) + " to " + number(high);
  if (!unit.empty()) range += " " + std::string(unit);
  return {"value.range", "\"" + std::string(field) + "\" must be " + range, ""};
}

} // namespace oversketch
