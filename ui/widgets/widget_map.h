#pragma once

#include <map>
#include <string>
#include <string_view>

namespace oversketch {

/// Where every button, menu entry and panel of a frame is, by its stable English id ("tool.sketch", "menu.file.open",
/// "panel.history"): what assistive and test tools read.  Window pixels.
class WidgetMap {
public:
  struct Box {
    float x = 0;
    float y = 0;
    float w = 0;
    float h = 0;
    bool operator==(const Box&) const = default;
  };

  void clear() {
    boxes_.clear();
    tips_.clear();
  }
  /// @param tip  what the widget says of itself when the pointer rests on it; panels and canvases have none.
  void add(std::string_view id, Box box, std::string_view tip = {}) {
    boxes_.insert_or_assign(std::string(id), box);
    if (!tip.empty()) tips_.insert_or_assign(std::string(id), std::string(tip));
  }
  const std::map<std::string, Box, std::less<>>& boxes() const { return boxes_; }
  const std::map<std::string, std::string, std::less<>>& tips() const { return tips_; }

private:
  std::map<std::string, Box, std::less<>> boxes_;
  std::map<std::string, std::string, std::less<>> tips_;
};

} // namespace oversketch
