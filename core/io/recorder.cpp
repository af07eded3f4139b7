#include "core/io/recorder.h"

#include "core/base/file.h"
#include "core/io/picture_folder.h"
#include "core/session/picture_loader.h"

namespace oversketch {
namespace {

namespace fs = std::filesystem;

Error no_session(const char* why) {
  return {"open.not-a-session", std::string("this is no saved session: ") + why, ""};
}

} // namespace

Result<void> save_session(const Session& session, const fs::path& path) {
  if (ending_of(path) != ".jsonl")
    return Error{"save.needs-jsonl", "a session is saved as a script: end the name in .jsonl", path.string()};
  if (session.log().empty() || !std::holds_alternative<Command>(session.log().front()) ||
      !std::holds_alternative<DocumentNew>(std::get<Command>(session.log().front())))
    return Error{"save.no-beginning",
                 "the history no longer reaches back to the beginning, which a script needs: save as .ora",
                 path.string()};
  PictureFolder pictures(path.has_parent_path() ? path.parent_path() : ".", path.stem().string() + ".files");
  std::string text = std::string(kScriptHeader) + "\n";
  for (const Step& step : session.log()) {
    if (const auto* command = std::get_if<Command>(&step)) {
      const auto portable = pictures.keep_pictures(*command);
      if (!portable) return portable.error();
      text += print_command(*portable) + "\n";
    } else {
      text += print_step(step) + "\n";
    }
  }
  return write_file(path, text);
}

Result<void> open_session(Session& session, const fs::path& path, const Watch& watch, const IoLimits& limits) {
  const auto text = read_text_file(path);
  if (!text) return text.error();
  const auto lines = parse_script(*text, path.string());
  if (!lines) return lines.error();
  if (lines->empty()) return at(path.string(), no_session("it has no commands"));
  Session opened;
  PictureLoader pictures(path.parent_path(), limits.memory_bytes);
  for (const ScriptLine& line : *lines) {
    const std::string place = path.string() + ":" + std::to_string(line.number);
    if (watch.stopped()) return cancelled();
    Result<void> done;
    if (const auto* undo = std::get_if<UndoStep>(&line.step)) {
      done = opened.undo(static_cast<std::size_t>(undo->steps));
    } else if (const auto* redo = std::get_if<RedoStep>(&line.step)) {
      done = opened.redo(static_cast<std::size_t>(redo->steps));
    } else if (const auto* given = std::get_if<Command>(&line.step)) {
      Command command = *given;
      done = pictures.load_into(command);
      if (done) done = opened.execute(command, watch);
    } else {
      done = no_session("it has steps that are neither commands nor undo and redo");
    }
    if (!done) return at(place, done.error());
  }
  opened.mark_saved();
  session.adopt(std::move(opened));
  return {};
}

} // namespace oversketch
