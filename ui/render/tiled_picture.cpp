#include "ui/render/tiled_picture.h"

#include "core/base/check.h"
#include "ui/widgets/imgui_compat.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

struct Span {
  int begin = 0;
  int end = 0;
};

/// Cuts a side into the inner parts of tiles.
std::vector<Span> cut(int side) {
  if (side <= TiledPicture::kSide) return {{0, side}};
  std::vector<Span> parts;
  constexpr int kInner = TiledPicture::kSide - 2;
  for (int begin = 0; begin < side; begin += kInner)
    parts.push_back({begin, std::min(begin + kInner, side)});
  return parts;
}

/// What lies between two points, in picture pixels.
struct Region {
  double x0, y0, x1, y1;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

Region visible_part(const Rect& rect, const View& view, ImVec2 corner, ImVec2 end) {
  const Point last = view.to_picture({end.x - corner.x, end.y - corner.y});
  return {std::max<double>(rect.x, view.origin.x), std::max<double>(rect.y, view.origin.y),
          std::min<double>(rect.right(), last.x), std::min<double>(rect.bottom(), last.y)};
}

bool is_translucent(const Rgba8& pixel) {
  return pixel.a < 255;
}

} // namespace

TiledPicture::TiledPicture(int width, int height, bool keeps_pixels)
    : width_(width), height_(height), keeps_pixels_(keeps_pixels) {
  CHECK(width > 0 && height > 0, "an empty picture");
  const Rect all = {0, 0, width, height};
  for (const Span& rows : cut(height)) {
    for (const Span& columns : cut(width)) {
      Tile tile;
      tile.inner = {columns.begin, rows.begin, columns.end - columns.begin, rows.end - rows.begin};
      tile.rect = intersect(grown(tile.inner, 1), all);
      tiles_.push_back(std::move(tile));
    }
  }
}

std::size_t TiledPicture::bytes() const {
  std::size_t pixels = 0;
  for (const Tile& tile : tiles_)
    if (!tile.texture.empty())
      pixels += static_cast<std::size_t>(tile.texture_width) * static_cast<std::size_t>(tile.texture_height);
  // Mip maps add a third.
  return pixels * sizeof(Rgba8) * 4 / 3 * (keeps_pixels_ ? 2 : 1);
}

void TiledPicture::put(int index, const Rect& from, const Raster<Rgba8>& pixels) {
  Tile& tile = tiles_[static_cast<std::size_t>(index)];
  const Rect part = intersect(from, tile.rect);
  if (part.empty()) return;
  if (tile.levels.empty()) tile.levels = MipLevels(tile.rect.width, tile.rect.height);
  const Rect changed = tile.levels.put(translated(part, -tile.rect.x, -tile.rect.y),
                                       &pixels.at(part.x - from.x, part.y - from.y), pixels.width());
  if (tile.texture.empty()) {
    tile.texture = Texture(tile.levels);
    tile.texture_width = tile.levels.level(0).width();
    tile.texture_height = tile.levels.level(0).height();
    tile.texture.update(tile.levels, tile.levels.level(0).rect());
  } else {
    tile.texture.update(tile.levels, changed);
  }
  for (int y = part.y; y < part.bottom() && !tile.translucent; ++y)
    tile.translucent = std::ranges::any_of(
        pixels.row(y - from.y).subspan(static_cast<std::size_t>(part.x - from.x), static_cast<std::size_t>(part.width)),
        is_translucent);
  if (!keeps_pixels_) tile.levels = {};
}

std::vector<int> TiledPicture::visible_tiles(const View& view, ImVec2 corner, ImVec2 end) const {
  std::vector<int> visible;
  for (int i = 0; i < tile_count(); ++i)
    if (!visible_part(tiles_[static_cast<std::size_t>(i)].inner, view, corner, end).empty()) visible.push_back(i);
  const Point middle = view.to_picture({(end.x - corner.x) / 2.0, (end.y - corner.y) / 2.0});
  const auto remoteness = [&](int i) {
    const Rect& inner = tiles_[static_cast<std::size_t>(i)].inner;
    return distance(middle, {inner.x + inner.width / 2.0, inner.y + inner.height / 2.0});
  };
  std::ranges::sort(visible, {}, remoteness);
  return visible;
}

void TiledPicture::draw(ImDrawList& list, int index, const View& view, ImVec2 corner, ImVec2 end,
                        const std::function<void(ImVec2, ImVec2)>& draw_under) const {
  const Tile& tile = tiles_[static_cast<std::size_t>(index)];
  const Region part = visible_part(tile.inner, view, corner, end);
  if (part.empty() || tile.texture.empty()) return;
  const auto to_window = [&](double x, double y) {
    const Point at = view.to_canvas({x, y});
    return ImVec2(static_cast<float>(corner.x + at.x), static_cast<float>(corner.y + at.y));
  };
  const auto to_texture = [&](double x, double y) {
    return ImVec2(static_cast<float>((x - tile.rect.x) / tile.texture_width),
                  static_cast<float>((y - tile.rect.y) / tile.texture_height));
  };
  const ImVec2 from = to_window(part.x0, part.y0), to = to_window(part.x1, part.y1);
  if (tile.translucent) draw_under(from, to);
  list.AddImage(compat::to_texture_id(tile.texture.name()), from, to, to_texture(part.x0, part.y0),
                to_texture(part.x1, part.y1));
}

} // namespace oversketch
