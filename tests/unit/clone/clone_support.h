#pragma once

#include "core/clone/blend.h"
#include "core/geometry/mask.h"
#include "core/image/warped_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace oversketch {

inline Mask rect_mask(const Rect& r) {
  std::vector<Mask::Run> runs;
  for (int y = r.y; y < r.bottom(); ++y)
    runs.push_back({y, r.x, r.right()});
  return Mask(std::move(runs));
}

/// Every pixel of the box with the given chance.
inline Mask random_mask(const Rect& r, double chance, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution is_in(chance);
  std::vector<Mask::Run> runs;
  for (int y = r.y; y < r.bottom(); ++y)
    for (int x = r.x; x < r.right(); ++x)
      if (is_in(random)) runs.push_back({y, x, x + 1});
  return Mask(std::move(runs));
}

/// A square with a square hole.
inline Mask ring_mask(int x, int y, int outer, int hole) {
  std::vector<Mask::Run> runs;
  const int low = (outer - hole) / 2;
  for (int v = 0; v < outer; ++v) {
    if (v >= low && v < low + hole) {
      runs.push_back({y + v, x, x + low});
      runs.push_back({y + v, x + low + hole, x + outer});
    } else {
      runs.push_back({y + v, x, x + outer});
    }
  }
  return Mask(std::move(runs));
}

/// Small masks of every kind: one pixel, thin, with holes, scattered.
inline std::vector<Mask> shapes() {
  return {rect_mask({5, -3, 1, 1}),
          rect_mask({0, 0, 40, 1}),
          rect_mask({0, 0, 1, 40}),
          rect_mask({-20, -20, 17, 23}),
          ring_mask(3, 3, 15, 7),
          ring_mask(0, 0, 9, 7),
          random_mask({-5, -5, 40, 30}, 0.5, 1),
          random_mask({0, 0, 50, 50}, 0.9, 2),
          random_mask({0, 0, 60, 60}, 0.1, 3)};
}

/// The pixels by number.
inline std::vector<std::pair<int, int>> places(const Mask& mask) {
  std::vector<std::pair<int, int>> out;
  for (const Mask::Run& run : mask.runs())
    for (int x = run.x0; x < run.x1; ++x)
      out.push_back({x, run.y});
  return out;
}

/// Every pixel of the box whose centre passes.
template <class IsIn>
Mask mask_where(const Rect& box, IsIn is_in) {
  std::vector<Mask::Run> runs;
  for (int y = box.y; y < box.bottom(); ++y)
    for (int x = box.x; x < box.right(); ++x)
      if (is_in(x, y)) runs.push_back({y, x, x + 1});
  return Mask(std::move(runs));
}

inline Mask disc_mask(int x, int y, int radius) {
  return mask_where({x - radius, y - radius, 2 * radius + 1, 2 * radius + 1},
                    [=](int u, int v) { return (u - x) * (u - x) + (v - y) * (v - y) <= radius * radius; });
}

/// A band that winds from side to side.
inline Mask snake_mask(int width, int height, int band) {
  return mask_where({-7, 4, width, height}, [=](int x, int y) {
    const double middle = -7 + width / 2.0 + (width - band) / 2.0 * std::sin(0.05 * y);
    return std::abs(x - middle) < band / 2.0;
  });
}

/// A square with round holes.
inline Mask holed_mask(int side, int every, int radius) {
  return mask_where({3, -9, side, side}, [=](int x, int y) {
    const int u = (x - 3) % every - every / 2, v = (y + 9) % every - every / 2;
    return u * u + v * v > radius * radius;
  });
}

/// Large enough for leaves of many sizes.
inline std::vector<Mask> large_shapes() {
  return {disc_mask(40, -30, 120), snake_mask(300, 300, 40), holed_mask(200, 66, 6), rect_mask({-9, 5, 257, 130})};
}

inline Raster<Rgba> noise(int width, int height, unsigned seed, float low = 0, float high = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(low, high);
  Raster<Rgba> out(width, height);
  for (Rgba& p : out.values())
    p = {value(random), value(random), value(random), 1};
  return out;
}

inline WarpedRegion noise_region(const Rect& rect, unsigned seed, float low = 0, float high = 1) {
  return {rect, noise(rect.width, rect.height, seed, low, high)};
}

/// A part of a picture, edge pixels repeated outside, standing where it was.
inline WarpedRegion cut_out(const Raster<Rgba>& picture, const Rect& rect) {
  WarpedRegion out{rect, Raster<Rgba>(rect.width, rect.height)};
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x)
      out.pixels.at(x, y) =
          picture.at(std::clamp(rect.x + x, 0, picture.width() - 1), std::clamp(rect.y + y, 0, picture.height() - 1));
  return out;
}

/// Largest difference of any colour channel, 8-bit levels.
inline double difference_levels(const Raster<Rgba>& a, const Raster<Rgba>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const Rgba &p = a.values()[i], &q = b.values()[i];
    worst =
        std::max({worst, std::abs(255.0 * (p.r - q.r)), std::abs(255.0 * (p.g - q.g)), std::abs(255.0 * (p.b - q.b))});
  }
  return worst;
}

/// Poisson image editing by the book, in f itself, by Gauss-Seidel: for each pixel p of the mask
///   4 f_p − Σ_{q in Ω} f_q = Σ_{q not in Ω} f*_q + Σ_q v_pq
/// with v_pq the guiding difference.  Opaque pictures, encoded values.  Shares nothing with the library but its types.
class BookSolution {
public:
  using Colour = std::array<double, 3>;
  using Place = std::pair<int, int>;

  BookSolution(const Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask, int dx, int dy, BlendMode mode)
      : target_(target), source_(source), mask_(mask), dx_(dx), dy_(dy), mode_(mode) {
    for (const Mask::Run& run : mask.runs())
      for (int x = run.x0; x < run.x1; ++x)
        solution_[{x, run.y}] = f(x, run.y);
    double moved = 1;
    for (int sweep = 0; sweep < 20000 && moved > 1e-13; ++sweep)
      moved = relax();
  }

  /// At a pixel of the mask, mask coordinates.
  const Colour& at(int x, int y) const { return solution_.at({x, y}); }

private:
  double relax() {
    double moved = 0;
    for (auto& [place, value] : solution_) {
      const auto [x, y] = place;
      Colour sum{};
      for (const auto& [u, v] : {Place{x - 1, y}, Place{x + 1, y}, Place{x, y - 1}, Place{x, y + 1}}) {
        const Colour around = mask_.contains(u, v) ? solution_.at({u, v}) : f(u, v);
        const Colour guide = guidance(x, y, u, v);
        for (std::size_t k = 0; k < 3; ++k)
          sum[k] += around[k] + guide[k];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        moved = std::max(moved, std::abs(sum[k] / 4 - value[k]));
        value[k] = sum[k] / 4;
      }
    }
    return moved;
  }

  Colour f(int x, int y) const {
    const Rgba& p =
        target_.at(std::clamp(x + dx_, 0, target_.width() - 1), std::clamp(y + dy_, 0, target_.height() - 1));
    return {p.r, p.g, p.b};
  }

  Colour g(int x, int y) const {
    const Rgba& p = source_.pixels.at(x - source_.rect.x, y - source_.rect.y);
    if (mode_ != BlendMode::kMonochrome) return {p.r, p.g, p.b};
    const double grey = 0.2126 * p.r + 0.7152 * p.g + 0.0722 * p.b;
    return {grey, grey, grey};
  }

  Colour guidance(int x, int y, int u, int v) const {
    Colour from_source, from_target, out;
    double source_norm = 0, target_norm = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      from_source[k] = g(x, y)[k] - g(u, v)[k];
      from_target[k] = f(x, y)[k] - f(u, v)[k];
      source_norm += from_source[k] * from_source[k];
      target_norm += from_target[k] * from_target[k];
    }
    for (std::size_t k = 0; k < 3; ++k)
      switch (mode_) {
      case BlendMode::kMixed:
        out[k] = target_norm > source_norm ? from_target[k] : from_source[k];
        break;
      case BlendMode::kAverage:
        out[k] = 0.5 * (from_source[k] + from_target[k]);
        break;
      default:
        out[k] = from_source[k];
      }
    return out;
  }

  const Raster<Rgba>& target_;
  const WarpedRegion& source_;
  const Mask& mask_;
  int dx_, dy_;
  BlendMode mode_;
  std::map<Place, Colour> solution_;
};

} // namespace oversketch
