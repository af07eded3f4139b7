#include "core/clone/blend.h"

#include "core/base/check.h"
#include "core/base/suggest.h"

#include <array>
#include <limits>
#include <string>

namespace oversketch {
namespace {

constexpr std::array<std::string_view, 5> kModes = {"import", "mixed", "monochrome", "average", "none"};
constexpr std::array<std::string_view, 3> kDomains = {"encoded", "linear", "log"};

template <class Enum, std::size_t n>
std::string_view name_of(Enum value, const std::array<std::string_view, n>& names) {
  const auto index = static_cast<std::size_t>(value);
  CHECK(index < n, "enum value without a name");
  return names[index];
}

template <class Enum, std::size_t n>
Result<Enum> parse(std::string_view name, const std::array<std::string_view, n>& names, const char* code,
                   const char* what) {
  for (std::size_t i = 0; i < n; ++i)
    if (names[i] == name) return static_cast<Enum>(i);
  return Error{code, std::string("There is no ") + what + " \"" + std::string(name) + "\"" + did_you_mean(name, names),
               ""};
}

} // namespace

double screening_for(double reach_px) {
  return reach_px > 0 ? 1 / (reach_px * reach_px) : 0;
}

Result<void> check_options(const BlendOptions& options) {
  struct Range {
    const char* name;
    double value;
    double most;
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Range& range : {Range{"strength", options.strength, 1.0}, Range{"opacity", options.opacity, 1.0},
                             Range{"average", options.average, 1.0}, Range{"feather_px", options.feather_px, kInfinity},
                             Range{"screening", options.screening, kInfinity}}) {
    // Written so that not-a-number fails.
    if (range.value >= 0 && range.value <= range.most && range.value < kInfinity) continue;
    const std::string limits = range.most < kInfinity ? "from 0 to 1" : "0 or more";
    return Error{"clone.bad-option", std::string(range.name) + " must be a number " + limits + ".", range.name};
  }
  return {};
}

std::string_view to_string(BlendMode mode) {
  return name_of(mode, kModes);
}
std::string_view to_string(Domain domain) {
  return name_of(domain, kDomains);
}

Result<BlendMode> parse_blend_mode(std::string_view name) {
  return parse<BlendMode>(name, kModes, "clone.unknown-mode", "blend mode");
}

Result<Domain> parse_domain(std::string_view name) {
  return parse<Domain>(name, kDomains, "clone.unknown-domain", "blending domain");
}

} // namespace oversketch
