#pragma once

#include "ui/render/texture.h"
#include "ui/render/tiled_picture.h"
#include "ui/widgets/pictures.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>

namespace oversketch {

/// Pictures as OpenGL 3.3 textures.
///
/// What is to be uploaded is uploaded in parts, some milliseconds' worth a frame, so that a large picture never holds
/// up a frame: until a part of it is there, nothing is shown in its place.
/// @threads the window's; its OpenGL context is the present one for the object's whole life.
class GlPictures : public Pictures {
public:
  /// @param budget_bytes  what pictures may take that are not in the present frame.
  explicit GlPictures(std::size_t budget_bytes = std::size_t{768} << 20);

  ImTextureID small(const std::shared_ptr<const Raster<Rgba8>>& pixels) override;
  void draw(ImDrawList& list, const ShownPicture& picture, const View& view, ImVec2 corner, ImVec2 end) override;
  void draw_result(ImDrawList& list, const LiveSession& session, const View& view, ImVec2 corner, ImVec2 end) override;
  void update_result(LiveSession& session) override;

  /// To be called before each frame.
  void begin_frame();
  /// Whether something still waits to be uploaded: another frame is due at once.
  bool wants_frame() const { return behind_; }
  /// Forgets the results of all other sessions; to be called before a session that is gone could be replaced by
  /// another one in the same place.
  void keep_results(std::span<const LiveSession* const> sessions);

private:
  struct Small {
    Texture texture;
    std::uint64_t last_frame = 0;
  };
  struct Shown {
    std::unique_ptr<TiledPicture> tiles;
    std::uint64_t last_frame = 0;
  };
  struct Result {
    std::unique_ptr<TiledPicture> tiles;
    std::deque<PicturePatch> waiting;
    /// Tiles of the first waiting patch that are done.
    int done_tiles = 0;
  };

  bool has_time() const;
  /// Does a piece of uploading and notes how long it took.
  template <class Work>
  void timed(const Work& work);
  void upload_waiting(Result& result);
  void draw_tiles(ImDrawList& list, TiledPicture& tiles, const View& view, ImVec2 corner, ImVec2 end);
  void bind(ImDrawList& list, Sampling sampling) const;
  void forget_unused();

  std::size_t budget_bytes_;
  Samplers samplers_;
  Texture checker_;
  std::uint64_t frame_ = 0;
  bool behind_ = false;
  std::chrono::steady_clock::duration spent_{};
  std::map<std::shared_ptr<const Raster<Rgba8>>, Small> small_;
  std::map<Hash, Shown> shown_;
  std::map<const LiveSession*, Result> results_;
};

} // namespace oversketch
