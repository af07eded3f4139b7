#include "core/deform/flipfree_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oversketch {
namespace {

constexpr std::array<std::pair<int, int>, 10> kBlocks{
    {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {1, 0}, {2, 0}, {3, 0}, {2, 1}, {3, 1}, {3, 2}}};
/// What a corner keeps of its D in one step.
constexpr double kKeep = 0.05;

/// A 2 × 2 matrix by rows.
struct Block {
  double xx = 0, xy = 0, yx = 0, yy = 0;

  Block& operator+=(const Block& b) { return xx += b.xx, xy += b.xy, yx += b.yx, yy += b.yy, *this; }
};
inline Block operator+(Block a, const Block& b) {
  return a += b;
}
inline Block operator-(const Block& a) {
  return {-a.xx, -a.xy, -a.yx, -a.yy};
}
inline Block operator-(const Block& a, const Block& b) {
  return a + -b;
}
inline Block operator*(double k, const Block& a) {
  return {k * a.xx, k * a.xy, k * a.yx, k * a.yy};
}
inline Block transpose(const Block& a) {
  return {a.xx, a.yx, a.xy, a.yy};
}
inline Block outer(Point a, Point b) {
  return {a.x * b.x, a.x * b.y, a.y * b.x, a.y * b.y};
}
/// a · S with S = ½ (0 1; −1 0), what e2 adds to the corner's a.
inline Block times_s(const Block& a) {
  return {-0.5 * a.xy, 0.5 * a.xx, -0.5 * a.yy, 0.5 * a.yx};
}
inline Block s_transposed_times(const Block& a) {
  return {-0.5 * a.yx, -0.5 * a.yy, 0.5 * a.xx, 0.5 * a.xy};
}

/// Edges of a cell: bottom and top along u, left and right along v.
struct Edges {
  Point bottom, top, left, right;
};

inline Edges edges_of(const Points& x, const std::array<int, 4>& c) {
  return {x[c[1]] - x[c[0]], x[c[2]] - x[c[3]], x[c[3]] - x[c[0]], x[c[2]] - x[c[1]]};
}

inline double corner_value(Point e1, Point e2, const DistortionEnergy::Weights& w) {
  const double d = cross(e1, e2);
  // p + q = (|e1|² + |e2|²)/2.
  const double numerator = dot(e1, e1) + dot(e2, e2) + w.stiffness * (d * d + 1);
  if (w.epsilon == 0) return d > 0 ? numerator / d : std::numeric_limits<double>::infinity();
  return 2 * numerator / (d + std::sqrt(w.epsilon * w.epsilon + d * d));
}

/// Derivatives of F as a function of p and q.
struct Slopes {
  double p = 0, q = 0, pp = 0, pq = 0, qq = 0;
};

inline Slopes slopes_of(double p, double q, const DistortionEnergy::Weights& w) {
  const double d = p - q, l = w.stiffness, n = 2 * (p + q) + l * (d * d + 1);
  double chi = d, chi1 = 1, chi2 = 0;
  if (w.epsilon > 0) {
    const double e2 = w.epsilon * w.epsilon, root = std::sqrt(e2 + d * d);
    // For d far below 0 the difference of two near equals: use the quotient.
    chi = d > 0 ? 0.5 * (d + root) : 0.5 * e2 / (root - d);
    chi1 = chi / root;
    chi2 = 0.5 * e2 / (root * root * root);
  }
  const double np = 2 + 2 * l * d, nq = 2 - 2 * l * d, i = 1 / chi;
  const double a = n * chi1 * i, bend = n * i * i * (2 * chi1 * chi1 * i - chi2);
  return {(np - a) * i, (nq + a) * i, 2 * l * i - 2 * np * chi1 * i * i + bend,
          -2 * l * i + (np - nq) * chi1 * i * i - bend, 2 * l * i + 2 * nq * chi1 * i * i + bend};
}

/// The nearest positive semidefinite matrix to (a b; b c).
inline void project(double& a, double& b, double& c) {
  if (a >= 0 && c >= 0 && a * c >= b * b) return;
  const double mean = 0.5 * (a + c), half = 0.5 * (a - c), radius = std::hypot(half, b);
  const double top = mean + radius;
  if (top <= 0 || radius == 0) {
    a = b = c = 0;
    return;
  }
  // Only the larger eigenvalue stays: top · (I + reflection)/2.
  a = top * 0.5 * (1 + half / radius);
  c = top * 0.5 * (1 - half / radius);
  b = top * 0.5 * b / radius;
}

struct CornerDerivatives {
  Point g1, g2;
  Block h11, h12, h22;
};

inline CornerDerivatives derive_corner(Point e1, Point e2, const DistortionEnergy::Weights& w, double weight) {
  const Point a{0.5 * (e1.x + e2.y), 0.5 * (e1.y - e2.x)}, b{0.5 * (e1.x - e2.y), 0.5 * (e1.y + e2.x)};
  const double p = dot(a, a), q = dot(b, b), a_size = std::sqrt(p), b_size = std::sqrt(q);
  const Slopes f = slopes_of(p, q, w);
  double aa = 2 * f.p + 4 * p * f.pp, ab = 4 * a_size * b_size * f.pq, bb = 2 * f.q + 4 * q * f.qq;
  project(aa, ab, bb);
  const double a_across = std::max(2 * f.p, 0.0), b_across = std::max(2 * f.q, 0.0);
  const Point a_unit = a_size > 0 ? a / a_size : Point{1, 0}, b_unit = b_size > 0 ? b / b_size : Point{1, 0};
  const Block haa =
      (weight * (aa - a_across)) * outer(a_unit, a_unit) + Block{weight * a_across, 0, 0, weight * a_across};
  const Block hbb =
      (weight * (bb - b_across)) * outer(b_unit, b_unit) + Block{weight * b_across, 0, 0, weight * b_across};
  const Block hab = (weight * ab) * outer(a_unit, b_unit), hba = transpose(hab);
  const Point ga = (2 * weight * f.p) * a, gb = (2 * weight * f.q) * b;
  return {0.5 * (ga + gb),
          {0.5 * (gb.y - ga.y), 0.5 * (ga.x - gb.x)},
          0.25 * (haa + hab + hba + hbb),
          0.5 * times_s(haa - hab + hba - hbb),
          s_transposed_times(times_s(haa - hab - hba + hbb))};
}

inline std::array<double, 4> to_array(const Block& b) {
  return {b.xx, b.xy, b.yx, b.yy};
}

/// The first t in (0, 1] at which a corner has lost all but kKeep of its D, which along the step is quadratic in t.
inline double corner_step(Point e1, Point e2, Point d1, Point d2) {
  const double c = (1 - kKeep) * cross(e1, e2), b = cross(d1, e2) + cross(e1, d2), a = cross(d1, d2);
  // a t² + b t + c = 0 with c > 0: the smallest positive root, in the form that cancels nothing.
  const double inside = b * b - 4 * a * c;
  if (inside < 0) return 1;
  const double root = std::sqrt(inside);
  if (b < 0) return std::min(1.0, 2 * c / (root - b));
  return a < 0 ? std::min(1.0, (b + root) / (-2 * a)) : 1.0;
}

} // namespace

DistortionEnergy::DistortionEnergy(const QuadMesh& mesh) : cells_(mesh.cells) {
  std::vector<std::pair<int, int>> coupled;
  for (const auto& c : cells_)
    for (const auto& [k, l] : kBlocks)
      coupled.emplace_back(c[k], c[l]);
  pattern_ = std::make_shared<const BlockPattern>(static_cast<int>(mesh.vertices.size()), coupled);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    weights_.push_back(std::max(mesh.coverage[i], kLeastCoverage));
    total_weight_ += weights_.back();
    auto& places = places_.emplace_back();
    for (std::size_t k = 0; k < kBlocks.size(); ++k)
      places[k] = find_block(*pattern_, cells_[i][kBlocks[k].first], cells_[i][kBlocks[k].second]);
  }
}

double DistortionEnergy::value(const Points& x, const Weights& weights) const {
  double sum = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Edges e = edges_of(x, cells_[i]);
    sum += 0.25 * weights_[i] *
           ((corner_value(e.bottom, e.left, weights) + corner_value(e.bottom, e.right, weights)) +
            (corner_value(e.top, e.right, weights) + corner_value(e.top, e.left, weights)));
  }
  return sum;
}

double DistortionEnergy::least_determinant(const Points& x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& c : cells_) {
    const Edges e = edges_of(x, c);
    least = std::min(
        {least, cross(e.bottom, e.left), cross(e.bottom, e.right), cross(e.top, e.right), cross(e.top, e.left)});
  }
  return least;
}

int DistortionEnergy::count_flipped(const Points& x) const {
  int count = 0;
  for (const auto& c : cells_) {
    const Edges e = edges_of(x, c);
    const bool good = cross(e.bottom, e.left) > 0 && cross(e.bottom, e.right) > 0 && cross(e.top, e.right) > 0 &&
                      cross(e.top, e.left) > 0;
    if (!good) ++count;
  }
  return count;
}

double DistortionEnergy::longest_step(const Points& x, const Points& direction) const {
  double longest = 1;
  for (const auto& c : cells_) {
    const Edges e = edges_of(x, c), d = edges_of(direction, c);
    longest = std::min({longest, corner_step(e.bottom, e.left, d.bottom, d.left),
                        corner_step(e.bottom, e.right, d.bottom, d.right), corner_step(e.top, e.right, d.top, d.right),
                        corner_step(e.top, e.left, d.top, d.left)});
  }
  return longest;
}

void DistortionEnergy::add_derivatives(const Points& x, const Weights& weights, Points& gradient,
                                       BlockCholesky& hessian) const {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const auto& c = cells_[i];
    const Edges e = edges_of(x, c);
    const double w = 0.25 * weights_[i];
    const auto k0 = derive_corner(e.bottom, e.left, weights, w), k1 = derive_corner(e.bottom, e.right, weights, w);
    const auto k2 = derive_corner(e.top, e.right, weights, w), k3 = derive_corner(e.top, e.left, weights, w);
    const Point bottom = k0.g1 + k1.g1, top = k2.g1 + k3.g1, left = k0.g2 + k3.g2, right = k1.g2 + k2.g2;
    gradient[c[0]] -= bottom + left;
    gradient[c[1]] += bottom - right;
    gradient[c[2]] += top + right;
    gradient[c[3]] += left - top;
    const Block b = k0.h11 + k1.h11, t = k2.h11 + k3.h11, l = k0.h22 + k3.h22, r = k1.h22 + k2.h22;
    const Block &bl = k0.h12, &br = k1.h12, &tr = k2.h12, &tl = k3.h12;
    const Block lb = transpose(bl), rb = transpose(br), rt = transpose(tr), lt = transpose(tl);
    const auto& at = places_[i];
    hessian.add(at[0], to_array(b + l + bl + lb));
    hessian.add(at[1], to_array(b + r - br - rb));
    hessian.add(at[2], to_array(t + r + tr + rt));
    hessian.add(at[3], to_array(t + l - tl - lt));
    hessian.add(at[4], to_array(rb - b - bl));
    hessian.add(at[5], to_array(-tl - rb));
    hessian.add(at[6], to_array(tl - lb - l));
    hessian.add(at[7], to_array(rb - tr - r));
    hessian.add(at[8], to_array(tr + lb));
    hessian.add(at[9], to_array(lt - t - tr));
  }
}

void DistortionEnergy::add_to_cell(int cell, const std::array<double, 4>& g, const std::array<double, 3>& q,
                                   BlockCholesky& hessian) const {
  for (std::size_t k = 0; k < kBlocks.size(); ++k) {
    const double w = g[kBlocks[k].first] * g[kBlocks[k].second];
    hessian.add(places_[cell][k], {w * q[0], w * q[1], w * q[1], w * q[2]});
  }
}

} // namespace oversketch
