// Finding journals whose processes are gone, and replaying them.

#include "core/base/file.h"
#include "core/image/image_io.h"
#include "core/io/journal_data.h"
#include "core/io/project.h"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <span>

#include <fcntl.h>
#include <unistd.h>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostJournalBytes = 1'000'000'000;

/// The whole lines of a journal: the last one may be cut short.
std::vector<std::string_view> whole_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
    lines.push_back(text.substr(0, end));
  return lines;
}

bool is_step(std::string_view line) {
  return !line.empty() && line.front() == '{';
}

std::optional<AbandonedJournal> describe(const fs::path& folder) {
  const auto text = read_text_file(folder / kJournalFile, kMostJournalBytes);
  if (!text) return std::nullopt;
  AbandonedJournal journal;
  journal.folder = folder;
  const auto lines = whole_lines(*text);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].starts_with(kNameComment)) journal.name = lines[i].substr(kNameComment.size());
    if (const auto stamp = parse_stamp(lines[i])) journal.stamp = stamp;
    if (lines[i].starts_with(kSavedComment)) {
      journal.unsaved_steps = 0;
      journal.name = lines[i].substr(kSavedComment.size());
    }
    const bool opens = lines[i] == print_step(OpenStep{kJournalBase});
    if (is_step(lines[i]) && !opens) ++journal.steps, ++journal.unsaved_steps;
  }
  std::error_code failure;
  const auto changed = fs::last_write_time(folder / kJournalFile, failure);
  journal.last_change =
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(std::chrono::file_clock::to_sys(changed));
  return journal;
}

template <class Visit>
void for_each_folder(const fs::path& state_folder, const Visit& visit) {
  std::error_code failure;
  fs::directory_iterator entry(state_folder / kJournalsFolder, failure);
  // Gathered first, since some are removed.
  std::vector<fs::path> folders;
  for (; !failure && entry != fs::directory_iterator(); entry.increment(failure))
    if (entry->is_directory(failure) && !entry->is_symlink(failure)) folders.push_back(entry->path());
  for (const fs::path& folder : folders)
    visit(folder);
}

/// 0 or the system's error.
int append_to(const fs::path& path, std::string_view text) {
  const OpenFile file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!file.open()) return errno;
  if (const int error = write_all(file.number(), std::as_bytes(std::span(text)))) return error;
  return ::fsync(file.number()) == 0 ? 0 : errno;
}

/// Reads what a journal's own folder holds, and nothing else.
class OwnFiles {
public:
  OwnFiles(const fs::path& folder, const IoLimits& limits)
      : folder_(folder), limits_(limits), memory_left_(limits.memory_bytes) {}

  /// @errors journal.outside.
  Result<fs::path> find(const std::string& name) const {
    const fs::path relative(name);
    const auto leads_up = [](const fs::path& part) { return part == ".."; };
    std::error_code failure;
    if (relative.is_absolute() || std::any_of(relative.begin(), relative.end(), leads_up) ||
        !lies_below(folder_, folder_ / relative) || fs::is_symlink(folder_ / relative, failure))
      return Error{"journal.outside", "a journal reads only what lies in its own folder", name.substr(0, 200)};
    return folder_ / relative;
  }

  /// Pictures whose files have become those of other pictures.
  const std::vector<std::string>& changed() const { return changed_; }

  Result<void> load_into(Command& command) {
    for (ImageRef* ref : images_to_load(command)) {
      auto known = loaded_.find(ref->name);
      if (known == loaded_.end()) {
        auto image = load(ref->name);
        if (!image) return image.error();
        known = loaded_.emplace(ref->name, std::move(*image)).first;
      }
      ref->image = known->second;
    }
    return {};
  }

private:
  Result<Image> load(const std::string& name) {
    const auto path = find(name);
    if (!path) return path.error();
    std::error_code failure;
    if (!fs::is_regular_file(*path, failure)) return Error{"image.missing", "there is no such file", path->string()};
    auto bytes = read_file(*path, std::min<std::uintmax_t>(limits_.file_bytes, memory_left_));
    if (!bytes) return bytes.error();
    const std::size_t most = (memory_left_ - bytes->size()) / sizeof(Rgba);
    auto image = decode_file(std::move(*bytes), static_cast<std::int64_t>(std::min<std::size_t>(most, kMaxPixels)));
    if (!image && image.error().code == "image.too-large")
      return Error{"project.too-large", "its pictures need more memory than the program may take", path->string()};
    if (!image)
      return Error{image.error().code, "the picture " + path->filename().string() + " in the journal is damaged",
                   path->string()};
    memory_left_ -= image->bytes();
    // The folder of a picture is called by its content.
    const fs::path folder = fs::path(name).parent_path();
    if (folder.parent_path() == kJournalImages && folder.filename() != to_string(image->content_hash()))
      changed_.push_back(path->filename().string());
    return image;
  }

  const fs::path& folder_;
  const IoLimits& limits_;
  std::size_t memory_left_;
  std::map<std::string, Image> loaded_;
  std::vector<std::string> changed_;
};

/// Runs a journal's lines one by one.
class Replay {
public:
  Replay(const fs::path& folder, const IoLimits& limits, const Watch& watch)
      : files_(folder, limits), limits_(limits), watch_(watch) {}

  Result<void> run(std::string_view line) {
    if (line.starts_with(kSavedComment)) session.mark_saved();
    // What is neither a step nor a comment is damage: steps may have been lost with it.
    if (line.empty() || line.front() == '#') return {};
    const auto step = parse_step(line);
    if (!step) return step.error();
    if (const auto* open = std::get_if<OpenStep>(&*step)) return run_open(*open);
    const auto done = run_step(*step);
    steps += done ? 1 : 0;
    return done;
  }

  const std::vector<std::string>& changed_pictures() const { return files_.changed(); }

  Session session;
  int steps = 0;

private:
  Result<void> run_step(const Step& step) {
    if (const auto* undo = std::get_if<UndoStep>(&step)) return session.undo(static_cast<std::size_t>(undo->steps));
    if (const auto* redo = std::get_if<RedoStep>(&step)) return session.redo(static_cast<std::size_t>(redo->steps));
    const auto* given = std::get_if<Command>(&step);
    if (given == nullptr) return Error{"journal.step", "a journal holds commands, undo and redo alone", ""};
    Command command = *given;
    if (auto loaded = files_.load_into(command); !loaded) return loaded;
    return session.execute(command, watch_);
  }

  Result<void> run_open(const OpenStep& step) {
    const auto path = files_.find(step.path);
    if (!path) return path.error();
    LoadOptions options;
    options.limits = limits_;
    auto loaded = load_project(*path, options, watch_);
    if (!loaded) return loaded.error();
    session.adopt(std::move(loaded->session));
    return {};
  }

  OwnFiles files_;
  const IoLimits& limits_;
  const Watch& watch_;
};

} // namespace

std::vector<AbandonedJournal> list_abandoned_journals(const fs::path& state_folder) {
  std::vector<AbandonedJournal> found;
  for_each_folder(state_folder, [&](const fs::path& folder) {
    if (!take_journal_lock(folder, false).open()) return;
    if (auto journal = describe(folder); journal && journal->steps > 0) found.push_back(std::move(*journal));
  });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.last_change > b.last_change; });
  return found;
}

void discard_abandoned_journal(const fs::path& folder) {
  const OpenFile lock = take_journal_lock(folder, false);
  if (!lock.open()) return;
  std::error_code ignored;
  // The script first: what is left when this is cut short is no journal.
  fs::remove(folder / kJournalFile, ignored);
  fs::remove_all(folder, ignored);
}

int remove_old_journals(const fs::path& state_folder, std::chrono::system_clock::time_point now,
                        std::chrono::hours age) {
  int removed = 0;
  for_each_folder(state_folder, [&](const fs::path& folder) {
    const OpenFile lock = take_journal_lock(folder, false);
    std::error_code failure;
    const auto changed =
        fs::last_write_time(fs::exists(folder / kJournalFile, failure) ? folder / kJournalFile : folder, failure);
    if (failure || now - std::chrono::file_clock::to_sys(changed) < age) return;
    // One without a lock was never begun or is half removed.
    if (!lock.open() && fs::exists(folder / kJournalLock, failure)) return;
    fs::remove_all(folder, failure);
    removed += failure ? 0 : 1;
  });
  return removed;
}

Result<RecoveredJournal> recover_journal(const fs::path& folder, const IoLimits& limits, const Watch& watch) {
  auto data = std::make_unique<JournalRecovery::Data>(folder);
  std::error_code failure;
  if (!fs::is_regular_file(fs::symlink_status(folder / kJournalFile, failure)))
    return Error{"journal.unreadable", "there is no journal", folder.string()};
  data->lock = take_journal_lock(folder, true);
  if (!data->lock.open())
    return Error{"journal.in-use", "the program that writes it is still running", folder.string()};
  const fs::path path = folder / kJournalFile;
  const auto text = read_text_file(path, kMostJournalBytes);
  if (!text) return text.error();
  const auto lines = whole_lines(*text);
  if (lines.empty() || lines[0] != kScriptHeader)
    return Error{"journal.unreadable", "it does not begin as a journal", path.string()};

  Replay replay(folder, limits, watch);
  std::size_t kept = lines[0].size() + 1;
  std::string message;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (watch.stopped()) return cancelled();
    watch.report(static_cast<double>(i) / static_cast<double>(lines.size()), "replaying the journal");
    if (const auto done = replay.run(lines[i]); !done) {
      if (done.error().code == "cancelled") return done.error();
      if (replay.session.document().empty()) return at(path.string() + ":" + std::to_string(i + 1), done.error());
      message = "line " + std::to_string(i + 1) + " of " + std::to_string(lines.size()) +
                " could not be replayed: " + done.error().sentence + "; the lines from there on are kept in " +
                path.string() + "~";
      break;
    }
    kept += lines[i].size() + 1;
  }
  const bool is_cut = !message.empty();
  for (const std::string& name : replay.changed_pictures())
    message += (message.empty() ? "" : "; ") + name + " is another picture than it was: its file has been changed";
  if (kept != text->size()) {
    const std::string_view all = *text;
    if (const int error = is_cut ? append_to(path.string() + "~", all.substr(kept)) : 0)
      return journal_write_error(error, path.string() + "~");
    if (auto cut = write_file(path, all.substr(0, kept)); !cut) return cut.error();
  }
  if (auto opened = data->open_for_appending(kept); !opened) return opened.error();
  return RecoveredJournal{std::move(replay.session), JournalRecovery::adopt(std::move(data)), replay.steps, message};
}

} // namespace oversketch
