#include "ui/state/file_jobs.h"

#include "core/base/file.h"
#include "core/image/image_io.h"
#include "core/io/project.h"
#include "core/io/recorder.h"
#include "core/io/runner.h"
#include "core/session/picture_loader.h"

#include <algorithm>
#include <map>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

/// What the document's pictures take, each content once.
std::size_t picture_bytes(const Document& document) {
  std::map<Hash, std::size_t> bytes;
  for_each_image(document, [&](const Image& image) { bytes[image.content_hash()] = image.bytes(); });
  std::size_t sum = 0;
  for (const auto& [hash, size] : bytes)
    sum += size;
  return sum;
}

/// @param taken  of the memory, by pictures that stay.
Result<void> load_and_execute(Session& session, Command command, std::size_t taken, const IoLimits& limits,
                              const Watch& watch) {
  PictureLoader pictures({}, limits.memory_bytes - std::min(taken, limits.memory_bytes));
  if (auto loaded = pictures.load_into(command); !loaded) return loaded;
  return session.execute(command, watch);
}

bool changes_document(const ScriptLine& line) {
  return std::holds_alternative<Command>(line.step) || std::holds_alternative<UndoStep>(line.step) ||
         std::holds_alternative<RedoStep>(line.step);
}

Result<OpenedFile> open_script(Session& session, const fs::path& path, const IoLimits& limits, const Watch& watch) {
  const auto text = read_text_file(path);
  if (!text) return text.error();
  const std::string name = path.filename().string();
  auto lines = parse_script(*text, name);
  if (!lines) return lines.error();
  const auto left_out = std::erase_if(*lines, [](const ScriptLine& line) { return !changes_document(line); });
  Session opened;
  const fs::path folder = path.parent_path();
  if (const auto run = run_script(opened, *lines, name, {folder, folder, limits}, watch); !run) return run.error();
  if (opened.document().empty()) return Error{"script.no-document", "the script makes no document", path.string()};
  opened.mark_saved();
  session.adopt(std::move(opened));
  OpenedFile file;
  if (left_out > 0) file.message = "Opened " + name + "; what it saves and exports was left out";
  return file;
}

Result<OpenedFile> open_project(Session& session, const fs::path& path, const IoLimits& limits, const Watch& watch) {
  auto loaded = load_project(path, {.limits = limits}, watch);
  if (!loaded) return loaded.error();
  session.adopt(std::move(loaded->session));
  return OpenedFile{loaded->read_only || loaded->foreign, loaded->message};
}

} // namespace

FileKind kind_of_file(const fs::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".ora") return FileKind::kProject;
  return ending == ".jsonl" ? FileKind::kScript : FileKind::kPicture;
}

Result<OpenedFile> open_file(Session& session, const fs::path& path, const IoLimits& limits, const Watch& watch) {
  switch (kind_of_file(path)) {
  case FileKind::kProject:
    return open_project(session, path, limits, watch);
  case FileKind::kScript:
    return open_script(session, path, limits, watch);
  case FileKind::kPicture:
    break;
  }
  DocumentNew command;
  command.target = ImageRef{path.string(), std::nullopt};
  if (const auto made = make_document(session, command, limits, watch); !made) return made.error();
  return OpenedFile{};
}

Result<void> make_document(Session& session, const DocumentNew& what, const IoLimits& limits, const Watch& watch) {
  Session made;
  if (auto done = load_and_execute(made, what, 0, limits, watch); !done) return done;
  session.adopt(std::move(made));
  return {};
}

Result<void> run_whole_script(Session& session, const fs::path& path, const fs::path& out, const IoLimits& limits,
                              const Watch& watch) {
  const auto run = run_script_file(session, path, out, watch, limits);
  return run ? Result<void>{} : run.error();
}

Result<void> add_source(Session& session, const fs::path& path, const IoLimits& limits, const Watch& watch) {
  return load_and_execute(session, LayerAdd{{path.string(), std::nullopt}, std::nullopt},
                          picture_bytes(session.document()), limits, watch);
}

Result<void> set_target(Session& session, const fs::path& path, const IoLimits& limits, const Watch& watch) {
  Document others = session.document();
  others.target = {};
  return load_and_execute(session, TargetSet{{path.string(), std::nullopt}}, picture_bytes(others), limits, watch);
}

Result<void> save_file(Session& session, const fs::path& path, const Watch& watch) {
  const FileKind kind = kind_of_file(path);
  if (kind == FileKind::kPicture)
    return Error{"save.unknown-extension", "end the name in .ora for a project, in .jsonl for a script", path.string()};
  auto saved = kind == FileKind::kProject ? save_project(session, path, {}, watch) : save_session(session, path);
  if (!saved) return saved;
  session.mark_saved();
  return {};
}

Result<void> record_session(const Session& session, const fs::path& path) {
  return save_session(session, path);
}

Result<void> export_picture(Session& session, const fs::path& path, int depth, const Watch& watch) {
  const auto picture = session.composite(watch);
  if (!picture) return picture.error();
  return save_image(*picture, path, depth == 16 ? BitDepth::k16 : BitDepth::k8);
}

} // namespace oversketch
