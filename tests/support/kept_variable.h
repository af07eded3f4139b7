#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace oversketch::testing {

/// Whatever a test does to a variable of the environment, it is afterwards as it was.
class KeptVariable {
public:
  explicit KeptVariable(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) before_ = value;
  }
  ~KeptVariable() {
    if (before_)
      ::setenv(name_, before_->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  KeptVariable(const KeptVariable&) = delete;
  KeptVariable& operator=(const KeptVariable&) = delete;

private:
  const char* name_;
  std::optional<std::string> before_;
};

} // namespace oversketch::testing
