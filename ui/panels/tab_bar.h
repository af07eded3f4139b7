#pragma once

#include "ui/panels/window_layout.h"
#include "ui/state/editor_state.h"
#include "ui/widgets/draw_context.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oversketch {

struct TabRow {
  std::string name;
  /// Where its file is, or that there is none yet.
  std::string tip;
  bool modified = false;
};

struct TabBarModel {
  std::vector<TabRow> tabs;
  std::size_t front = 0;
};

TabBarModel make_tab_bar_model(const EditorState& state);

/// What the bar keeps from frame to frame: which tabs are drawn while there is not room for all, and for which tab in
/// front, of how many, in what room that was chosen.
struct TabBarState {
  float first = 0;
  std::size_t front = 0;
  std::size_t tabs = 0;
  std::size_t room = 0;
};

struct TabRun {
  std::size_t first = 0;
  std::size_t count = 0;
};
/// The tabs that are drawn.  The one in front is among them when another comes to the front, tabs come or go, or the
/// room changes; after that the wheel scrolls.
/// @param wheel  tabs, upwards or to the left; may be a part of one.
TabRun scroll_tabs(TabBarState& state, std::size_t tabs, std::size_t front, std::size_t room, float wheel);

/// Click brings to the front, × or the middle button closes, + opens; where there is not room for all, the wheel
/// scrolls and a button lists them.  "tab.0", "tab.0.close", "tab.open", "tab.list", "tab.list.0".
void draw_tab_bar(const TabBarModel& model, TabBarState& state, const Area& area, const DrawContext& context);

} // namespace oversketch
