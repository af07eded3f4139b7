#include "core/image/pyramid.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace oversketch {
namespace {

Rgba mean_by_alpha(const Rgba& a, const Rgba& b, const Rgba& c, const Rgba& d) {
  const float alpha = (a.a + b.a) + (c.a + d.a);
  if (!(alpha > 0)) return {0, 0, 0, 0};
  const auto mean = [&](float Rgba::*of) {
    return ((a.a * a.*of + b.a * b.*of) + (c.a * c.*of + d.a * d.*of)) / alpha;
  };
  return {mean(&Rgba::r), mean(&Rgba::g), mean(&Rgba::b), 0.25F * alpha};
}

Rgba mean_of(const Rgba& a, const Rgba& b, const Rgba& c, const Rgba& d) {
  if (!((a.a == 1) & (b.a == 1) & (c.a == 1) & (d.a == 1))) return mean_by_alpha(a, b, c, d);
  const auto mean = [&](float Rgba::*of) { return 0.25F * ((a.*of + b.*of) + (c.*of + d.*of)); };
  return {mean(&Rgba::r), mean(&Rgba::g), mean(&Rgba::b), 1};
}

Raster<Rgba> halved(const Raster<Rgba>& from) {
  Raster<Rgba> to((from.width() + 1) / 2, (from.height() + 1) / 2);
  const auto whole = static_cast<std::size_t>(from.width() / 2);
  for (int y = 0; y < to.height(); ++y) {
    const std::span<const Rgba> upper = from.row(2 * y), lower = from.row(std::min(2 * y + 1, from.height() - 1));
    const std::span<Rgba> row = to.row(y);
    for (std::size_t x = 0; x < whole; ++x)
      row[x] = mean_of(upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]);
    if (whole < row.size())
      row[whole] = mean_of(upper[2 * whole], upper[2 * whole], lower[2 * whole], lower[2 * whole]);
  }
  return to;
}

} // namespace

struct ImagePyramid::Levels {
  Image image;
  std::mutex mutex;
  /// [k] is level k + 1; room for all, so that none moves when one is added.
  std::vector<Raster<Rgba>> smaller;
};

ImagePyramid::ImagePyramid(Image image) : levels_(std::make_shared<Levels>()) {
  levels_->image = std::move(image);
  levels_->smaller.reserve(static_cast<std::size_t>(top()));
}

const Image& ImagePyramid::image() const {
  return levels_->image;
}

int ImagePyramid::top() const {
  const int longer = std::max(levels_->image.width(), levels_->image.height());
  return longer < 2 ? 0 : static_cast<int>(std::bit_width(static_cast<unsigned>(longer - 1)));
}

const Raster<Rgba>& ImagePyramid::level(int k) const {
  CHECK(k >= 0 && k <= top(), "a level that the pyramid has");
  if (k == 0) return levels_->image.pixels();
  const std::lock_guard lock(levels_->mutex);
  std::vector<Raster<Rgba>>& smaller = levels_->smaller;
  while (smaller.size() < static_cast<std::size_t>(k))
    smaller.push_back(halved(smaller.empty() ? levels_->image.pixels() : smaller.back()));
  return smaller[static_cast<std::size_t>(k) - 1];
}

} // namespace oversketch
