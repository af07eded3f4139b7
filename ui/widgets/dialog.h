#pragma once

#include "ui/canvas/input.h"
#include "ui/widgets/item.h"

#include <string>
#include <string_view>

namespace oversketch {

/// A dialog in the window's middle, the rest of the window behind it dimmed and out of reach; what is drawn while it
/// lives stands in it.  Never larger than the window: what does not fit scrolls.
class Dialog {
public:
  /// @param size  design pixels; a height of 0 is what its content needs.
  Dialog(const DrawContext& context, std::string_view id, std::string_view title, ImVec2 size);
  ~Dialog();
  Dialog(const Dialog&) = delete;
  Dialog& operator=(const Dialog&) = delete;

  /// It was not there in the frame before.
  bool appears() const { return appears_; }

private:
  const DrawContext& context_;
  std::string id_;
  bool auto_height_;
  bool appears_ = false;
  float pad_ = 0;
};

/// Whether a key went down among the events.
bool is_pressed(const InputEvents& events, Key key);

/// Answers at the dialog's lower right: each call puts one button to the left of the one before.
class AnswerRow {
public:
  explicit AnswerRow(const DrawContext& context);
  bool draw(std::string_view id, std::string_view label, const Tip& tip, bool preferred = false, bool enabled = true);

private:
  const DrawContext& context_;
  float right_ = 0;
  float top_ = 0;
  float left_ = 0;
};

} // namespace oversketch
