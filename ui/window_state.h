#pragma once

#include "ui/state/editor_state.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace oversketch {

/// The desktop's own file dialog, where there is one.  Started, then asked once a frame; nobody waits for it.
class SystemDialog {
public:
  virtual ~SystemDialog() = default;
  virtual bool available() const = 0;
  /// One at a time; a second start ends the first.
  virtual void start(const FileRequest& request) = 0;
  /// Nothing while it is open; then once its answer, an empty path when none was given.
  virtual std::optional<std::filesystem::path> poll() = 0;
  virtual void stop() = 0;
};

/// What the window keeps from frame to frame that is neither a document's nor the editor's: what is being typed, which
/// sections are folded, where the side panel's edge is.
class WindowState {
public:
  /// @param wake    makes the window draw a frame soon; called from other threads (a preview has been read).
  /// @param system  may be null.
  /// @param samples  the folder of the samples, a place of the file browser; may be empty.
  explicit WindowState(std::function<void()> wake = {}, std::unique_ptr<SystemDialog> system = {},
                       std::filesystem::path samples = {});
  ~WindowState();
  WindowState(const WindowState&) = delete;
  WindowState& operator=(const WindowState&) = delete;

  struct Parts;
  Parts& parts() { return *parts_; }

private:
  std::unique_ptr<Parts> parts_;
};

} // namespace oversketch
