#include "core/base/result.h"

namespace oversketch {

std::string to_string(const Error& error) {
  std::string text = error.code;
  if (!error.where.empty()) text += ": " + error.where;
  return text + ": " + error.sentence;
}

Error at(std::string place, Error error) {
  error.where = error.where.empty() ? std::move(place) : place + ": " + error.where;
  return error;
}

} // namespace oversketch
