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
/// Shifts that are tried along the curve.
constexpr int kShifts = 512;
/// Curves whose length for their area differs by more than this are no similar ones; a trembling of rounding is less.
constexpr double kUnlike = 0.01;
/// 1 − correlation² at half a shift beside the right one stays below this.
constexpr double kUncorrelated = 2e-3;
constexpr std::size_t kMostCandidates = 16;
/// How much more than the tolerance a shift may be off before it is aligned.
constexpr double kReach = 50;

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

/// How well a similarity takes the points to the curve's samples from each shift on: 1 − correlation², 0 at best.
std::vector<double> correlate(const Points& points, const std::vector<double>& parts, const ClosedCurve& curve) {
  std::vector<std::complex<double>> samples;
  for (const Point p : resample(curve, kShifts))
    samples.push_back(to_complex(p));
  std::complex<double> mean;
  for (const Point p : points)
    mean += to_complex(p) / static_cast<double>(points.size());
  std::vector<double> misfit(kShifts);
  for (int shift = 0; shift < kShifts; ++shift) {
    std::complex<double> product, sum;
    double own = 0, theirs = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto z = to_complex(points[i]) - mean;
      const auto w =
          samples[static_cast<std::size_t>(shift + static_cast<int>(std::lround(parts[i] * kShifts))) % kShifts];
      product += std::conj(z) * w;
      sum += w;
      own += std::norm(z);
      theirs += std::norm(w);
    }
    theirs -= std::norm(sum) / static_cast<double>(points.size());
    misfit[static_cast<std::size_t>(shift)] = own > 0 && theirs > 0 ? 1 - std::norm(product) / (own * theirs) : 1.0;
  }
  return misfit;
}

/// The shifts that fit better than their neighbours, and nearly: best first.
std::vector<int> best_shifts(const std::vector<double>& misfit) {
  std::vector<int> shifts;
  for (int k = 0; k < kShifts; ++k) {
    const auto at = [&](int i) { return misfit[static_cast<std::size_t>((i + kShifts) % kShifts)]; };
    if (at(k) < kUncorrelated && at(k) <= at(k - 1) && at(k) < at(k + 1)) shifts.push_back(k);
  }
  std::stable_sort(shifts.begin(), shifts.end(), [&](int a, int b) {
    return misfit[static_cast<std::size_t>(a)] < misfit[static_cast<std::size_t>(b)];
  });
  if (shifts.size() > kMostCandidates) shifts.resize(kMostCandidates);
  return shifts;
}

} // namespace

std::optional<Alignment> align_similar(const Points& points, const ClosedCurve& curve, const std::vector<double>& s,
                                       double tolerance) {
  Points targets;
  for (const double at : s)
    targets.push_back(curve.at(at));
  Similarity similarity = fit_similarity(points, targets);
  std::vector<CurvePosition> nearest(points.size());
  double worst = 0;
  for (int round = 0; round <= kRounds; ++round) {
    worst = 0;
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
  return Alignment{std::move(found), worst, std::arg(similarity.factor)};
}

std::optional<Alignment> find_similar(const Points& points, const ClosedCurve& outline, const std::vector<double>& s,
                                      const ClosedCurve& curve, double tolerance) {
  const auto slenderness = [](const ClosedCurve& c) { return c.length() / std::sqrt(std::abs(c.signed_area())); };
  if (std::abs(slenderness(outline) / slenderness(curve) - 1) > kUnlike) return std::nullopt;
  std::vector<double> parts;
  for (const double at : s)
    parts.push_back((at - s.front()) / outline.length());
  std::optional<Alignment> best;
  for (const int shift : best_shifts(correlate(points, parts, curve))) {
    std::vector<double> places;
    for (const double part : parts)
      places.push_back((static_cast<double>(shift) / kShifts + part) * curve.length());
    auto found = align_similar(points, curve, places, kReach * tolerance);
    if (found && found->distance <= tolerance && (!best || std::abs(found->turn) < std::abs(best->turn)))
      best = std::move(found);
  }
  return best;
}

} // namespace oversketch
