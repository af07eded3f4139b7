#include "core/deform/metrics.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace oversketch {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The cell's corners in the deformed mesh.
std::array<Point, 4> corners_of(const QuadMesh& mesh, const Points& positions, std::size_t cell) {
  std::array<Point, 4> p;
  for (std::size_t k = 0; k < 4; ++k)
    p[k] = positions[mesh.cells[cell][k]];
  return p;
}

bool is_flipped(const std::array<Point, 4>& p) {
  for (std::size_t k = 0; k < 4; ++k) {
    const Point next = p[(k + 1) & 3] - p[k], before = p[(k + 3) & 3] - p[k];
    // Written so that a determinant that is not a number counts as flipped.
    if (!(cross(next, before) > 0)) return true;
  }
  return false;
}

struct CentreJacobian {
  double sigma_ratio = 1;
  double det = 1;
};

CentreJacobian at_centre(const std::array<Point, 4>& p, double cell) {
  const std::complex<double> e1 = to_complex((p[1] - p[0]) + (p[2] - p[3])) / (2 * cell);
  const std::complex<double> e2 = to_complex((p[3] - p[0]) + (p[2] - p[1])) / (2 * cell);
  const std::complex<double> i(0, 1);
  const double a = std::abs(e1 - i * e2) / 2, b = std::abs(e1 + i * e2) / 2;
  const double small = std::abs(a - b);
  return {small > 0 ? (a + b) / small : kInfinity, (a - b) * (a + b)};
}

/// Reorders the values.
double percentile(std::vector<double>& values, double percent) {
  const double rank = percent / 100 * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(rank);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(low);
  std::nth_element(values.begin(), at, values.end());
  const double part = rank - static_cast<double>(low);
  if (part == 0 || at + 1 == values.end()) return *at;
  const double next = *std::min_element(at + 1, values.end());
  return *at == next ? *at : *at + part * (next - *at);
}

struct OneSided {
  double mean = 0;
  double max = 0;
};

OneSided distance_from(const ClosedCurve& curve, const ClosedCurve& to) {
  const int samples = std::max(kLeastDistanceSamples, 2 * curve.size());
  OneSided result;
  for (int i = 0; i < samples; ++i) {
    const double d = to.nearest(curve.at(curve.length() * i / samples)).distance;
    result.mean += d / samples;
    result.max = std::max(result.max, d);
  }
  for (const Point p : curve.points())
    result.max = std::max(result.max, to.nearest(p).distance);
  return result;
}

} // namespace

std::vector<CellDistortion> measure_cells(const QuadMesh& source, const Points& deformed) {
  CHECK(deformed.size() == source.vertices.size(), "one position for each vertex");
  std::vector<CellDistortion> cells(source.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto corners = corners_of(source, deformed, c);
    const CentreJacobian centre = at_centre(corners, source.cell);
    cells[c] = {centre.sigma_ratio, centre.det, is_flipped(corners)};
  }
  return cells;
}

DistortionMetrics measure_distortion(const QuadMesh& source, const Points& deformed) {
  CHECK(deformed.size() == source.vertices.size(), "one position for each vertex");
  CHECK(source.coverage.size() == source.cells.size() && source.cell > 0, "a mesh has coverage and a cell size");
  DistortionMetrics metrics;
  std::vector<double> ratios, dets;
  ratios.reserve(source.cells.size());
  dets.reserve(source.cells.size());
  for (std::size_t i = 0; i < source.cells.size(); ++i) {
    const std::array<Point, 4> corners = corners_of(source, deformed, i);
    if (is_flipped(corners)) ++metrics.flipped_cells;
    if (!(source.coverage[i] > kLeastCoverageCounted)) continue;
    const CentreJacobian jacobian = at_centre(corners, source.cell);
    ratios.push_back(jacobian.sigma_ratio);
    dets.push_back(jacobian.det);
  }
  if (ratios.empty()) return metrics;
  metrics.cells_counted = static_cast<int>(ratios.size());
  metrics.sigma_ratio_mean = std::accumulate(ratios.begin(), ratios.end(), 0.0) / metrics.cells_counted;
  metrics.sigma_ratio_max = *std::max_element(ratios.begin(), ratios.end());
  metrics.sigma_ratio_p95 = percentile(ratios, 95);
  const double low = percentile(dets, 5), high = percentile(dets, 95);
  metrics.area_spread = low > 0 ? high / low : kInfinity;
  return metrics;
}

SketchDistance measure_sketch_distance(const ClosedCurve& deformed_outline, const ClosedCurve& sketch) {
  const OneSided there = distance_from(deformed_outline, sketch), back = distance_from(sketch, deformed_outline);
  return {0.5 * (there.mean + back.mean), std::max(there.max, back.max)};
}

double truth_error(const Points& positions, const Points& truth, double sketch_length) {
  CHECK(positions.size() == truth.size() && !truth.empty(), "a true place for each outline point");
  CHECK(sketch_length > 0, "a sketch has a length");
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += distance(positions[i], truth[i]);
  return sum / static_cast<double>(truth.size()) / sketch_length;
}

int count_order_violations(std::span<const double> fractions) {
  if (fractions.size() < 2) return 0;
  int still = 0;
  double turns = 0;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    const double step = fractions[i + 1 == fractions.size() ? 0 : i + 1] - fractions[i];
    CHECK(std::isfinite(step), "a correspondence is finite");
    const double forward = step - std::floor(step);
    turns += forward;
    if (forward == 0) ++still;
  }
  return std::max(0, static_cast<int>(std::lround(turns)) + still - 1);
}

} // namespace oversketch
