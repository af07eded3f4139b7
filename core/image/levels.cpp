#include "core/image/levels.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace oversketch {

namespace {

template <int kTop, class Level>
Level to_level(float value) {
  // Written so that NaN falls to 0: the conversion to an integer is then always defined.
  const float scaled = value * static_cast<float>(kTop) + 0.5f;
  const float above = scaled > 0.0f ? scaled : 0.0f;
  const float inside = above < static_cast<float>(kTop) ? above : static_cast<float>(kTop);
  return static_cast<Level>(static_cast<int>(inside));
}

template <int kTop, class Level>
void to_levels(std::span<const Rgba> pixels, std::span<Level> levels) {
  CHECK(levels.size() == pixels.size() * 4, "levels need 4 numbers a pixel");
  // Through a block of plain numbers: the compiler makes vector code of a flat loop, and scalar code of four fields.
  constexpr std::size_t kBlock = 64;
  static_assert(sizeof(Rgba) == 4 * sizeof(float));
  std::array<float, 4 * kBlock> values;
  Level* out = levels.data();
  for (std::size_t at = 0; at < pixels.size(); at += kBlock) {
    const std::size_t count = std::min(kBlock, pixels.size() - at);
    std::memcpy(values.data(), pixels.data() + at, count * sizeof(Rgba));
    for (std::size_t i = 0; i < 4 * count; ++i)
      out[i] = to_level<kTop, Level>(values[i]);
    out += 4 * count;
  }
}

} // namespace

void to_levels8(std::span<const Rgba> pixels, std::span<std::uint8_t> levels) {
  to_levels<255, std::uint8_t>(pixels, levels);
}

void to_levels16(std::span<const Rgba> pixels, std::span<std::uint16_t> levels) {
  to_levels<65535, std::uint16_t>(pixels, levels);
}

std::vector<std::uint8_t> to_rgba8(const Raster<Rgba>& pixels) {
  std::vector<std::uint8_t> levels(pixels.values().size() * 4);
  to_levels8(pixels.values(), levels);
  return levels;
}

std::vector<std::uint8_t> to_rgba8(const Image& image) {
  return to_rgba8(image.pixels());
}

bool is_finite(std::span<const Rgba> pixels) {
  // 0 · x is 0 for a finite x and NaN otherwise; the four sums run side by side, which a test and branch would not.
  float r = 0, g = 0, b = 0, a = 0;
  for (const Rgba& p : pixels) {
    r += 0 * p.r;
    g += 0 * p.g;
    b += 0 * p.b;
    a += 0 * p.a;
  }
  return r + g + b + a == 0;
}

Image filled(int width, int height, Rgba color) {
  return Image(Raster<Rgba>(width, height, color));
}

} // namespace oversketch
