#pragma once

#include "ui/widgets/item.h"

#include <string>
#include <string_view>

namespace oversketch {

/// Between a panel's edges and what stands in it, design pixels.
inline constexpr float kPanelPad = 14;

/// A part of the side panel: a title at the left, a quiet summary at the right, and what is drawn while it lives; a
/// click on the title folds it.  Registered as `id`, its title as `id` + ".title".
///
///     const Section section(context, "panel.history", "History", "12", tip);
///     if (section.open()) …
class Section {
public:
  Section(const DrawContext& context, std::string_view id, std::string_view title, std::string_view summary,
          std::string_view tip, bool open_at_first = true);
  ~Section();
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;

  bool open() const { return open_; }

private:
  const DrawContext& context_;
  std::string id_;
  ImVec2 corner_;
  float width_ = 0;
  bool open_ = true;
};

/// A quiet row that unfolds what is seldom needed.
/// @param forced  it is open whatever was clicked: something in it is not as it was from the start.
/// @returns whether what belongs to it is to be drawn.
bool draw_more(const DrawContext& context, std::string_view id, const Tip& tip, bool forced);

} // namespace oversketch
