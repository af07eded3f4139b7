#pragma once

#include "core/base/result.h"

#include <array>
#include <filesystem>
#include <vector>

namespace oversketch::gui {

/// What the window's thread does for a frame, in the order in which it does it.
enum class FramePart {
  /// Results taken from the workers, actions carried out, the map written.
  kState,
  /// Pixels that changed, handed to the graphics hardware.
  kUpload,
  /// Input, panels, canvases, overlays: all that becomes lists of triangles.
  kLayout,
  /// Those drawn and shown; on a machine without graphics hardware most of a frame.
  kDraw,
};
inline constexpr std::array kFrameParts = {"state", "upload", "layout", "draw"};

/// Processor time of the calling thread for each part of each frame.  Time spent waiting is not counted, nor is what
/// workers and the graphics driver's own threads do.
class FrameTimes {
public:
  /// Since the last call, or since the thread began: was spent on `part` of the frame in hand.
  void spent_on(FramePart part);
  /// Since the last call: belongs to no frame.
  void skip();
  void end_frame();
  std::size_t frames() const { return frames_.size(); }

  /// {"frames": n, "own": {"median_ms", "p95_ms", "worst_ms", "worst_frame"}, and the same for each part}; own is all
  /// but draw, and the first frame is number 0: it makes the letters.
  /// @errors file.write.
  Result<void> write(const std::filesystem::path& path) const;

private:
  using Frame = std::array<double, kFrameParts.size()>;

  std::vector<Frame> frames_;
  Frame now_{};
  double last_ms_ = 0;
};

} // namespace oversketch::gui
