#pragma once

#include <stdexcept>

namespace oversketch {

/// A bug of ours, found by CHECK.  Caught only at `main`, at the worker's entry and at the wrapper around a library.
class BugError : public std::logic_error {
public:
  using std::logic_error::logic_error;
};

[[noreturn]] void fail_check(const char* condition, const char* why, const char* file, int line);

} // namespace oversketch

/// Stops with a BugError when `condition` does not hold; on in release builds too.  For bugs only: what correct use can
/// bring about is a Result.
#define CHECK(condition, why)                                                                                          \
  do {                                                                                                                 \
    if (!(condition)) [[unlikely]]                                                                                     \
      ::oversketch::fail_check(#condition, why, __FILE__, __LINE__);                                                   \
  } while (false)
