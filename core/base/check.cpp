#include "core/base/check.h"

#include <string>

namespace oversketch {

void fail_check(const char* condition, const char* why, const char* file, int line) {
  throw BugError(std::string(file) + ":" + std::to_string(line) + ": " + why + " (" + condition + ")");
}

} // namespace oversketch
