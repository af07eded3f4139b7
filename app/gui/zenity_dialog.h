#pragma once

#include "ui/window_state.h"

#include <string>
#include <vector>

#include <sys/types.h>

namespace oversketch::gui {

/// GNOME's file dialog by the program `zenity`, run as a child: started, then polled; the window never waits for it.
/// @threads the window's.
class ZenityDialog : public SystemDialog {
public:
  /// Looks for the program on the PATH, once.
  ZenityDialog();
  ~ZenityDialog() override;
  ZenityDialog(const ZenityDialog&) = delete;
  ZenityDialog& operator=(const ZenityDialog&) = delete;

  bool available() const override { return !program_.empty(); }
  void start(const FileRequest& request) override;
  std::optional<std::filesystem::path> poll() override;
  void stop() override;

private:
  std::filesystem::path program_;
  pid_t child_ = -1;
  /// Where the child writes its answer; −1 when there is none.
  int output_ = -1;
  std::string answer_;
};

/// What the program is called with.
std::vector<std::string> zenity_arguments(const FileRequest& request);

} // namespace oversketch::gui
