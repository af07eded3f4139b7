#include "core/clone/guidance.h"

namespace oversketch {
namespace {

/// What must be added to g_p − g_q to get the difference that is kept.
Channels surplus(const PlacedPair::Values& p, const PlacedPair::Values& q) {
  const Channels source = p.source - q.source, target = p.target - q.target;
  const double s = norm_squared(source), t = norm_squared(target), more = t - s;
  return more > 0 && more * more > kTie * (s + t) ? target - source : Channels{};
}

} // namespace

std::vector<Channels> ring_differences(const PlacedPair& pair, const PixelGraph& graph) {
  std::vector<Channels> differences;
  differences.reserve(graph.ring.size());
  for (const PixelGraph::RingEdge& edge : graph.ring)
    differences.push_back(pair.difference(edge.x, edge.y));
  return differences;
}

std::vector<Channels> membrane_side(const PlacedPair& pair, const PixelGraph& graph) {
  std::vector<Channels> side(static_cast<std::size_t>(graph.count));
  for (const PixelGraph::RingEdge& edge : graph.ring)
    side[static_cast<std::size_t>(edge.pixel)] += pair.difference(edge.x, edge.y);
  return side;
}

std::vector<Channels> mixed_side(const PlacedPair& pair, const PixelGraph& graph) {
  const auto n = static_cast<std::size_t>(graph.count);
  std::vector<Channels> side(n);
  std::vector<PlacedPair::Values> values(n);
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  const auto exchange = [&](std::size_t p, std::size_t q) {
    const Channels more = surplus(values[p], values[q]);
    side[p] += more;
    side[q] -= more;
  };
  for (std::size_t run = 0; run < runs.size(); ++run) {
    auto k = static_cast<std::size_t>(graph.first[run]);
    for (int x = runs[run].x0; x < runs[run].x1; ++x, ++k) {
      values[k] = pair.at(x, runs[run].y);
      if (x > runs[run].x0) exchange(k - 1, k);
    }
  }
  for (const PixelGraph::Stretch& s : graph.stretches)
    for (int i = 0; i < s.length; ++i)
      exchange(static_cast<std::size_t>(s.upper + i), static_cast<std::size_t>(s.lower + i));
  for (const PixelGraph::RingEdge& edge : graph.ring) {
    const PlacedPair::Values outside = pair.at(edge.x, edge.y);
    const auto p = static_cast<std::size_t>(edge.pixel);
    side[p] += outside.target - outside.source;
    side[p] += surplus(values[p], outside);
  }
  return side;
}

} // namespace oversketch
