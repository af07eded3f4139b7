#pragma once

// Reading, printing and describing the types that fields have; see record.h.

#include "core/document/command_table.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <string>

namespace oversketch {

using Json = nlohmann::ordered_json;

// read_value gives nothing when the value was read, else what it must be: "a number".
using Mismatch = std::optional<std::string>;

Mismatch read_value(const Json& json, double& value);
Mismatch read_value(const Json& json, int& value);
Mismatch read_value(const Json& json, bool& value);
Mismatch read_value(const Json& json, std::string& value);
Mismatch read_value(const Json& json, Point& value);
Mismatch read_value(const Json& json, Points& value);
Mismatch read_value(const Json& json, WholeOffset& value);
Mismatch read_value(const Json& json, Color& value);
Mismatch read_value(const Json& json, ImageRef& value);
Mismatch read_value(const Json& json, LayerId& value);
Mismatch read_value(const Json& json, PinId& value);
Mismatch read_value(const Json& json, DeformMethod& value);
Mismatch read_value(const Json& json, WarpSampling& value);
Mismatch read_value(const Json& json, CloneMode& value);
Mismatch read_value(const Json& json, CloneDomain& value);
Mismatch read_value(const Json& json, StrokeSide& value);

Json write_value(double value);
Json write_value(int value);
Json write_value(bool value);
Json write_value(const std::string& value);
Json write_value(Point value);
Json write_value(const Points& value);
Json write_value(WholeOffset value);
Json write_value(const Color& value);
Json write_value(const ImageRef& value);
Json write_value(LayerId value);
Json write_value(PinId value);
Json write_value(DeformMethod value);
Json write_value(WarpSampling value);
Json write_value(CloneMode value);
Json write_value(CloneDomain value);
Json write_value(StrokeSide value);

void describe_value(double value, FieldInfo& row);
void describe_value(int value, FieldInfo& row);
void describe_value(bool value, FieldInfo& row);
void describe_value(const std::string& value, FieldInfo& row);
void describe_value(Point value, FieldInfo& row);
void describe_value(const Points& value, FieldInfo& row);
void describe_value(WholeOffset value, FieldInfo& row);
void describe_value(const Color& value, FieldInfo& row);
void describe_value(const ImageRef& value, FieldInfo& row);
void describe_value(LayerId value, FieldInfo& row);
void describe_value(PinId value, FieldInfo& row);
void describe_value(DeformMethod value, FieldInfo& row);
void describe_value(WarpSampling value, FieldInfo& row);
void describe_value(CloneMode value, FieldInfo& row);
void describe_value(CloneDomain value, FieldInfo& row);
void describe_value(StrokeSide value, FieldInfo& row);

template <class T>
Mismatch read_value(const Json& json, std::optional<T>& value) {
  value.emplace();
  Mismatch wrong = read_value(json, *value);
  if (wrong) value.reset();
  return wrong;
}

template <class T>
void describe_value(const std::optional<T>&, FieldInfo& row) {
  describe_value(T{}, row);
}

bool within(double value, double low, double high);
bool within(int value, double low, double high);
bool within(Point value, double low, double high);
bool within(WholeOffset value, double low, double high);
bool within(const Color& value, double low, double high);
/// Everything without numbers of its own, and points of curves, which check_closed_curve holds.
template <class T>
bool within(const T&, double, double) {
  return true;
}
template <class T>
bool within(const std::optional<T>& value, double low, double high) {
  return !value || within(*value, low, high);
}

Error out_of_range(std::string_view field, std::string_view unit, double low, double high);

} // namespace oversketch
