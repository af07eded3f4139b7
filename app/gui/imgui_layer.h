#pragma once

#include "app/gui/window.h"

#include "core/base/result.h"
#include "core/image/display.h"
#include "ui/theme/theme.h"

#include <filesystem>
#include <vector>

namespace oversketch::gui {

/// Dear ImGui, between the window and what is drawn.
///
/// Its backend is not let install callbacks of its own: it is handed the same batch of events that the editor's frame
/// gets, so that both see one and the same moment (input_queue.h).
class ImGuiLayer {
public:
  explicit ImGuiLayer(Window& window);
  ~ImGuiLayer();
  ImGuiLayer(const ImGuiLayer&) = delete;
  ImGuiLayer& operator=(const ImGuiLayer&) = delete;

  /// Style and fonts for a theme and scale; nothing is done when they are the present ones.
  /// @errors fonts.missing.
  Result<void> set_look(Theme theme, float scale, const std::filesystem::path& assets);
  const ThemeLook& look() const { return look_; }

  void begin_frame(const std::vector<RawEvent>& batch);
  /// The pointer that Dear ImGui wants.
  CursorShape cursor() const;
  /// Ends a frame that nobody shall see.
  void drop_frame();
  /// Ends a frame and puts it on the window.
  void end_frame();
  /// The pixels of the last frame, drawn once more where nobody sees it.
  Raster<Rgba8> read_last_frame() const;

private:
  void forward(const RawEvent& event);
  void set_pointer();
  void paint() const;

  Window& window_;
  ThemeLook look_;
  Point pointer_;
  bool inside_ = false;
  std::array<bool, 3> buttons_{};
};

} // namespace oversketch::gui
