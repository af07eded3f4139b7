#include "core/session/recorder.h"

#include "core/base/file.h"
#include "core/image/image_io.h"
#include "core/session/picture_loader.h"

#include <cmath>
#include <map>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

Error no_session(const char* why) {
  return {"open.not-a-session", std::string("this is no saved session: ") + why, ""};
}

/// Whether every value is a whole number of levels of 1/`top`.
bool is_exact(const Image& image, float top) {
  const auto exact = [&](float value) { return value >= 0 && value <= 1 && std::round(value * top) / top == value; };
  for (const Rgba& p : image.pixels().values())
    if (!exact(p.r) || !exact(p.g) || !exact(p.b) || !exact(p.a)) return false;
  return true;
}

Result<BitDepth> exact_depth(const Image& image) {
  if (is_exact(image, 255)) return BitDepth::k8;
  if (is_exact(image, 65535)) return BitDepth::k16;
  return Error{"save.not-exact", "a picture has values that a PNG file cannot hold exactly", ""};
}

/// Pictures beside a script, each content once.
class PictureFolder {
public:
  explicit PictureFolder(const fs::path& script)
      : folder_(script.stem().string() + ".files"), root_(script.has_parent_path() ? script.parent_path() : ".") {}

  /// The picture's path relative to the script; written if it is not there yet.
  Result<std::string> store(const ImageRef& ref) {
    const Hash hash = ref.image->content_hash();
    if (const auto known = stored_.find(hash); known != stored_.end()) return known->second;
    const auto depth = exact_depth(*ref.image);
    if (!depth) return at(ref.name, depth.error());
    const fs::path relative = folder_ / to_string(hash) / (fs::path(ref.name).stem().string() + ".png");
    std::error_code failure;
    if (!lies_below(root_, root_ / relative) || !lies_below(root_, root_ / folder_))
      return Error{"file.write", "a link leads out of the session's folder", (root_ / relative).string()};
    fs::create_directories((root_ / relative).parent_path(), failure);
    if (failure)
      return Error{"file.write", "the folder cannot be made: " + failure.message(), (root_ / relative).string()};
    // A name is its content: what is there is the same picture.
    if (!fs::exists(root_ / relative, failure))
      if (auto saved = save_image(*ref.image, root_ / relative, *depth); !saved) return saved.error();
    return stored_[hash] = relative.generic_string();
  }

private:
  fs::path folder_;
  fs::path root_;
  std::map<Hash, std::string> stored_;
};

/// The command with its pictures in the folder.
Result<Command> made_portable(Command command, PictureFolder& pictures) {
  if (auto* add = std::get_if<LayerAdd>(&command); add && !add->name && add->source.name != kTargetName)
    add->name = fs::path(add->source.name).stem().string();
  const auto store = [&](ImageRef& ref) -> Result<void> {
    if (!ref.image || ref.name == kTargetName) return {};
    auto name = pictures.store(ref);
    if (!name) return name.error();
    ref.name = *name;
    return {};
  };
  Result<void> stored;
  if (auto* c = std::get_if<DocumentNew>(&command); c && c->target) stored = store(*c->target);
  if (auto* c = std::get_if<TargetSet>(&command)) stored = store(c->target);
  if (auto* c = std::get_if<LayerAdd>(&command)) stored = store(c->source);
  if (!stored) return stored.error();
  return command;
}

} // namespace

Result<void> save_session(const Session& session, const fs::path& path) {
  if (path.extension() != ".jsonl")
    return Error{"save.needs-jsonl", "a session is saved as a script: end the name in .jsonl", path.string()};
  PictureFolder pictures(path);
  std::string text = std::string(kScriptHeader) + "\n";
  for (const Step& step : session.log()) {
    if (const auto* command = std::get_if<Command>(&step)) {
      const auto portable = made_portable(*command, pictures);
      if (!portable) return portable.error();
      text += print_command(*portable) + "\n";
    } else {
      text += print_step(step) + "\n";
    }
  }
  return write_file(path, text);
}

Result<void> open_session(Session& session, const fs::path& path, const Watch& watch) {
  const auto text = read_text_file(path);
  if (!text) return text.error();
  const auto lines = parse_script(*text, path.string());
  if (!lines) return lines.error();
  if (lines->empty()) return at(path.string(), no_session("it has no commands"));
  Session opened;
  PictureLoader pictures(path.parent_path());
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
