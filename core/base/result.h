#pragma once

#include "core/base/check.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace oversketch {

/// What went wrong in correct use: a bad file, a bad script line, a curve that crosses itself.
///
/// `code` is stable and made for programs ("image.truncated"), `sentence` is made for a person and says what to do
/// about it, `where` names the place ("fish.jsonl:12", "layer L1, outline point 7") and may be empty.
struct Error {
  std::string code;
  std::string sentence;
  std::string where;

  bool operator==(const Error&) const = default;
};

/// "code: where: sentence", the form that the command line prints.
std::string to_string(const Error& error);

/// The same error, found at `place`: the outer place is put before the inner one.
Error at(std::string place, Error error);

/// A value, or the Error that stands in its stead.  Reading the one that is not there is a bug (CHECK).
template <class T>
class [[nodiscard]] Result {
public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& { return *get(); }
  T& value() & { return *get(); }
  T&& value() && { return std::move(*get()); }
  const T& operator*() const& { return *get(); }
  T& operator*() & { return *get(); }
  T&& operator*() && { return std::move(*get()); }
  const T* operator->() const { return get(); }
  T* operator->() { return get(); }

  const Error& error() const {
    CHECK(!ok(), "error() of a Result that holds a value");
    return std::get<1>(state_);
  }

private:
  const T* get() const {
    CHECK(ok(), "value of a Result that holds an error");
    return &std::get<0>(state_);
  }
  T* get() {
    CHECK(ok(), "value of a Result that holds an error");
    return &std::get<0>(state_);
  }

  std::variant<T, Error> state_;
};

/// Success, or an Error.  `return {};` is success.
template <>
class [[nodiscard]] Result<void> {
public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  const Error& error() const {
    CHECK(error_.has_value(), "error() of a Result that succeeded");
    return *error_;
  }

private:
  std::optional<Error> error_;
};

} // namespace oversketch
