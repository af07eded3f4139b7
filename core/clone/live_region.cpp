#include "core/clone/live_data.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace oversketch {
namespace {

std::int16_t pack(float value) {
  const float units = LivePixel::kOpaque * value + 32;
  return static_cast<std::int16_t>(std::lrint(std::clamp(units, -32768.0F, 32767.0F)));
}

bool is_finite(const Rgba& p) {
  // 0 · x is not 0 for infinite x and for not-a-number.
  return p.r * 0 + p.g * 0 + p.b * 0 + p.a * 0 == 0;
}

Error not_finite(int x, int y) {
  return {"clone.not-finite", "The source has a pixel that is not a number, or infinite.",
          "source pixel " + std::to_string(x) + ", " + std::to_string(y)};
}

} // namespace

Result<LiveRegion> LiveRegion::make(const WarpedRegion& source, const CloneSystem& system) {
  const Rect needed = grown(system.mask().bounds(), 1);
  if (intersect(needed, source.rect) != needed)
    return Error{"clone.source-too-small", "The source picture must cover the whole mask and 1 pixel round it.", ""};
  const auto data = std::make_shared<Data>(system);
  data->pixels.reserve(static_cast<std::size_t>(system.graph().count));
  for (const Mask::Run& run : system.mask().runs()) {
    const Rgba* from = &source.pixels.at(run.x0 - source.rect.x, run.y - source.rect.y);
    for (int x = run.x0; x < run.x1; ++x, ++from) {
      if (!is_finite(*from)) return not_finite(x, run.y);
      data->pixels.push_back({pack(from->r), pack(from->g), pack(from->b), pack(from->a)});
      data->is_opaque &= data->pixels.back().is_opaque();
    }
  }
  data->ring.reserve(system.graph().ring.size());
  for (const PixelGraph::RingEdge& edge : system.graph().ring) {
    data->ring.push_back(source.pixels.at(edge.x - source.rect.x, edge.y - source.rect.y));
    if (!is_finite(data->ring.back())) return not_finite(edge.x, edge.y);
  }
  return LiveRegion(data);
}

} // namespace oversketch
