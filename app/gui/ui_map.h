#pragma once

#include "core/base/result.h"
#include "ui/state/editor_state.h"
#include "ui/widgets/frame_reply.h"
#include "ui/widgets/widget_map.h"

#include <filesystem>
#include <string>

namespace oversketch::gui {

/// What a frame showed, besides the editor's state.
struct ShownFrame {
  const WidgetMap& widgets;
  const CanvasRects& canvases;
  std::string title;
  std::string status;
  bool busy = false;
  /// Keys are text at the moment.
  bool wants_text = false;
  /// Where the pointer is, and how many events have been taken.
  Point pointer;
  std::size_t events = 0;
  WidgetMap::Box window;
};

/// The map as JSON text: where every widget and canvas is, in window pixels, and what the editor is at.
std::string print_ui_map(const EditorState& state, const ShownFrame& frame);

/// A file that holds the last map: replaced whole whenever the text is another one.
class UiMapFile {
public:
  explicit UiMapFile(std::filesystem::path path) : path_(std::move(path)) {}
  /// @errors file.write.
  Result<void> write(const std::string& text);

private:
  std::filesystem::path path_;
  std::string last_;
};

} // namespace oversketch::gui
