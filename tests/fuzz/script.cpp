// A script's text: read, printed, read again; and run, where its pictures are small, with all its steps.

#include "core/image/image_io.h"
#include "core/io/runner.h"

#include "tests/fuzz/documents.h"
#include "tests/fuzz/scratch.h"

#include <set>
#include <string>
#include <vector>

namespace oversketch::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int kMostSteps = 12, kMostSide = 96;

/// Whether a step's cost is small, and it reads nothing of this machine.
struct IsHarmless {
  static bool is_own(const std::string& path) { return path.find("..") == std::string::npos && path[0] != '/'; }
  static bool is_own(const ImageRef& ref) { return !ref.name.empty() && is_own(ref.name); }

  bool operator()(const Command& command) const { return std::visit(*this, command); }
  bool operator()(const DocumentNew& c) const {
    return c.width.value_or(0) <= kMostSide && c.height.value_or(0) <= kMostSide && (!c.target || is_own(*c.target));
  }
  bool operator()(const TargetSet& c) const { return is_own(c.target); }
  bool operator()(const LayerAdd& c) const { return is_own(c.source); }
  bool operator()(const LayerTransform& c) const { return c.scale < 4; }
  bool operator()(const LayerSet& c) const { return c.cell_px.value_or(9) > 1 && c.iterations.value_or(0) < 20; }
  bool operator()(const OpenStep& s) const { return !s.path.empty() && is_own(s.path); }
  bool operator()(const ExpectStep& s) const { return !s.image || (!s.image->empty() && is_own(*s.image)); }
  bool operator()(const auto&) const { return true; }
};

class Script {
public:
  Script() {
    fs::create_directories(scratch_ / "script");
    for (int kind = 0; kind < 2; ++kind)
      MUST_HOLD(save_image(striped_image(60 - 20 * kind, 50, kind),
                           scratch_ / ("script/" + std::string(1, static_cast<char>('a' + kind)) + ".png"))
                    .ok(),
                "pictures to work with");
  }

  void run(std::string_view text) {
    const auto lines = parse_script(text, "script");
    if (!lines) {
      MUST_HOLD(!lines.error().code.empty() && lines.error().where.starts_with("script"), "an error tells the place");
      return;
    }
    bool harmless = lines->size() <= kMostSteps;
    for (const ScriptLine& line : *lines) {
      const std::string printed = print_step(line.step);
      const auto again = parse_step(printed);
      MUST_HOLD(again.ok(), "what is printed can be read: " + printed);
      MUST_HOLD(*again == line.step, "what is read is what was printed: " + printed);
      harmless = harmless && std::visit(IsHarmless{}, line.step);
    }
    if (harmless) execute(*lines);
  }

private:
  void execute(const std::vector<ScriptLine>& lines) {
    fs::remove_all(scratch_ / "out");
    fs::create_directories(scratch_ / "out");
    Session session;
    const auto done = run_script(session, lines, "script", {scratch_ / "script", scratch_ / "out"}, {});
    if (done)
      for (const fs::path& path : done->written)
        MUST_HOLD(fs::is_regular_file(path), "what is said to be written is there");
    check_session(session);
    std::set<std::string> found;
    for (const char* folder : {".", "script"})
      for (const auto& entry : fs::directory_iterator(scratch_ / folder))
        found.insert(entry.path().filename().string());
    MUST_HOLD((found == std::set<std::string>{"a.png", "b.png", "out", "script"}), "nothing is written elsewhere");
  }

  Scratch scratch_;
};

} // namespace
} // namespace oversketch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static oversketch::fuzz::Script script;
  script.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
