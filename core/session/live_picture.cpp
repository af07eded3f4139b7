#include "core/session/live_picture.h"

#include <algorithm>

namespace oversketch::live {

namespace {

/// The smallest rectangle round all pixels that differ; none when all are equal.
Rect changed_rect(const Raster<Rgba8>& a, const Raster<Rgba8>& b) {
  int x0 = a.width(), x1 = 0, y0 = a.height(), y1 = 0;
  for (int y = 0; y < a.height(); ++y) {
    const auto row = a.row(y), other = b.row(y);
    const auto first = std::ranges::mismatch(row, other).in1;
    if (first == row.end()) continue;
    x0 = std::min(x0, static_cast<int>(first - row.begin()));
    int end = a.width();
    while (row[static_cast<std::size_t>(end - 1)] == other[static_cast<std::size_t>(end - 1)])
      --end;
    x1 = std::max(x1, end);
    y0 = std::min(y0, y);
    y1 = y + 1;
  }
  return x0 < x1 ? Rect{x0, y0, x1 - x0, y1 - y0} : Rect{};
}

} // namespace

Result<void> Picture::update(Session& session, Quality quality, const Watch& watch, PictureUpdate& changed) {
  if (quality == Quality::kRest || session.shown().empty()) return {};
  const auto composite = session.composite(watch);
  if (!composite) return composite.error();
  Raster<Rgba8> now = to_display(*composite);
  changed.width = now.width();
  changed.height = now.height();
  changed.whole = now.rect() != pixels_.rect();
  const Rect rect = changed.whole ? now.rect() : changed_rect(now, pixels_);
  pixels_ = std::move(now);
  if (rect.width == 0) return {};
  PicturePatch patch{rect.x, rect.y, Raster<Rgba8>(rect.width, rect.height)};
  for (int y = 0; y < rect.height; ++y)
    std::ranges::copy(
        pixels_.row(rect.y + y).subspan(static_cast<std::size_t>(rect.x), static_cast<std::size_t>(rect.width)),
        patch.pixels.row(y).begin());
  changed.patches.push_back(std::move(patch));
  return {};
}

} // namespace oversketch::live
