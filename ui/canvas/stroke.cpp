#include "ui/canvas/stroke.h"

#include "core/geometry/curve.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

Points without_stops(const std::vector<Stroke::Sample>& samples) {
  Points line;
  for (const Stroke::Sample& sample : samples)
    if (line.empty() || !(line.back() == sample.at)) line.push_back(sample.at);
  return line;
}

/// More points than any screen shows: a view that is zoomed far out in mid-stroke must not ask for millions.
constexpr double kMostPoints = 20'000;

/// Points every `wanted` px along the line, the last one at its end.
Points sample_evenly(const Points& line, double wanted) {
  const double step = std::max(wanted, path_length(line) / kMostPoints);
  Points even{line.front()};
  double due = step;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double piece = distance(line[i], line[i + 1]);
    for (; due < piece; due += step)
      even.push_back(lerp(line[i], line[i + 1], due / piece));
    due -= piece;
  }
  even.push_back(line.back());
  return even;
}

/// A Gaussian average whose window never reaches past an end.
/// @param sigma  in points.
Points average(const Points& line, double sigma) {
  const auto n = static_cast<std::ptrdiff_t>(line.size());
  const auto widest = static_cast<std::ptrdiff_t>(std::ceil(3 * sigma));
  const auto weight = [](double t) { return std::exp(-0.5 * t * t); };
  std::vector<double> whole;
  for (std::ptrdiff_t k = 0; k <= widest; ++k)
    whole.push_back(weight(static_cast<double>(k) / sigma));
  Points out(line.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const std::ptrdiff_t half = std::min({widest, i, n - 1 - i});
    const double narrow = sigma * static_cast<double>(half) / static_cast<double>(widest);
    Point sum = line[static_cast<std::size_t>(i)];
    double weights = 1;
    for (std::ptrdiff_t k = 1; k <= half; ++k) {
      const double w = half == widest ? whole[static_cast<std::size_t>(k)] : weight(static_cast<double>(k) / narrow);
      sum += w * (line[static_cast<std::size_t>(i - k)] + line[static_cast<std::size_t>(i + k)]);
      weights += 2 * w;
    }
    out[static_cast<std::size_t>(i)] = sum / weights;
  }
  return out;
}

} // namespace

double Stroke::sigma_px(Smoothing smoothing) {
  switch (smoothing) {
  case Smoothing::kNone:
    return 0;
  case Smoothing::kBasic:
    return 4;
  case Smoothing::kStabiliser:
    return 16;
  }
  return 0;
}

void Stroke::add(Point at, double time_s) {
  if (is_finite(at)) samples_.push_back({at, time_s});
}

Points Stroke::smoothed() const {
  const Points line = without_stops(samples_);
  if (smoothing_ == Smoothing::kNone || line.size() < 3) return line;
  const Points even = sample_evenly(line, kStep / zoom_);
  const double sigma = sigma_px(smoothing_) / kStep;
  const Points once = average(even, sigma), twice = average(once, sigma);
  Points out(even.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = 2 * once[i] - twice[i];
  // Rounding must not move where the pen was set down and lifted.
  out.front() = even.front();
  out.back() = even.back();
  return out;
}

} // namespace oversketch
