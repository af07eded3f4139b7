#pragma once

#include <filesystem>
#include <vector>

namespace oversketch {

enum class Theme { kDark, kLight };

/// How a drawn stroke is smoothed, scaled with the zoom: not at all; a short average; a long one that catches up at the
/// end.
enum class Smoothing { kNone, kBasic, kStabiliser };

/// What a person sets once.  Kept in the user's configuration folder.
struct Preferences {
  Theme theme = Theme::kDark;
  /// Times the display's own scale, 0.5…3.
  double ui_scale = 1;
  /// The wheel zooms; otherwise it scrolls, and Ctrl+wheel zooms.
  bool wheel_zooms = true;
  Smoothing smoothing = Smoothing::kBasic;
  /// How near a stroke's ends must come to a curve to replace a part of it, screen pixels, 1…100.
  double tolerance_px = 10;
  /// Of what the undo history alone holds, most of it pictures.
  double history_mib = 2048;
  /// Of the pictures that a document has, 16 bytes a pixel and their files: what asks for more is not opened.
  double pictures_mib = 8192;
  /// The desktop's own file dialog instead of this program's, where there is one.
  bool system_dialog = false;
  /// The newest first.
  std::vector<std::filesystem::path> recent_files;

  bool operator==(const Preferences&) const = default;
};

} // namespace oversketch
