#pragma once

#include "ui/widgets/item.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace oversketch {

/// A number that a slider sets.
struct SliderSpec {
  /// What the bar reaches; typed numbers may go from `least` to `most`.
  double low = 0;
  double high = 1;
  double least = 0;
  double most = 1;
  /// What a double click goes back to.
  double initial = 0;
  /// The bar grows by factors; then low > 0.
  bool logarithmic = false;
  bool whole = false;
  /// Shown and typed are `factor` times the value: 100 for per cent.
  double factor = 1;
  /// "px", "%", "×"; empty for pure numbers.
  std::string_view unit = {};
};

/// What a person did with a slider in this frame.
struct SliderChange {
  enum class Kind {
    kNone,
    /// It is being dragged and stands here: for the preview of a gesture.
    kPreview,
    /// The drag has ended: the last preview stays.
    kCommit,
    /// Esc, or the drag came back to nothing: as it was before.
    kAbandon,
    /// Set at once, without a drag: typed, clicked, or reset.
    kSet,
    /// What was typed is no number, or out of range; `text` says so.
    kRefused,
  };
  Kind kind = Kind::kNone;
  double value = 0;
  std::string text = {};
};

/// A bar filled up to its value, with the number and its unit at the right, in a row with its label.
///
/// A drag sets what lies under the pointer, with Shift ten times finer from where it was; Esc gives it up.  A click
/// sets too, but only after the time of a double click, which resets.  Ctrl+click types: Enter or a click elsewhere
/// takes the number, Esc does not.
///
/// @param id  stable; the bar's place is registered under it.
/// @param value  of the model; while it has not caught up with what was done here, the latter is shown.
SliderChange draw_slider(const DrawContext& context, std::string_view id, std::string_view label, const Tip& tip,
                         double value, const SliderSpec& spec);

/// Sends what was done: previews and their commit as one gesture, what is set at once as one command.
void emit_slider(ActionSink& sink, const SliderChange& change, const std::function<Command(double)>& command);

/// "10 px", "100 %", "0.15".
std::string format_value(double value, const SliderSpec& spec);
/// A number, its decimals after a point or a comma, with or without its unit.
std::optional<double> parse_value(std::string_view text, const SliderSpec& spec);
/// The bar's filled share, 0…1, and the value of a share, rounded to what the bar shows.
double share_of(double value, const SliderSpec& spec);
double value_at(double share, const SliderSpec& spec);

} // namespace oversketch
