#include "core/clone/feather.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oversketch {
namespace {

/// Steps straight up or down to the nearest pixel outside, by pixel number.
std::vector<int> vertical_depths(const PixelGraph& graph) {
  const auto n = static_cast<std::size_t>(graph.count);
  std::vector<int> up(n, 1), down(n, 1);
  for (const PixelGraph::Stretch& s : graph.stretches)
    for (int i = 0; i < s.length; ++i)
      up[static_cast<std::size_t>(s.lower + i)] = up[static_cast<std::size_t>(s.upper + i)] + 1;
  for (auto s = graph.stretches.rbegin(); s != graph.stretches.rend(); ++s)
    for (int i = 0; i < s->length; ++i)
      down[static_cast<std::size_t>(s->upper + i)] = down[static_cast<std::size_t>(s->lower + i)] + 1;
  for (std::size_t k = 0; k < n; ++k)
    up[k] = std::min(up[k], down[k]);
  return up;
}

/// The lower envelope of the parabolas (x − at)² + height, from left to right.
class Envelope {
public:
  void clear() { parabolas_.clear(); }

  void add(double at, double height) {
    double from = -std::numeric_limits<double>::infinity();
    while (!parabolas_.empty()) {
      const Parabola& last = parabolas_.back();
      from = (height + at * at - last.height - last.at * last.at) / (2 * (at - last.at));
      if (from > last.from) break;
      parabolas_.pop_back();
    }
    parabolas_.push_back({at, height, from});
  }

  /// Values at x = 1, 2, … count.
  void read(int count, double* values) const {
    std::size_t k = 0;
    for (int x = 1; x <= count; ++x) {
      while (k + 1 < parabolas_.size() && parabolas_[k + 1].from < x)
        ++k;
      const double d = x - parabolas_[k].at;
      values[x - 1] = d * d + parabolas_[k].height;
    }
  }

private:
  struct Parabola {
    double at = 0;
    double height = 0;
    double from = 0;
  };
  std::vector<Parabola> parabolas_;
};

} // namespace

std::vector<double> squared_depths(const PixelGraph& graph) {
  const std::vector<int> vertical = vertical_depths(graph);
  std::vector<double> depths(vertical.size());
  Envelope envelope;
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const int length = runs[run].x1 - runs[run].x0;
    const auto first = static_cast<std::size_t>(graph.first[run]);
    // The pixels at both ends of the run are outside: nothing beyond them can be nearer.
    envelope.clear();
    envelope.add(0, 0);
    for (int i = 0; i < length; ++i) {
      const double height = vertical[first + static_cast<std::size_t>(i)];
      envelope.add(i + 1, height * height);
    }
    envelope.add(length + 1, 0);
    envelope.read(length, &depths[first]);
  }
  return depths;
}

std::vector<double> inside_weights(const PixelGraph& graph, double feather_px) {
  if (feather_px == 0) return std::vector<double>(static_cast<std::size_t>(graph.count), 1.0);
  std::vector<double> weights = squared_depths(graph);
  for (double& weight : weights) {
    const double t = std::min(1.0, std::sqrt(weight) / (feather_px + 1));
    weight = t * t * (3 - 2 * t);
  }
  return weights;
}

} // namespace oversketch
