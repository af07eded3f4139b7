#include "core/io/journal.h"

#include "core/base/file.h"
#include "core/io/journal_data.h"
#include "core/io/picture_folder.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

/// Syncs a file or folder by name; 0 or the system's error.
int sync_path(const fs::path& path) {
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.open()) return errno;
  return ::fsync(file.number()) == 0 ? 0 : errno;
}

/// A folder of its own for this process and document.
Result<fs::path> make_folder(const fs::path& state_folder) {
  const fs::path journals = state_folder / kJournalsFolder;
  std::error_code failure;
  fs::create_directories(journals, failure);
  if (failure) return journal_write_error(failure.value(), journals);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const long long seconds = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  for (int attempt = 0; attempt < 1000; ++attempt) {
    char name[80];
    std::snprintf(name, sizeof name, "%lld-%ld-%d", seconds, static_cast<long>(::getpid()), attempt);
    // For the owner alone: it holds pictures.
    if (::mkdir((journals / name).c_str(), 0700) == 0) return journals / name;
    if (errno != EEXIST) return journal_write_error(errno, journals / name);
  }
  return journal_write_error(EEXIST, journals);
}

Result<void> copy_base(const fs::path& base, const fs::path& to) {
  const OpenFile from(::open(base.c_str(), O_RDONLY | O_CLOEXEC));
  if (!from.open()) return journal_write_error(errno, base);
  const OpenFile copy(::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!copy.open()) return journal_write_error(errno, to);
  std::vector<std::byte> piece(1 << 20);
  for (;;) {
    const ssize_t got = ::read(from.number(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return journal_write_error(errno, base);
    if (got == 0) break;
    if (const int error = write_all(copy.number(), std::span(piece).first(static_cast<std::size_t>(got))))
      return journal_write_error(error, to);
  }
  if (::fsync(copy.number()) != 0) return journal_write_error(errno, to);
  return {};
}

} // namespace

std::string print_stamp(const fs::path& project) {
  const FileStamp stamp = stamp_of(project).value_or(FileStamp{});
  return std::string(kStampComment) + std::to_string(stamp.bytes) + " " + std::to_string(stamp.changed);
}

std::optional<FileStamp> parse_stamp(std::string_view line) {
  if (!line.starts_with(kStampComment)) return std::nullopt;
  FileStamp stamp;
  const char* const end = line.data() + line.size();
  const auto bytes = std::from_chars(line.data() + kStampComment.size(), end, stamp.bytes);
  if (bytes.ec != std::errc() || bytes.ptr == end) return std::nullopt;
  if (std::from_chars(bytes.ptr + 1, end, stamp.changed).ec != std::errc()) return std::nullopt;
  return stamp;
}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

OpenFile take_journal_lock(const fs::path& folder, bool make) {
  const int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW | (make ? O_CREAT : 0);
  OpenFile file(::open((folder / kJournalLock).c_str(), flags, 0600));
  if (!file.open() || ::flock(file.number(), LOCK_EX | LOCK_NB) != 0) return OpenFile();
  return file;
}

Error journal_write_error(int system_error, const fs::path& path) {
  return {"journal.write", "the work could not be written down: " + std::generic_category().message(system_error),
          path.string()};
}

Result<fs::path> default_state_folder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && fs::path(state).is_absolute()) return fs::path(state) / "oversketch";
  const char* home = std::getenv("HOME");
  if (home != nullptr && fs::path(home).is_absolute()) return fs::path(home) / ".local/state/oversketch";
  return Error{"journal.no-home", "neither XDG_STATE_HOME nor HOME says where to keep the journal of unsaved work", ""};
}

Journal::Journal(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Journal::~Journal() = default;
Journal::Journal(Journal&&) noexcept = default;
Journal& Journal::operator=(Journal&&) noexcept = default;

Result<Journal> Journal::begin(const fs::path& state_folder, const std::string& name, const fs::path& base) {
  const auto folder = make_folder(state_folder);
  if (!folder) return folder.error();
  auto journal = begin_in(*folder, name, base);
  std::error_code ignored;
  // Half a journal is none, and takes room where there may be none left.
  if (!journal) fs::remove_all(*folder, ignored);
  return journal;
}

Result<Journal> Journal::begin_in(const fs::path& folder, const std::string& name, const fs::path& base) {
  auto data = std::make_unique<Data>(folder);
  data->lock = take_journal_lock(folder, true);
  if (!data->lock.open()) return journal_write_error(errno, folder / kJournalLock);
  std::string text = std::string(kScriptHeader) + "\n" + std::string(kNameComment) + clean_text(name) + "\n";
  if (!base.empty()) {
    text += print_stamp(base) + "\n";
    if (auto copied = copy_base(base, folder / kJournalBase); !copied) return copied.error();
    text += print_step(OpenStep{kJournalBase}) + "\n";
  }
  // Last, since a folder without it is no journal yet.
  if (auto written = write_file(folder / kJournalFile, text); !written)
    return Error{"journal.write", written.error().sentence, written.error().where};
  if (auto opened = data->open_for_appending(text.size()); !opened) return opened.error();
  (void)sync_path(folder.parent_path());
  return Journal(std::move(data));
}

const fs::path& Journal::folder() const {
  return data_->folder;
}

Result<void> Journal::append(const Step& step) {
  CHECK(std::holds_alternative<Command>(step) || std::holds_alternative<UndoStep>(step) ||
            std::holds_alternative<RedoStep>(step),
        "a journal holds commands, undo and redo");
  const std::lock_guard guard(data_->mutex);
  data_->waiting.emplace_back(step);
  return data_->write_waiting();
}

Result<void> Journal::catch_up() {
  const std::lock_guard guard(data_->mutex);
  return data_->write_waiting();
}

Result<void> Journal::mark_saved(const std::string& project) {
  const std::lock_guard guard(data_->mutex);
  data_->waiting.emplace_back(std::string(kSavedComment) + clean_text(project) + "\n" + print_stamp(project));
  return data_->write_waiting();
}

void Journal::discard() {
  const std::lock_guard guard(data_->mutex);
  std::error_code ignored;
  // The script first: what is left when this is cut short is no journal.
  fs::remove(data_->folder / kJournalFile, ignored);
  fs::remove_all(data_->folder, ignored);
}

Result<void> Journal::Data::open_for_appending(std::size_t bytes) {
  const fs::path path = folder / kJournalFile;
  file = OpenFile(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW));
  if (!file.open()) return journal_write_error(errno, path);
  size = bytes;
  return {};
}

Result<std::string> Journal::Data::line_of(const Line& line) {
  if (const auto* comment = std::get_if<std::string>(&line)) return *comment + "\n";
  const Step& step = std::get<Step>(line);
  const auto* command = std::get_if<Command>(&step);
  if (command == nullptr) return print_step(step) + "\n";
  const auto kept = pictures.keep_pictures(*command);
  if (!kept) return kept.error();
  return print_step(*kept) + "\n";
}

Result<void> Journal::Data::write_waiting() {
  while (!waiting.empty()) {
    const auto line = line_of(waiting.front());
    if (!line) return line.error();
    if (const int error = append_whole(*line)) return journal_write_error(error, folder / kJournalFile);
    waiting.pop_front();
  }
  return {};
}

int Journal::Data::append_whole(std::string_view line) {
  // Half a line may stand there from a try that failed.
  if (::ftruncate(file.number(), static_cast<off_t>(size)) != 0) return errno;
  if (const int error = write_all(file.number(), std::as_bytes(std::span(line)))) return error;
  if (::fdatasync(file.number()) != 0) return errno;
  size += line.size();
  return 0;
}

} // namespace oversketch
