#pragma once

#include "core/clone/blend.h"
#include "core/clone/channels.h"
#include "core/image/image.h"

namespace oversketch {

/// Smallest encoded value that the log domain tells from 0: one 8-bit level.  Ratios of darker values are noise.
inline constexpr double kLogEpsilon = 1.0 / 255;

/// Red, green and blue as values of a domain.
///
/// encoded: as they are.  linear: the sRGB curve (IEC 61966-2-1), continued above 1 and mirrored below 0.  log:
/// sgn(x) ln(1 + |x|/ε), ε = kLogEpsilon, which is ln(x + ε) but for a constant where x ≥ 0, and mirrored below 0.
/// All are odd, increasing and invertible on every finite number.
Channels to_domain(const Rgba& pixel, Domain domain);

/// The inverse: encoded values (not clamped).
Channels from_domain(const Channels& values, Domain domain);

/// An upper bound on how much an error of 1 in the domain is in encoded values, for results no larger than `most`.
double largest_slope(Domain domain, double most);

} // namespace oversketch
