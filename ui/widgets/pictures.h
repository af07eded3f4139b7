#pragma once

#include "core/session/live_session.h"
#include "ui/canvas/view.h"

#include <imgui.h>

#include <memory>

namespace oversketch {

/// Pictures on the graphics hardware, as panels and canvases see them.  The window's own keeps textures; tests have one
/// that draws nothing.
class Pictures {
public:
  virtual ~Pictures() = default;

  /// A small picture as one texture: thumbnails and previews.  Kept while it is drawn, forgotten some frames later.
  virtual ImTextureID small(const std::shared_ptr<const Raster<Rgba8>>& pixels) = 0;

  /// Draws a picture of any size: its pixel p lands at `corner` + view.to_canvas(p), window pixels; only what lies
  /// between `corner` and `end` is drawn.  Hard pixels when zoomed far in, mip maps when zoomed out, a checkerboard
  /// under what is transparent.
  virtual void draw(ImDrawList& list, const ShownPicture& picture, const View& view, ImVec2 corner, ImVec2 end) = 0;

  /// The same of a session's result, as far as it has been brought up to date.
  virtual void draw_result(ImDrawList& list, const LiveSession& session, const View& view, ImVec2 corner,
                           ImVec2 end) = 0;
  /// Takes what the session's picture has become; once a frame.
  virtual void update_result(LiveSession& session) = 0;
};

} // namespace oversketch
