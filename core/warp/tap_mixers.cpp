#include "core/warp/tap_mixers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace oversketch {
namespace {

/// r, g, b, a in one register.
using Lanes = float __attribute__((vector_size(16)));
using LaneBits = int __attribute__((vector_size(16)));
static_assert(sizeof(Rgba) == sizeof(Lanes));

constexpr int kOneBits = std::bit_cast<int>(1.0F);

Lanes load(const Rgba& pixel) {
  return std::bit_cast<Lanes>(pixel);
}

/// Need not be a pixel's address.
void ask_for(const Rgba* pixel, std::ptrdiff_t ahead) {
  const auto at = reinterpret_cast<std::uintptr_t>(pixel) + static_cast<std::uintptr_t>(ahead) * sizeof(Rgba);
  __builtin_prefetch(reinterpret_cast<const void*>(at));
}

/// Catmull–Rom: the weights of four taps, t beyond the second.
Lanes cubic_weights(float t) {
  constexpr Lanes kA = {-0.5F, 1.5F, -1.5F, 0.5F}, kB = {1, -2.5F, 2, -0.5F}, kC = {-0.5F, 0, 0.5F, 0},
                  kD = {0, 1, 0, 0};
  return ((kA * t + kB) * t + kC) * t + kD;
}

/// Bits that all alphas have: those of 1 when each is 1, and no alpha from 0 to 1 but 1 itself has them all.
struct Alphas {
  LaneBits all = {-1, -1, -1, -1};

  void add(Lanes pixel) { all &= std::bit_cast<LaneBits>(pixel); }
  bool are_one() const { return all[3] == kOneBits; }
};

} // namespace

bool mix_bilinear_baseline(const Rgba* pixels, int width, int count, const int* first, const float* tx, const float* ty,
                           std::ptrdiff_t ahead, Rgba* out) {
  Alphas alphas;
  for (int i = 0; i < count; ++i) {
    const Rgba *upper = pixels + first[i], *lower = upper + width;
    if ((i & 1) == 0) ask_for(upper, ahead);
    const Lanes a = load(upper[0]), b = load(upper[1]), c = load(lower[0]), d = load(lower[1]);
    for (const Lanes pixel : {a, b, c, d})
      alphas.add(pixel);
    const Lanes left = a + ty[i] * (c - a), right = b + ty[i] * (d - b);
    const Lanes mixed = left + tx[i] * (right - left);
    out[i] = std::bit_cast<Rgba>(mixed);
  }
  return alphas.are_one();
}

bool mix_bicubic_baseline(const Rgba* pixels, int width, int count, const int* first, const float* tx, const float* ty,
                          std::ptrdiff_t ahead, Rgba* out) {
  Alphas alphas;
  for (int i = 0; i < count; ++i) {
    const Lanes wx = cubic_weights(tx[i]), wy = cubic_weights(ty[i]);
    std::array<Lanes, 4> columns;
    if ((i & 1) == 0) ask_for(pixels + first[i], ahead);
    for (int k = 0; k < 4; ++k) {
      const Rgba* tap = pixels + first[i] + k;
      Lanes& sum = columns[static_cast<std::size_t>(k)];
      for (int j = 0; j < 4; ++j, tap += width) {
        const Lanes pixel = load(*tap);
        alphas.add(pixel);
        sum = j == 0 ? wy[0] * pixel : sum + wy[j] * pixel;
      }
    }
    const Lanes mixed = (wx[0] * columns[0] + wx[2] * columns[2]) + (wx[1] * columns[1] + wx[3] * columns[3]);
    out[i] = std::bit_cast<Rgba>(mixed);
    // The weights' sum is 1 up to rounding.
    out[i].a = 1;
  }
  return alphas.are_one();
}

#if defined(__x86_64__)
namespace {

/// Two pixels, or one twice.
using Wide = float __attribute__((vector_size(32)));
using WideBits = int __attribute__((vector_size(32)));

} // namespace

[[gnu::target("avx2")]] bool mix_bilinear_avx2(const Rgba* pixels, int width, int count, const int* first,
                                               const float* tx, const float* ty, std::ptrdiff_t ahead, Rgba* out) {
  const Rgba* const below = pixels + width;
  WideBits all = {-1, -1, -1, -1, -1, -1, -1, -1};
  int i = 0;
  for (; i + 1 < count; i += 2) {
    ask_for(pixels + first[i], ahead);
    // Left and right taps together: neighbours in memory.
    Wide upper, lower, next_upper, next_lower;
    std::memcpy(&upper, pixels + first[i], sizeof upper);
    std::memcpy(&lower, below + first[i], sizeof lower);
    std::memcpy(&next_upper, pixels + first[i + 1], sizeof upper);
    std::memcpy(&next_lower, below + first[i + 1], sizeof lower);
    all &= ((WideBits)upper & (WideBits)lower) & ((WideBits)next_upper & (WideBits)next_lower);
    const Wide both = upper + ty[i] * (lower - upper);
    const Wide next = next_upper + ty[i + 1] * (next_lower - next_upper);
    const Wide left = __builtin_shufflevector(both, next, 0, 1, 2, 3, 8, 9, 10, 11);
    const Wide right = __builtin_shufflevector(both, next, 4, 5, 6, 7, 12, 13, 14, 15);
    const Lanes t = {tx[i], tx[i], tx[i], tx[i]}, next_t = {tx[i + 1], tx[i + 1], tx[i + 1], tx[i + 1]};
    const Wide mixed = left + __builtin_shufflevector(t, next_t, 0, 1, 2, 3, 4, 5, 6, 7) * (right - left);
    std::memcpy(static_cast<void*>(out + i), &mixed, sizeof mixed);
  }
  const bool opaque = all[3] == kOneBits && all[7] == kOneBits;
  return opaque && (i == count || mix_bilinear_baseline(pixels, width, 1, first + i, tx + i, ty + i, ahead, out + i));
}

[[gnu::target("avx2")]] bool mix_bicubic_avx2(const Rgba* pixels, int width, int count, const int* first,
                                              const float* tx, const float* ty, std::ptrdiff_t ahead, Rgba* out) {
  constexpr Lanes kA = {-0.5F, 1.5F, -1.5F, 0.5F}, kB = {1, -2.5F, 2, -0.5F}, kC = {-0.5F, 0, 0.5F, 0},
                  kD = {0, 1, 0, 0};
  WideBits all = {-1, -1, -1, -1, -1, -1, -1, -1};
  for (int i = 0; i < count; ++i) {
    const Lanes wx = ((kA * tx[i] + kB) * tx[i] + kC) * tx[i] + kD, wy = ((kA * ty[i] + kB) * ty[i] + kC) * ty[i] + kD;
    Wide left = {}, right = {};
    const Rgba* row = pixels + first[i];
    if ((i & 1) == 0) ask_for(row, ahead);
    for (int j = 0; j < 4; ++j, row += width) {
      Wide a, b;
      std::memcpy(&a, row, sizeof a);
      std::memcpy(&b, row + 2, sizeof b);
      all &= (WideBits)a & (WideBits)b;
      left = j == 0 ? wy[0] * a : left + wy[j] * a;
      right = j == 0 ? wy[0] * b : right + wy[j] * b;
    }
    const Wide outer = __builtin_shufflevector(wx, wx, 0, 0, 0, 0, 1, 1, 1, 1) * left;
    const Wide both = outer + __builtin_shufflevector(wx, wx, 2, 2, 2, 2, 3, 3, 3, 3) * right;
    Lanes mixed = __builtin_shufflevector(both, both, 0, 1, 2, 3) + __builtin_shufflevector(both, both, 4, 5, 6, 7);
    mixed[3] = 1;
    std::memcpy(static_cast<void*>(out + i), &mixed, sizeof mixed);
  }
  return all[3] == kOneBits && all[7] == kOneBits;
}
#endif

namespace {

/// `size` × `size` taps from (x, y), edge pixels repeated.
template <int size>
std::array<Rgba, size * size> gather(const Texture& texture, int x, int y) {
  std::array<Rgba, size * size> taps;
  for (int j = 0; j < size; ++j) {
    const std::ptrdiff_t row = std::clamp(y + j, 0, texture.height - 1);
    for (int i = 0; i < size; ++i)
      taps[static_cast<std::size_t>(j * size + i)] =
          texture.pixels[row * texture.width + std::clamp(x + i, 0, texture.width - 1)];
  }
  return taps;
}

/// Σ w a c / Σ w a and Σ w a.
struct WeightedSum {
  Lanes color = {0, 0, 0, 0};
  float alpha = 0;

  void add(const Rgba& tap, float weight) {
    const float part = weight * tap.a;
    color += part * load(tap);
    alpha += part;
  }
  Rgba straight() const {
    if (!(alpha > 0)) return {0, 0, 0, 0};
    Lanes out = color / alpha;
    out[3] = alpha;
    return std::bit_cast<Rgba>(out);
  }
};

/// Largest overshoot of the kernel, in parts of the taps' range: (Σ|w| − 1) / 2 with Σ|w| ≤ (5/4)².
constexpr float kOvershoot = 9.0F / 32;

/// Of the taps that are visible; of alphas, of all.
class TapRange {
public:
  void add(const Rgba& tap) {
    const Lanes values = load(tap);
    const LaneBits seen = LaneBits{} + (tap.a > 0 ? -1 : 0);
    low_ = (seen & (values < low_)) != 0 ? values : low_;
    high_ = (seen & (values > high_)) != 0 ? values : high_;
  }

  Rgba held(const Rgba& color) const {
    const Lanes more = kOvershoot * (high_ - low_), least = low_ - more, most = high_ + more;
    Lanes out = load(color);
    out = out < least ? least : out;
    out = out > most ? most : out;
    out[3] = color.a < high_[3] ? color.a : high_[3];
    return std::bit_cast<Rgba>(out);
  }

private:
  Lanes low_ = {HUGE_VALF, HUGE_VALF, HUGE_VALF, HUGE_VALF};
  Lanes high_ = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF, 0};
};

} // namespace

Rgba BilinearTaps::mix(const Texture& texture, int x, int y, float tx, float ty) {
  const std::array<Rgba, 4> taps = gather<2>(texture, x, y);
  return mix_inside(taps.data(), 2, tx, ty);
}

Rgba BilinearTaps::mix_inside(const Rgba* first, int width, float tx, float ty) {
  const int at = 0;
  Rgba out;
  if (mix_bilinear_baseline(first, width, 1, &at, &tx, &ty, 0, &out)) return out;
  if (tx == 0 && ty == 0) return first[0];
  WeightedSum sum;
  sum.add(first[0], (1 - tx) * (1 - ty));
  sum.add(first[1], tx * (1 - ty));
  sum.add(first[width], (1 - tx) * ty);
  sum.add(first[width + 1], tx * ty);
  return sum.straight();
}

Rgba BicubicTaps::mix(const Texture& texture, int x, int y, float tx, float ty) {
  const std::array<Rgba, 16> taps = gather<4>(texture, x - 1, y - 1);
  return mix_inside(taps.data(), 4, tx, ty);
}

Rgba BicubicTaps::mix_inside(const Rgba* first, int width, float tx, float ty) {
  const int at = 0;
  Rgba out;
  if (mix_bicubic_baseline(first, width, 1, &at, &tx, &ty, 0, &out)) return out;
  if (tx == 0 && ty == 0) return first[width + 1];
  const Lanes wx = cubic_weights(tx), wy = cubic_weights(ty);
  WeightedSum sum;
  TapRange range;
  for (int j = 0; j < 4; ++j, first += width)
    for (int i = 0; i < 4; ++i) {
      sum.add(first[i], wx[i] * wy[j]);
      range.add(first[i]);
    }
  const Rgba color = sum.straight();
  return color.a > 0 ? range.held(color) : color;
}

} // namespace oversketch
