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

/// Which tabs are drawn when there is not room for all: a run that holds the one in front.
struct TabRun {
  std::size_t first = 0;
  std::size_t count = 0;
};
TabRun run_of_tabs(std::size_t tabs, std::size_t front, std::size_t room);

/// Click brings to the front, × or the middle button closes, + opens.  "tab.0", "tab.0.close", "tab.open".
void draw_tab_bar(const TabBarModel& model, const Area& area, const DrawContext& context);

} // namespace oversketch
