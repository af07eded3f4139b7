#include "app/cli/cli.h"

#include "core/base/file.h"
#include "core/image/image_io.h"
#include "core/io/project.h"
#include "core/io/runner.h"

#include <cstdio>
#include <filesystem>
#include <memory>

namespace oversketch::cli {
namespace {

struct RenderArguments {
  std::string source, out;
  int depth = 8;
};

Result<Session> open_project(const std::string& path, const IoLimits& limits, const Watch& watch) {
  auto loaded = load_project(path, {limits}, watch);
  if (!loaded) return loaded.error();
  if (!loaded->message.empty()) std::fprintf(stderr, "oversketch-cli: %s: %s\n", path.c_str(), loaded->message.c_str());
  return std::move(loaded->session);
}

/// The script's last state: its commands, undo and redo, without what it writes or expects.
Result<Session> replay(const std::string& path, const IoLimits& limits, const Watch& watch) {
  const std::filesystem::path script(path);
  const auto text = read_text_file(script);
  if (!text) return text.error();
  auto lines = parse_script(*text, path);
  if (!lines) return lines.error();
  std::erase_if(*lines, [](const ScriptLine& line) {
    return !std::holds_alternative<Command>(line.step) && !std::holds_alternative<UndoStep>(line.step) &&
           !std::holds_alternative<RedoStep>(line.step) && !std::holds_alternative<OpenStep>(line.step);
  });
  Session session;
  const auto done = run_script(session, *lines, path, {script.parent_path(), script.parent_path(), limits}, watch);
  if (!done) return done.error();
  return session;
}

Result<Json> render(const RenderArguments& options, const IoLimits& limits, const Watch& watch) {
  const bool is_project = ending_of(options.source) == ".ora";
  auto session = is_project ? open_project(options.source, limits, watch) : replay(options.source, limits, watch);
  if (!session) return session.error();
  session->limit_memory(limits.memory_bytes);
  const auto picture = session->composite(watch);
  if (!picture) return picture.error();
  if (auto saved = save_image(*picture, options.out, options.depth == 16 ? BitDepth::k16 : BitDepth::k8); !saved)
    return saved.error();
  Json report;
  report["width"] = picture->width();
  report["height"] = picture->height();
  report["layers"] = session->document().layers.size();
  return report;
}

} // namespace

void add_render(Cli& cli) {
  const auto options = std::make_shared<RenderArguments>();
  CLI::App* sub = cli.add("render", "Write the picture of a project, or of a script's last state.",
                          "render work.ora --out picture.png --depth 16");
  sub->add_option("project", options->source, "the project, or a script (JSON Lines)")
      ->required()
      ->type_name("PROJECT.ora|SCRIPT.jsonl");
  sub->add_option("--out", options->out, "PNG or JPEG, by its extension")->required()->type_name("PICTURE");
  sub->add_option("--depth", options->depth, "bits a channel: 8, or 16 for PNG")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str();
  cli.add_memory_option(sub);
  cli.on_run(sub, [options, &cli](const Watch& watch) { return render(*options, cli.limits(), watch); });
}

} // namespace oversketch::cli
