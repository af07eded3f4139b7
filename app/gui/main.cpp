// The editor.
#include "app/assets.h"
#include "app/gui/frame_loop.h"
#include "app/gui/options.h"
#include "app/gui/termination.h"
#include "app/gui/window.h"

#include <cstdio>
#include <exception>

namespace {

using namespace oversketch;

Result<void> run(const gui::Options& options) {
  auto assets = find_assets();
  if (!assets) return assets.error();
  // Before there are threads: a driver makes some with the window.
  gui::hold_end_signals();
  auto window = gui::Window::open("Oversketch", options.size);
  if (!window) return window.error();
  return gui::FrameLoop(options, *assets, **window).run();
}

int fail(const char* text) {
  std::fprintf(stderr, "oversketch: %s\n", text);
  return 1;
}

} // namespace

int main(int argc, char** argv) {
  try {
    const auto options = gui::parse_options(argc, argv);
    if (const int* code = std::get_if<int>(&options)) return *code;
    const auto done = run(std::get<gui::Options>(options));
    return done ? 0 : fail(to_string(done.error()).c_str());
  } catch (const std::bad_alloc&) {
    return fail("memory: there is not enough memory for this");
  } catch (const std::exception& problem) {
    return fail(problem.what());
  }
}
