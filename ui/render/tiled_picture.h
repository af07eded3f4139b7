#pragma once

#include "ui/canvas/view.h"
#include "ui/render/texture.h"

#include <imgui.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace oversketch {

/// What a person sees of a picture of any size: textures of at most kSide², each with a border that repeats a pixel of
/// its neighbours, so that no seam shows when it is magnified.
class TiledPicture {
public:
  static constexpr int kSide = 256;

  /// @param keeps_pixels  whether parts of it will be put anew: then a copy stays beside the textures.
  TiledPicture(int width, int height, bool keeps_pixels);

  int width() const { return width_; }
  int height() const { return height_; }
  /// On the graphics hardware, and besides.
  std::size_t bytes() const;

  int tile_count() const { return static_cast<int>(tiles_.size()); }
  /// The part of the picture that a tile's texture holds.
  const Rect& tile_rect(int tile) const { return tiles_[static_cast<std::size_t>(tile)].rect; }
  /// Whether a tile has never been put.
  bool tile_missing(int tile) const { return tiles_[static_cast<std::size_t>(tile)].texture.empty(); }
  /// Puts what the tile has of a part of the picture.
  /// @param from  the rectangle whose pixels are given; for the first time the tile's whole rectangle lies in it.
  void put(int tile, const Rect& from, const Raster<Rgba8>& pixels);

  /// The tiles that a view shows, the middle ones first.
  std::vector<int> visible_tiles(const View& view, ImVec2 corner, ImVec2 end) const;
  /// Draws one tile's part of the picture.
  /// @param draw_under  called for a tile with transparency, with the corners of what it shows.
  void draw(ImDrawList& list, int tile, const View& view, ImVec2 corner, ImVec2 end,
            const std::function<void(ImVec2, ImVec2)>& draw_under) const;

private:
  struct Tile {
    /// With the border, and without.
    Rect rect;
    Rect inner;
    Texture texture;
    MipLevels levels;
    int texture_width = 0;
    int texture_height = 0;
    bool translucent = false;
  };

  int width_;
  int height_;
  bool keeps_pixels_;
  std::vector<Tile> tiles_;
};

} // namespace oversketch
