#include "core/deform/match_profile.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

constexpr int kSamples = 1024;
/// Half the width of the box filter, samples; applied twice.
constexpr int kSmoothing = 4;
constexpr std::array<double, 3> kScales{0.012, 0.03, 0.07};

Points smooth(const Points& points) {
  const int n = static_cast<int>(points.size());
  Points out(points.size());
  Point sum;
  for (int k = -kSmoothing; k <= kSmoothing; ++k)
    sum += points[(k + n) % n];
  for (int i = 0; i < n; ++i) {
    out[i] = sum / (2 * kSmoothing + 1);
    sum += points[(i + kSmoothing + 1) % n] - points[(i - kSmoothing + n) % n];
  }
  return out;
}

} // namespace

MatchSource::Profile::Profile(const ClosedCurve& curve) : length_(curve.length()) {
  const Point origin = curve.points().front();
  Points points = resample(curve, kSamples);
  // Near the origin: sums of far points would lose digits.
  for (Point& p : points)
    p = (1 / length_) * (p - origin);
  points = smooth(smooth(points));
  std::vector<double> along(kSamples + 1);
  for (int i = 0; i < kSamples; ++i)
    along[i + 1] = along[i] + distance(points[i], points[(i + 1) % kSamples]);
  s_.resize(kSamples + 1);
  sums_.resize(kSamples + 1);
  Points even(kSamples + 1);
  for (int k = 0, i = 0; k <= kSamples; ++k) {
    const double target = along.back() * k / kSamples;
    while (i + 1 < kSamples && along[i + 1] <= target)
      ++i;
    const double gap = along[i + 1] - along[i];
    const double t = gap > 0 ? std::clamp((target - along[i]) / gap, 0.0, 1.0) : 0.0;
    s_[k] = length_ * (i + t) / kSamples;
    even[k] = lerp(points[i], points[(i + 1) % kSamples], t);
  }
  for (int k = 0; k < kSamples; ++k)
    sums_[k + 1] = sums_[k] + (0.5 / kSamples) * (even[k] + even[k + 1]);
}

Point MatchSource::Profile::integral(double u) const {
  const double turns = std::floor(u), at = (u - turns) * kSamples;
  const int k = std::min(static_cast<int>(at), kSamples - 1);
  return turns * sums_.back() + lerp(sums_[k], sums_[k + 1], at - k);
}

double MatchSource::Profile::s_at(double u) const {
  const double turns = std::floor(u), at = (u - turns) * kSamples;
  const int k = std::min(static_cast<int>(at), kSamples - 1);
  return turns * length_ + s_[k] + (at - k) * (s_[k + 1] - s_[k]);
}

double MatchSource::Profile::u_at(double s) const {
  const double turns = std::floor(s / length_), rest = s - turns * length_;
  const auto next = std::upper_bound(s_.begin(), s_.end(), rest);
  const int k = std::clamp(static_cast<int>(next - s_.begin()) - 1, 0, kSamples - 1);
  const double gap = s_[k + 1] - s_[k];
  return turns + (k + (gap > 0 ? std::clamp((rest - s_[k]) / gap, 0.0, 1.0) : 0.0)) / kSamples;
}

ShapeSample MatchSource::Profile::sample(double u, double reach) const {
  ShapeSample out;
  for (std::size_t k = 0; k < kScales.size(); ++k) {
    const double r = reach * kScales[k];
    const Point before = mean(u - r, u - 0.4 * r), here = mean(u - 0.3 * r, u + 0.3 * r);
    const Point after = mean(u + 0.4 * r, u + r), in = here - before, out_of = after - here;
    const double c = dot(in, out_of), s = cross(in, out_of), norm = std::hypot(c, s);
    const double w = norm > 0 ? std::sqrt(kTurningWeights[k]) / norm : 0.0;
    out.turning[2 * k] = static_cast<float>(w * c);
    out.turning[2 * k + 1] = static_cast<float>(w * s);
    if (k != 1) continue;
    const Point way = after - before;
    const double long_way = length(way);
    if (long_way > 0) out.direction = {static_cast<float>(way.x / long_way), static_cast<float>(way.y / long_way)};
  }
  return out;
}

std::vector<ShapeSample> MatchSource::Profile::samples(int count, double from, double to, double reach) const {
  std::vector<ShapeSample> out(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    out[i] = sample(from + (to - from) * i / count, reach);
  return out;
}

} // namespace oversketch
