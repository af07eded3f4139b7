#pragma once

#include "core/clone/blend.h"
#include "core/clone/channels.h"
#include "core/clone/domain.h"
#include "core/image/warped_region.h"

#include <algorithm>
#include <cstdint>

namespace oversketch {

/// Source and target, read pixel by pixel where the source lies: coordinates are the mask's, the target is shifted by
/// whole pixels and extended by its edge pixels.
///
/// Transparency: where a pixel of either picture lets through, nothing needs matching there.  With alphas a of the
/// source and b of the target the pair that is blended is
///   g' = a g + (1 − a) f*   and   f*' = g' + a b (f* − g),
/// which is (g, f*) where both are opaque, and has no difference where one of them is not there at all.
class PlacedPair {
public:
  /// What blending sees of one pixel, in the domain's values.
  struct Values {
    Channels source;
    Channels target;
  };

  /// All must outlive the reader; `target` has pixels; what is read of the source lies in its rect.
  PlacedPair(const Raster<Rgba>& target, const WarpedRegion& source, int dx, int dy, const BlendOptions& options)
      : target_(target),
        source_(source),
        dx_(dx),
        dy_(dy),
        domain_(options.domain),
        monochrome_(options.mode == BlendMode::kMonochrome) {}

  const Rgba& source_pixel(int x, int y) const { return source_.pixels.at(x - source_.rect.x, y - source_.rect.y); }
  const Rgba& target_pixel(int x, int y) const { return target_.at(target_x(x), target_y(y)); }
  /// Which pixel of the target is read.
  int target_x(int x) const { return clamp_to(x, dx_, target_.width()); }
  int target_y(int y) const { return clamp_to(y, dy_, target_.height()); }

  /// Whether opaque pixels are blended as they are.
  bool is_plain() const { return domain_ == Domain::kEncoded && !monochrome_; }

  /// The source's colour as it is blended: in the domain, grey in mode monochrome.
  Channels source_values(const Rgba& pixel) const { return values_of(pixel, domain_, monochrome_); }

  static Channels values_of(const Rgba& pixel, Domain domain, bool monochrome) {
    const Channels values = to_domain(pixel, domain);
    if (!monochrome) return values;
    // Rec. 709 luminance weights, on the domain's values.
    const double grey = 0.2126 * values.v[0] + 0.7152 * values.v[1] + 0.0722 * values.v[2];
    return {{grey, grey, grey, 0}};
  }

  Values at(int x, int y) const { return pair_of(source_pixel(x, y), target_pixel(x, y), domain_, monochrome_); }

  static Values pair_of(const Rgba& s, const Rgba& t, Domain domain, bool monochrome) {
    Values out{values_of(s, domain, monochrome), to_domain(t, domain)};
    if (s.a == 1 && t.a == 1) return out;
    const double a = s.a, b = t.a;
    const Channels difference = out.target - out.source;
    out.source += (1 - a) * difference;
    out.target = out.source + (a * b) * difference;
    return out;
  }

  Channels difference(int x, int y) const {
    const Values values = at(x, y);
    return values.target - values.source;
  }

private:
  static int clamp_to(int x, int shift, int size) {
    return static_cast<int>(std::clamp<std::int64_t>(static_cast<std::int64_t>(x) + shift, 0, size - 1));
  }

  const Raster<Rgba>& target_;
  const WarpedRegion& source_;
  int dx_;
  int dy_;
  Domain domain_;
  bool monochrome_;
};

} // namespace oversketch
