#include "core/document/command.h"

namespace oversketch {

Command::Command() noexcept = default;
Command::Command(const Command&) = default;
Command::Command(Command&&) noexcept = default;
Command& Command::operator=(const Command&) = default;
Command& Command::operator=(Command&&) noexcept = default;
Command::~Command() = default;

bool operator==(const Command& a, const Command& b) {
  return static_cast<const Command::variant&>(a) == static_cast<const Command::variant&>(b);
}

} // namespace oversketch
