#include "core/clone/domain_tables.h"

#include "core/clone/domain.h"
#include "core/clone/live_rows.h"

#include <algorithm>

namespace oversketch {
namespace {

constexpr int kSteps = 1 << 16;

double value_in(Domain domain, double encoded) {
  return to_domain({static_cast<float>(encoded), 0, 0, 1}, domain).v[0];
}

} // namespace

DomainTables::DomainTables(Domain domain) : to_(1 << 16), from_(kSteps + 1) {
  for (int i = 0; i < 1 << 16; ++i) {
    const double units = static_cast<std::int16_t>(static_cast<std::uint16_t>(i)) - 32;
    to_[static_cast<std::size_t>(i)] = static_cast<float>(value_in(domain, units / LivePixel::kOpaque));
  }
  const double low = value_in(domain, -0.25), step = (value_in(domain, 1.5) - low) / kSteps;
  for (int i = 0; i <= kSteps; ++i)
    from_[static_cast<std::size_t>(i)] =
        static_cast<float>(oversketch::from_domain({{low + step * i, 0, 0, 0}}, domain).v[0]);
  low_ = static_cast<float>(low);
  per_unit_ = static_cast<float>(1 / step);
}

float DomainTables::from_domain(float value) const {
  const float at = std::clamp((value - low_) * per_unit_, 0.0F, static_cast<float>(kSteps - 1));
  const int i = static_cast<int>(at);
  const float part = at - static_cast<float>(i);
  const float *here = from_.data() + i, *next = here + 1;
  return *here + part * (*next - *here);
}

} // namespace oversketch
