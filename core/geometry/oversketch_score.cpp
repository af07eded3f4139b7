#include "core/geometry/oversketch_plan.h"

#include "core/geometry/path.h"
#include "core/geometry/segment_tree.h"

namespace oversketch {

namespace {

/// Enough to tell two parts of a curve apart; the cost of a score is this many nearest-point searches, twice.
constexpr int kSamples = 64;

double mean_distance(const Path& from, const SegmentTree& to) {
  double sum = 0;
  for (int i = 0; i < kSamples; ++i)
    sum += std::sqrt(to.nearest(from.at(from.length() * (i + 0.5) / kSamples)).squared);
  return sum / kSamples;
}

double mean_tangent_difference(const Path& a, const Path& b) {
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double begin = static_cast<double>(i) / kSamples, end = (i + 1.0) / kSamples;
    const Point along_a = a.at(a.length() * end) - a.at(a.length() * begin);
    const Point along_b = b.at(b.length() * end) - b.at(b.length() * begin);
    const double sizes = length(along_a) * length(along_b);
    sum += sizes > 0 ? 1 - dot(along_a, along_b) / sizes : 1.0;
  }
  return sum / kSamples;
}

} // namespace

double score_plan(const ClosedCurve& curve, const OversketchPlan& plan, std::span<const double> pin_s) {
  Points part{plan.from.point};
  const Points inner = vertices_between(curve, plan.from.s, plan.from.segment, plan.part_length);
  part.insert(part.end(), inner.begin(), inner.end());
  part.push_back(plan.to.point);
  const Path part_path(part), stroke_path(plan.stroke);
  const double stroke_length = stroke_path.length();
  const double distance = 0.5 * (mean_distance(part_path, SegmentTree(plan.stroke, false)) +
                                 mean_distance(stroke_path, SegmentTree(part, false)));
  // A part of no length is infinitely unlike in length: the bound keeps the other terms in play.
  const double unlike = std::min(0.5 * std::abs(std::log(part_path.length() / stroke_length)), 1.5);
  double lost = 0;
  for (const double s : pin_s)
    lost += curve.forward(plan.from.s, s) < plan.part_length;
  const double pins = pin_s.empty() ? 0.0 : lost / static_cast<double>(pin_s.size());
  return 2 * distance / stroke_length + unlike + 0.25 * mean_tangent_difference(part_path, stroke_path) + 0.25 * pins;
}

} // namespace oversketch
