#include "app/cli/bench_floor.h"

#include <cstdint>

namespace oversketch::cli {

void mix_pixels(const LivePixel* source, const Rgba8* below, int count, Rgba8* out) {
  const auto mix = [](std::int16_t a, std::uint8_t b) { return static_cast<std::uint8_t>((a >> 7) + (b >> 1)); };
  for (int i = 0; i < count; ++i) {
    const LivePixel g = source[i];
    const Rgba8 f = below[i];
    out[i] = {mix(g.r, f.r), mix(g.g, f.g), mix(g.b, f.b), mix(g.a, f.a)};
  }
}

} // namespace oversketch::cli
