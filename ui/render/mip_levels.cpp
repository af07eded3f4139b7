#include "ui/render/mip_levels.h"

#include "core/base/check.h"

#include <algorithm>

namespace oversketch {
namespace {

constexpr int kMultiple = 1 << (MipLevels::kCount - 1);

int rounded_up(int side) {
  return (side + kMultiple - 1) / kMultiple * kMultiple;
}

Rgba8 mean(const Rgba8& a, const Rgba8& b, const Rgba8& c, const Rgba8& d) {
  const unsigned alpha = static_cast<unsigned>(a.a) + b.a + c.a + d.a;
  const auto level = [](unsigned sum, unsigned count) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  if (alpha == 4 * 255)
    return {level(static_cast<unsigned>(a.r) + b.r + c.r + d.r, 4),
            level(static_cast<unsigned>(a.g) + b.g + c.g + d.g, 4),
            level(static_cast<unsigned>(a.b) + b.b + c.b + d.b, 4), 255};
  if (alpha == 0) return {0, 0, 0, 0};
  const auto weighted = [&](std::uint8_t Rgba8::*channel) {
    const auto part = [&](const Rgba8& p) { return static_cast<unsigned>(p.*channel) * p.a; };
    return level(part(a) + part(b) + part(c) + part(d), alpha);
  };
  return {weighted(&Rgba8::r), weighted(&Rgba8::g), weighted(&Rgba8::b), level(alpha, 4)};
}

void halve(const Raster<Rgba8>& from, Raster<Rgba8>& to, const Rect& rect) {
  for (int y = rect.y; y < rect.bottom(); ++y) {
    const auto upper = from.row(2 * y), lower = from.row(2 * y + 1);
    const auto out = to.row(y);
    for (auto x = static_cast<std::size_t>(rect.x); x < static_cast<std::size_t>(rect.right()); ++x)
      out[x] = mean(upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]);
  }
}

} // namespace

Rect shrunk(const Rect& rect, int k) {
  const int up = (1 << k) - 1;
  const int x = rect.x >> k, y = rect.y >> k;
  return {x, y, ((rect.right() + up) >> k) - x, ((rect.bottom() + up) >> k) - y};
}

MipLevels::MipLevels(int width, int height) : width_(width), height_(height) {
  for (int k = 0; k < kCount; ++k)
    levels_.emplace_back(rounded_up(width) >> k, rounded_up(height) >> k);
}

Rect MipLevels::put(const Rect& rect, const Rgba8* pixels, int stride) {
  CHECK(intersect(rect, {0, 0, width_, height_}) == rect && !rect.empty(), "pixels outside the picture");
  Raster<Rgba8>& base = levels_.front();
  for (int y = 0; y < rect.height; ++y) {
    const auto row = base.row(rect.y + y);
    std::copy_n(pixels + static_cast<std::ptrdiff_t>(y) * stride, rect.width, row.begin() + rect.x);
    if (rect.right() == width_) std::fill(row.begin() + width_, row.end(), row[static_cast<std::size_t>(width_) - 1]);
  }
  Rect changed = rect;
  if (rect.right() == width_) changed.width = base.width() - rect.x;
  if (rect.bottom() == height_) {
    changed.height = base.height() - rect.y;
    const auto last =
        base.row(height_ - 1).subspan(static_cast<std::size_t>(changed.x), static_cast<std::size_t>(changed.width));
    for (int y = height_; y < base.height(); ++y)
      std::ranges::copy(last, base.row(y).begin() + changed.x);
  }
  for (int k = 1; k < kCount; ++k)
    halve(levels_[static_cast<std::size_t>(k) - 1], levels_[static_cast<std::size_t>(k)], shrunk(changed, k));
  return changed;
}

} // namespace oversketch
