#include "core/clone/live_data.h"

#include <algorithm>
#include <string>

namespace oversketch {
namespace {

bool is_number(const Rgba& p) {
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
  data->pixels.resize(static_cast<std::size_t>(system.graph().count));
  LivePixel* to = data->pixels.data();
  for (const Mask::Run& run : system.mask().runs()) {
    const Rgba* const from = &source.pixels.at(run.x0 - source.rect.x, run.y - source.rect.y);
    const int count = run.x1 - run.x0;
    const PackedKind kind = pack_pixels(from, static_cast<std::size_t>(count), to);
    if (!kind.is_finite)
      return not_finite(run.x0 + static_cast<int>(std::find_if_not(from, from + count, is_number) - from), run.y);
    data->is_opaque &= kind.is_opaque;
    to += count;
  }
  data->ring.reserve(system.graph().ring.size());
  for (const PixelGraph::RingEdge& edge : system.graph().ring) {
    data->ring.push_back(source.pixels.at(edge.x - source.rect.x, edge.y - source.rect.y));
    if (!is_number(data->ring.back())) return not_finite(edge.x, edge.y);
  }
  return LiveRegion(data);
}

} // namespace oversketch
