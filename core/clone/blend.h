#pragma once

#include "core/base/result.h"

#include <string_view>

namespace oversketch {

/// What the blending keeps of the source g and the target f*.  Names: import, mixed, monochrome, average, none.
enum class BlendMode {
  kImport,     ///< the source's gradients (Pérez, Gangnet, Blake 2003, eq. 9)
  kMixed,      ///< at each pair of neighbours the stronger of the two differences (eq. 12, jointly over the channels)
  kMonochrome, ///< import of the source's luminance; a source in colour changes even a target that equals it
  kAverage,    ///< the weighted mean of both gradients
  kNone,       ///< plain paste
};

/// The values that are blended.  Names: encoded, linear, log.
enum class Domain {
  kEncoded, ///< sRGB values as stored
  kLinear,  ///< linear light
  kLog,     ///< ratios of encoded values, for a source lit differently
};

/// How a region is blended in.
struct BlendOptions {
  BlendMode mode = BlendMode::kImport;
  /// How much of the correction u = f − g is applied inside, 0…1: 1 is the exact solution, 0 leaves the source's own
  /// colours.  See feather_px for the edge.
  double strength = 1;
  Domain domain = Domain::kEncoded;
  /// ≥ 0.  With strength < 1 the correction falls from full at the edge to `strength` this far inside, so that no seam
  /// shows; at 0 the seam of a partial correction stays.  Nothing changes at strength 1.  In mode none the paste fades
  /// in over this width instead.
  double feather_px = 0;
  /// 0…1: weight of the result against the target below.
  double opacity = 1;
  /// λ ≥ 0, per px²: u solves Δu − λ u = … in place of Δu = ….  The correction dies away over about 1/√λ px from the
  /// edge, so that a colour that bleeds in at one place does not tint the whole region; in exchange f does not keep g's
  /// gradients exactly any more: ∇(f − g) = ∇u is larger near the edge, where u falls to 0 in 1/√λ px in place of a
  /// slow passage from edge to edge.  0: the exact equation.  See screening_for().
  double screening = 0;
  /// kAverage: weight of the source's gradients, 0…1.
  double average = 0.5;

  bool operator==(const BlendOptions&) const = default;
};

/// λ of a correction that dies away over `reach_px` px (by a factor of e along a straight edge); 0 for reach 0, which
/// stands for no screening.
double screening_for(double reach_px);

/// @errors clone.bad-option: a number outside its range or not a number; `where` is its name.
Result<void> check_options(const BlendOptions& options);

std::string_view to_string(BlendMode mode);
std::string_view to_string(Domain domain);

/// The inverse of to_string.
/// @errors clone.unknown-mode, clone.unknown-domain, with the nearest name.
Result<BlendMode> parse_blend_mode(std::string_view name);
Result<Domain> parse_domain(std::string_view name);

} // namespace oversketch
