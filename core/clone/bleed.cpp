#include "core/clone/bleed.h"

#include "core/clone/placed_pair.h"
#include "core/geometry/curve.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

using Colour = std::array<float, 3>;

float length_of(const Colour& c) {
  return std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
}

/// Points of a closed curve at equal steps, each with the direction that leads outside.
struct Walker {
  const Points& outline;
  double sign;

  template <class Visit>
  void walk(int count, double step, Visit visit) const {
    double s = 0, begin = 0;
    int made = 0;
    for (std::size_t i = 0; i < outline.size() && made < count; ++i) {
      const Point from = outline[i], along = outline[(i + 1) % outline.size()] - from;
      const double length = std::hypot(along.x, along.y);
      for (; made < count && s < begin + length; s = ++made * step)
        visit(from + (s - begin) / length * along, s, sign / length * Point{along.y, -along.x});
      begin += length;
    }
  }
};

/// The difference on the ring, at a point of the edge.
class Ring {
public:
  Ring(const Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask, int dx, int dy)
      : pair_(target, source, dx, dy, {}), rect_(source.rect), mask_(mask) {}

  Colour at(Point p, Point outwards) const {
    // The pixel beyond the edge; where the edge is slanted that may still be one of the mask's, and the next is not.
    int x = 0, y = 0;
    for (const double reach : {0.5, 1.2}) {
      const Point q = p + reach * outwards;
      x = static_cast<int>(std::floor(q.x));
      y = static_cast<int>(std::floor(q.y));
      if (!mask_.contains(x, y)) break;
    }
    x = std::clamp(x, rect_.x, rect_.right() - 1);
    y = std::clamp(y, rect_.y, rect_.bottom() - 1);
    const Channels d = 255 * pair_.difference(x, y);
    return {static_cast<float>(d.v[0]), static_cast<float>(d.v[1]), static_cast<float>(d.v[2])};
  }

private:
  PlacedPair pair_;
  Rect rect_;
  const Mask& mask_;
};

/// Sums of `reach` samples before and after each, round the curve.
void find_jumps(std::vector<BleedSample>& samples, std::size_t reach) {
  const std::size_t n = samples.size();
  std::array<double, 3> before{}, after{};
  const auto add = [&](std::array<double, 3>& sum, std::size_t i, double sign) {
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += sign * static_cast<double>(samples[i % n].mismatch[k]);
  };
  for (std::size_t j = 1; j <= reach; ++j) {
    add(after, j, 1);
    add(before, n - j, 1);
  }
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += (after[k] - before[k]) * (after[k] - before[k]);
    samples[i].jump = static_cast<float>(std::sqrt(sum) / static_cast<double>(reach));
    add(before, i, 1);
    add(before, i + n - reach, -1);
    add(after, i + 1, -1);
    add(after, i + 1 + reach, 1);
  }
}

} // namespace

BleedForecast forecast_bleed(const Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask, int dx, int dy,
                             const Points& outline) {
  BleedForecast out;
  const double length = outline.size() < 2 ? 0 : perimeter(outline);
  if (!(length > 0) || !std::isfinite(length) || target.empty() || source.rect.empty()) return out;
  const int count = std::max(1, static_cast<int>(std::lround(length)));
  out.samples.reserve(static_cast<std::size_t>(count));
  const Ring ring(target, source, mask, dx, dy);
  const Walker walker{outline, signed_area(outline) >= 0 ? 1.0 : -1.0};
  walker.walk(count, length / count, [&](Point p, double s, Point outwards) {
    BleedSample sample{p, s, ring.at(p, outwards), 0, 0, false};
    sample.norm = length_of(sample.mismatch);
    const Point seen{p.x + dx, p.y + dy};
    sample.is_seen = seen.x >= 0 && seen.y >= 0 && seen.x < target.width() && seen.y < target.height();
    out.samples.push_back(sample);
  });
  if (out.samples.empty()) return out;
  const std::size_t reach = std::min<std::size_t>(kBleedReach_px, (out.samples.size() - 1) / 2);
  if (reach > 0) find_jumps(out.samples, reach);
  std::array<double, 3> sum{};
  double seen = 0;
  for (const BleedSample& sample : out.samples) {
    if (!sample.is_seen) continue;
    ++seen;
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += static_cast<double>(sample.mismatch[k]);
    out.largest_norm = std::max(out.largest_norm, sample.norm);
    out.largest_jump = std::max(out.largest_jump, sample.jump);
  }
  for (std::size_t k = 0; k < 3 && seen > 0; ++k)
    out.mean[k] = static_cast<float>(sum[k] / seen);
  return out;
}

} // namespace oversketch
