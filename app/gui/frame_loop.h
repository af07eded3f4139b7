#pragma once

#include "app/gui/frame_times.h"
#include "app/gui/imgui_layer.h"
#include "app/gui/options.h"
#include "app/gui/termination.h"
#include "app/gui/ui_map.h"
#include "app/gui/window.h"

#include "ui/render/gl_pictures.h"
#include "ui/state/editor.h"
#include "ui/state/settings.h"
#include "ui/window_state.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>

namespace oversketch::gui {

/// The editor in its window: waits, draws a frame when something has changed, and carries out what it asked for.
class FrameLoop {
public:
  FrameLoop(Options options, std::filesystem::path assets, Window& window);
  ~FrameLoop();

  /// Until the window is closed, or the program told to end: then nobody is asked about what is not saved, and the
  /// journals stay.
  /// @errors what --script, --screenshot, --record or the map of the window met with; those of the fonts.
  Result<void> run();

private:
  void open_what_was_asked();
  double wait_time() const;
  /// Whether there is a reason to draw.
  bool gather();
  Result<void> set_look();
  /// One pass of Dear ImGui over the whole window, which takes what was gathered.
  Result<void> lay_out();
  /// Passes until the panels have settled, each but the last carried out; the last is drawn.
  Result<void> draw();
  Result<void> write_map(const WidgetMap& widgets, const FrameReply& reply);
  void carry_out();
  void take_drops();
  Result<void> settle();
  Result<void> take_screenshot() const;
  std::string title() const;
  float scale() const;

  Options options_;
  std::filesystem::path assets_;
  Window& window_;
  /// Set by workers.
  std::atomic<bool> changed_ = true;
  PreferencesKeeper keeper_;
  ImGuiLayer imgui_;
  GlPictures pictures_;
  Editor editor_;
  WindowState window_state_;
  std::optional<UiMapFile> map_;
  FrameTimes times_;
  ActionSink sink_;
  std::vector<RawEvent> batch_;
  WidgetMap widgets_;
  FrameReply reply_;
  Point pointer_;
  /// Of the window, as it was laid out last.
  Point size_;
  std::size_t events_ = 0;
  /// Until the panels have settled.
  int passes_due_ = 0;
  bool screenshot_taken_ = false;
  bool ended_ = false;
  std::optional<Error> first_problem_;
  std::atomic<bool> told_to_end_ = false;
  Termination termination_;
};

} // namespace oversketch::gui
