#include "app/gui/options.h"

#include "app/version.h"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace oversketch::gui {
namespace {

constexpr int kUsage = 2;

/// "1280x800".
std::optional<WindowSize> parse_size(const std::string& text) {
  WindowSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) != 2) return std::nullopt;
  const auto fits = [](int side) { return side >= 64 && side <= 16384; };
  return fits(size.width) && fits(size.height) ? std::optional(size) : std::nullopt;
}

} // namespace

std::variant<Options, int> parse_options(int argc, char** argv) {
  Options options;
  std::string size;
  CLI::App app("Oversketch: deforms parts of pictures to sketches and blends them in.", "oversketch");
  app.set_version_flag("--version", std::string("Oversketch ") + kVersion);
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.add_option("files", options.files, "Projects, scripts and pictures to open, each in a tab");
  app.add_flag("--sample", options.sample, "Open the sample");
  app.add_option("--script", options.script, "Run a script in the window")->check(CLI::ExistingFile);
  app.add_option("--out", options.out, "Where the script's output goes (default: the script's folder)");
  app.add_option("--record", options.record,
                 "Write what was done to the document in front as a script (.jsonl), at the end");
  app.add_option("--ui-map", options.ui_map, "Keep a JSON file of where everything in the window is");
  app.add_option("--screenshot", options.screenshot, "Write the window as a picture (.png) as soon as nothing moves");
  app.add_option("--frame-times", options.frame_times,
                 "Write how long the window's thread worked for its frames (.json), at the end");
  app.add_option("--size", size, "Of the window, such as 1280x800")->check([](const std::string& text) {
    return parse_size(text) ? std::string() : "a size is WIDTHxHEIGHT, 64 to 16384 each: " + text;
  });
  app.add_option("--scale", options.scale, "Pixels per design pixel, in place of the display's")
      ->check(CLI::Range(0.5, 4.0));
  app.add_flag("--exit-when-idle", options.exit_when_idle, "End as soon as nothing is left to do");
  app.footer("Exit codes: 0 done, 1 no window could be opened, or what was asked for failed (the reason is on stderr), "
             "2 wrong usage.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    return app.exit(end) == 0 ? 0 : kUsage;
  }
  if (!size.empty()) options.size = *parse_size(size);
  return options;
}

} // namespace oversketch::gui
