#include "core/clone/live_data.h"
#include "core/clone/pixel_check.h"

#include <algorithm>

namespace oversketch {
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
    if (const Rgba* bad = std::find_if_not(from, from + count, is_blendable); bad != from + count)
      return refuse_pixel("source", *bad, run.x0 + static_cast<int>(bad - from), run.y);
    data->is_opaque &= pack_pixels(from, static_cast<std::size_t>(count), to);
    to += count;
  }
  data->ring.reserve(system.graph().ring.size());
  for (const PixelGraph::RingEdge& edge : system.graph().ring) {
    data->ring.push_back(source.pixels.at(edge.x - source.rect.x, edge.y - source.rect.y));
    if (!is_blendable(data->ring.back())) return refuse_pixel("source", data->ring.back(), edge.x, edge.y);
  }
  return LiveRegion(data);
}

} // namespace oversketch
