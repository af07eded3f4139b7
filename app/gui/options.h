#pragma once

#include "app/gui/window.h"

#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

namespace oversketch::gui {

/// What the command line asks of the editor.
struct Options {
  std::vector<std::filesystem::path> files;
  std::optional<std::filesystem::path> script;
  /// Where the script's output goes; its own folder without.
  std::optional<std::filesystem::path> out;
  std::optional<std::filesystem::path> record;
  std::optional<std::filesystem::path> ui_map;
  std::optional<std::filesystem::path> screenshot;
  std::optional<std::filesystem::path> frame_times;
  WindowSize size = {1440, 900};
  /// In place of the display's own scale.
  std::optional<float> scale;
  bool sample = false;
  bool exit_when_idle = false;
};

/// Reads the command line; help and complaints are printed here.
/// @returns the options, or the exit code: 0 after --help and --version, 2 after wrong usage.
std::variant<Options, int> parse_options(int argc, char** argv);

} // namespace oversketch::gui
