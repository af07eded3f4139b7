#pragma once

// How plain structs of fields are read from JSON, printed, held against their ranges and described: one row a field,
// from which everything else follows.  Included by the few sources that read or print; not part of the public face.

#include "core/base/result.h"
#include "core/base/suggest.h"
#include "core/document/command_table.h"
#include "core/document/field_values.h"

#include <nlohmann/json.hpp>

#include <string>
#include <tuple>
#include <type_traits>

namespace oversketch {

using Json = nlohmann::ordered_json;

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

/// One field of a struct C.
template <class C, class T>
struct Field {
  std::string_view name;
  T C::*member;
  std::string_view help;
  std::string_view unit = "";
  double low = -HUGE_VAL;
  double high = HUGE_VAL;
  /// May be left out though its type is no optional: then it has the value of a default-made C.
  bool may_be_absent = false;

  bool required() const { return !kIsOptional<T> && !may_be_absent; }
};

/// Clang deduces nothing for an aggregate by itself before version 17.
template <class C, class T, class... More>
Field(std::string_view, T C::*, std::string_view, More...) -> Field<C, T>;

/// Specialised for each struct: `name`, `label`, `help`, and `fields()`, a tuple of Field.
template <class C>
struct Spec;

template <class C, class Visit>
void for_each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Spec<C>::fields());
}

template <class C>
std::vector<std::string_view> field_names() {
  std::vector<std::string_view> names;
  for_each_field<C>([&](const auto& field) { names.push_back(field.name); });
  return names;
}

template <class C>
Error unknown_key(const std::string& key) {
  const auto names = field_names<C>();
  return {"script.unknown-key",
          "\"" + std::string(Spec<C>::name) + "\" has no \"" + key + "\"" + did_you_mean(key, names), ""};
}

/// Reads a C from an object whose other keys (all but `skip`) must be fields of C.
template <class C>
Result<C> read_record(const Json& object, std::string_view skip) {
  C record{};
  const auto names = field_names<C>();
  for (const auto& [key, value] : object.items())
    if (key != skip && std::find(names.begin(), names.end(), key) == names.end()) return unknown_key<C>(key);
  std::optional<Error> problem;
  for_each_field<C>([&](const auto& field) {
    if (problem) return;
    const auto found = object.find(std::string(field.name));
    if (found == object.end()) {
      if (field.required())
        problem = Error{"script.missing-key",
                        "\"" + std::string(Spec<C>::name) + "\" needs \"" + std::string(field.name) + "\"", ""};
      return;
    }
    if (auto wrong = read_value(*found, record.*(field.member)))
      problem = Error{"script.type", "\"" + std::string(field.name) + "\" must be " + *wrong, ""};
  });
  if (problem) return *problem;
  return record;
}

/// The fields that are set, in the table's order.
template <class C>
void write_record(const C& record, Json& object) {
  const C untouched{};
  for_each_field<C>([&](const auto& field) {
    const auto& value = record.*(field.member);
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (kIsOptional<T>) {
      if (value) object[std::string(field.name)] = write_value(*value);
    } else if (!(field.may_be_absent && value == untouched.*(field.member))) {
      object[std::string(field.name)] = write_value(value);
    }
  });
}

/// @errors value.range, with the field and the range.
template <class C>
Result<void> check_ranges(const C& record) {
  std::optional<Error> problem;
  for_each_field<C>([&](const auto& field) {
    if (problem) return;
    if (!within(record.*(field.member), field.low, field.high))
      problem = out_of_range(field.name, field.unit, field.low, field.high);
  });
  if (problem) return *problem;
  return {};
}

template <class C>
CommandInfo describe_record() {
  CommandInfo info{Spec<C>::name, Spec<C>::label, Spec<C>::help, {}};
  const C untouched{};
  for_each_field<C>([&](const auto& field) {
    const auto& value = untouched.*(field.member);
    FieldInfo row;
    row.name = field.name;
    row.help = field.help;
    row.unit = field.unit;
    row.required = field.required();
    row.low = field.low;
    row.high = field.high;
    describe_value(value, row);
    if constexpr (!kIsOptional<std::remove_cvref_t<decltype(value)>>)
      if (field.may_be_absent) row.default_value = write_value(value).dump();
    info.fields.push_back(std::move(row));
  });
  return info;
}

} // namespace oversketch
