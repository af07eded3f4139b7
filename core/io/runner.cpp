#include "core/io/runner.h"

#include "core/base/file.h"
#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/io/project.h"
#include "core/io/recorder.h"
#include "core/session/picture_loader.h"
#include "core/session/report.h"

#include <nlohmann/json.hpp>

#include <climits>
#include <sstream>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

Error path_error(const std::string& path, const char* why) {
  return {"script.path", "\"" + path + "\" " + why + ": what a script writes lies below the output folder", ""};
}

/// Runs steps one by one; one object for one run of one script.
class Runner {
public:
  Runner(Session& session, const ScriptFolders& folders, const Watch& watch)
      : session_(session), folders_(folders), watch_(watch), pictures_(folders.script, folders.limits.memory_bytes) {}

  Result<void> run(const Step& step) {
    return std::visit([this](const auto& s) { return run_step(s); }, step);
  }
  std::vector<fs::path> written;

private:
  Result<void> run_step(const Command& command) {
    Command loaded = command;
    StageTimer timer(watch_.times, "read");
    if (auto done = pictures_.load_into(loaded); !done) return done;
    timer.stop();
    return session_.execute(loaded, watch_);
  }

  Result<void> run_step(const UndoStep& step) { return session_.undo(static_cast<std::size_t>(step.steps)); }
  Result<void> run_step(const RedoStep& step) { return session_.redo(static_cast<std::size_t>(step.steps)); }

  Result<void> run_step(const SaveStep& step) {
    const auto path = output_path(step.path);
    if (!path) return path.error();
    const bool as_script = ending_of(*path) == ".jsonl";
    if (!as_script && ending_of(*path) != ".ora")
      return Error{"save.unknown-kind", "end the name in .ora for a project, in .jsonl for a script", path->string()};
    StageTimer timer(watch_.times, "save");
    auto saved = as_script ? save_session(session_, *path) : save_project(session_, *path, {}, watch_);
    if (!saved) return saved;
    session_.mark_saved();
    written.push_back(*path);
    return {};
  }

  Result<void> run_step(const OpenStep& step) {
    fs::path path = folders_.out / step.path;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) path = folders_.script / step.path;
    if (ending_of(path) != ".ora") return open_session(session_, path, watch_, folders_.limits);
    auto loaded = load_project(path, {folders_.limits}, watch_);
    if (!loaded) return loaded.error();
    session_.adopt(std::move(loaded->session));
    return {};
  }

  Result<void> run_step(const ExportStep& step) {
    return write_picture(session_.composite(watch_), step.path, step.depth);
  }

  Result<void> run_step(const ExportLayerStep& step) {
    if (session_.document().empty())
      return Error{"document.none", "there is no document yet: begin with document.new", ""};
    const LayerRef layer = step.layer ? step.layer : session_.document().selected;
    if (!layer) return Error{"layer.none-selected", "no layer is selected: name one with \"layer\"", ""};
    if (fs::path(step.path).has_extension() && !keeps_alpha(step.path))
      return Error{"image.no-alpha",
                   "a layer alone is transparent outside, which only PNG can hold: end the name in .png", ""};
    return write_picture(session_.layer_picture(*layer, watch_), step.path, step.depth);
  }

  Result<void> run_step(const ReportStep& step) {
    const auto report = make_report(session_, watch_);
    if (!report) return report.error();
    const auto path = output_path(step.path);
    if (!path) return path.error();
    const std::string text = report->dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    if (auto done = write_file(*path, text); !done) return done;
    written.push_back(*path);
    return {};
  }

  Result<void> run_step(const ExpectStep& step) {
    const Document& document = session_.document();
    std::size_t pins = 0;
    for (const Layer& layer : document.layers)
      pins += layer.pins.size();
    if (auto as_said = expect("layers", step.layers, document.layers.size()); !as_said) return as_said;
    if (auto as_said = expect("pins", step.pins, pins); !as_said) return as_said;
    if (auto as_said = expect("history", step.history, session_.history().entries().size()); !as_said) return as_said;
    if (step.modified && *step.modified != session_.history().modified())
      return Error{"expect.failed", std::string("\"modified\" is ") + (*step.modified ? "false" : "true"), ""};
    if (step.flipped_cells) {
      const auto flipped = flipped_cells();
      if (!flipped) return flipped.error();
      if (auto as_said = expect("flipped_cells", step.flipped_cells, *flipped); !as_said) return as_said;
    }
    return step.image ? expect_image(*step.image, step.max_difference) : Result<void>();
  }

  static Result<void> expect(const char* what, const std::optional<int>& wanted, std::size_t found) {
    if (!wanted || static_cast<std::size_t>(*wanted) == found) return {};
    return Error{"expect.failed",
                 std::string("\"") + what + "\" is " + std::to_string(found) + ", not " + std::to_string(*wanted), ""};
  }

  Result<std::size_t> flipped_cells() {
    std::size_t flipped = 0;
    for (const Layer& layer : session_.document().layers) {
      if (layer.outline.empty()) continue;
      const auto metrics = session_.metrics(layer.id, watch_);
      if (!metrics) return metrics.error();
      flipped += static_cast<std::size_t>(metrics->distortion.flipped_cells);
    }
    return flipped;
  }

  Result<void> expect_image(const std::string& name, double max_difference) {
    std::error_code ignored;
    const bool exported = !fs::exists(folders_.script / name, ignored) && fs::exists(folders_.out / name, ignored);
    const auto wanted = load_image((exported ? folders_.out : folders_.script) / name,
                                   static_cast<std::int64_t>(folders_.limits.memory_bytes / sizeof(Rgba)));
    if (!wanted) return wanted.error();
    const auto shown = session_.composite(watch_);
    if (!shown) return shown.error();
    const auto difference = compare(*shown, *wanted);
    if (!difference) return difference.error();
    if (difference->max_levels <= max_difference) return {};
    std::ostringstream sentence;
    sentence << "the picture differs from " << name << " by up to " << difference->max_levels << " levels, at ("
             << difference->x << ", " << difference->y << ")";
    return Error{"expect.failed", sentence.str(), ""};
  }

  Result<void> write_picture(Result<Image> picture, const std::string& name, int depth) {
    if (!picture) return picture.error();
    if (depth != 8 && depth != 16) return Error{"script.depth", "\"depth\" must be 8 or 16", ""};
    const auto path = output_path(name);
    if (!path) return path.error();
    StageTimer timer(watch_.times, "write");
    if (auto done = save_image(*picture, *path, depth == 16 ? BitDepth::k16 : BitDepth::k8); !done) return done;
    written.push_back(*path);
    return {};
  }

  /// Where the script may write; makes the folders on the way.
  Result<fs::path> output_path(const std::string& name) {
    const fs::path relative(name);
    if (name.empty() || !relative.has_filename()) return path_error(name, "names no file");
    if (name.find('\0') != std::string::npos) return path_error(name, "is no path");
    if (relative.is_absolute()) return path_error(name, "is absolute");
    for (const fs::path& part : relative) {
      if (part == "..") return path_error(name, "has \"..\"");
      if (part.native().size() > NAME_MAX) return path_error(name, "has a name that is too long for a file");
    }
    std::error_code failure;
    const fs::path folder = (folders_.out / relative).parent_path();
    // What is there already may be a link: neither the folder, nor the file may lead outside.
    if (!lies_below(folders_.out, folder) || !lies_below(folders_.out, folders_.out / relative))
      return path_error(name, "leads outside");
    fs::create_directories(folder, failure);
    if (failure) return Error{"file.write", "the folder cannot be made: " + failure.message(), folder.string()};
    return folders_.out / relative;
  }

  Session& session_;
  const ScriptFolders& folders_;
  const Watch& watch_;
  PictureLoader pictures_;
};

} // namespace

Result<RunSummary> run_script(Session& session, const std::vector<ScriptLine>& lines, const std::string& name,
                              const ScriptFolders& folders, const Watch& watch) {
  Runner runner(session, folders, watch);
  RunSummary summary;
  for (const ScriptLine& line : lines) {
    if (watch.stopped()) return cancelled();
    watch.report(static_cast<double>(summary.steps) / static_cast<double>(lines.size()),
                 "line " + std::to_string(line.number));
    if (auto done = runner.run(line.step); !done) return at(name + ":" + std::to_string(line.number), done.error());
    ++summary.steps;
  }
  summary.written = std::move(runner.written);
  return summary;
}

Result<RunSummary> run_script_file(Session& session, const fs::path& script, const fs::path& out, const Watch& watch,
                                   const IoLimits& limits) {
  const auto text = read_text_file(script);
  if (!text) return text.error();
  const auto lines = parse_script(*text, script.string());
  if (!lines) return lines.error();
  return run_script(session, *lines, script.string(), {script.parent_path(), out, limits}, watch);
}

} // namespace oversketch
