#include "core/deform/flipfree_align.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>

namespace oversketch {
namespace {

constexpr int kRounds = 10;
/// How far from fitting the first similarity may be, in tolerances: beyond it the shapes differ.
constexpr double kHopeless = 40;
/// Keeps circles, which may turn freely, from turning at all.
constexpr double kAlong = 1e-6;

/// The similarity that takes `points` nearest to `targets` in least squares.
Similarity fit_similarity(const Points& points, const Points& targets) {
  std::complex<double> point_mean, target_mean, product;
  double square = 0;
  const double n = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    point_mean += to_complex(points[i]) / n;
    target_mean += to_complex(targets[i]) / n;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto z = to_complex(points[i]) - point_mean;
    product += std::conj(z) * (to_complex(targets[i]) - target_mean);
    square += std::norm(z);
  }
  const std::complex<double> factor = square > 0 ? product / square : 1.0;
  return {factor, target_mean - factor * point_mean};
}

/// One Gauss-Newton step: unknowns are the changes of factor and offset.
Similarity improve(const Similarity& now, const Points& points, const std::vector<CurvePosition>& nearest,
                   const ClosedCurve& curve) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point z = points[i], d = now(z) - nearest[i].point, t = curve.tangent(nearest[i].s), n = turned(t);
    const auto add = [&](Point way, double weight) {
      const Eigen::Vector4d row(way.x * z.x + way.y * z.y, way.y * z.x - way.x * z.y, way.x, way.y);
      normal += weight * row * row.transpose();
      right -= weight * dot(way, d) * row;
    };
    add(n, 1);
    add(t, kAlong);
  }
  const Eigen::Vector4d change = normal.ldlt().solve(right);
  if (!change.allFinite()) return now;
  return {now.factor + std::complex(change[0], change[1]), now.offset + std::complex(change[2], change[3])};
}

} // namespace

std::optional<std::vector<double>> align_similar(const Points& points, const ClosedCurve& curve,
                                                 const std::vector<double>& s, double tolerance) {
  Points targets;
  for (const double at : s)
    targets.push_back(curve.at(at));
  Similarity similarity = fit_similarity(points, targets);
  std::vector<CurvePosition> nearest(points.size());
  for (int round = 0; round <= kRounds; ++round) {
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      nearest[i] = curve.nearest(similarity(points[i]));
      worst = std::max(worst, nearest[i].distance);
      if (worst > kHopeless * tolerance) return std::nullopt;
    }
    if (round == kRounds && worst > tolerance) return std::nullopt;
    if (round < kRounds) similarity = improve(similarity, points, nearest, curve);
  }
  std::vector<double> found(s.size());
  for (std::size_t i = 0; i < s.size(); ++i)
    found[i] = nearest[i].s + std::round((s[i] - nearest[i].s) / curve.length()) * curve.length();
  for (std::size_t i = 0; i + 1 < s.size(); ++i)
    if (found[i + 1] <= found[i]) return std::nullopt;
  if (found.back() >= found.front() + curve.length()) return std::nullopt;
  return found;
}

} // namespace oversketch
