#include "ui/panels/file_browser.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using For = FileRequest::For;

/// Letters typed within this time make one word.
constexpr double kTypingPause_s = 0.8;
constexpr int kPage = 12;

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// The nearest folder above that exists; where nothing does, the one the program was started in.
fs::path existing_folder(fs::path path) {
  std::error_code error;
  for (path = fs::absolute(path, error); !path.empty() && path != path.root_path(); path = path.parent_path())
    if (is_folder(path)) return path;
  return fs::current_path(error);
}

} // namespace

FileBrowser::FileBrowser(std::function<void()> wake, fs::path samples)
    : places_(make_places(samples)),
      folders_(std::make_unique<LatestWorker<Question, FolderListing>>(
          [](const Question& question) {
            return question.folder.empty() ? read_files(question.files) : read_folder(question.folder);
          },
          wake)),
      previews_(std::make_unique<LatestWorker<fs::path, FilePreview>>(read_preview, wake)) {}

bool FileBrowser::saves() const {
  return request_ && (request_->purpose == For::kSaveAs || request_->purpose == For::kExport);
}

const FileRow* FileBrowser::chosen_row() const {
  return chosen_ >= 0 && chosen_ < static_cast<int>(rows_.size()) ? &rows_[static_cast<std::size_t>(chosen_)] : nullptr;
}

void FileBrowser::begin(const FileRequest& request) {
  request_ = request;
  message.clear();
  asks_folder = false;
  replaces_.reset();
  name.clear();
  switch (request.purpose) {
  case For::kOpen:
    filter_ = FileFilter::kAll;
    break;
  case For::kSaveAs:
    filter_ = FileFilter::kProjects;
    break;
  case For::kAddSource:
  case For::kSetTarget:
  case For::kExport:
    filter_ = FileFilter::kPictures;
    break;
  }
  fs::path start = request.proposal;
  if (saves() && !is_folder(start)) {
    name = start.filename().string();
    start = start.parent_path();
    format_ = format_of(name);
  }
  // Without a proposal: where the browser was the last time, or at home.
  if (start.empty()) start = !folder_.empty() ? folder_ : path_of("~", {});
  go_to(existing_folder(start));
}

void FileBrowser::update(const FileRequest& request, const std::vector<fs::path>& recent) {
  recent_ = recent;
  if (!request_ || request_->purpose != request.purpose || request_->proposal != request.proposal) begin(request);
  take_listing();
  if (auto preview = previews_->take(); preview && preview->path == preview_of_) preview_ = std::move(*preview);
}

void FileBrowser::take_listing() {
  auto listing = folders_->take();
  if (!listing || listing->folder != folder_) return;
  reading_ = false;
  listing_ = std::move(*listing);
  if (!listing_.problem.empty()) message = listing_.problem;
  arrange_rows();
  const auto found = std::ranges::find(rows_, wanted_name_, &FileRow::name);
  choose(found != rows_.end() ? static_cast<int>(found - rows_.begin()) : rows_.empty() || saves() ? -1 : 0);
  wanted_name_.clear();
}

void FileBrowser::arrange_rows() {
  // Recent files come in their own order.
  const bool recent = folder_.empty();
  rows_ = recent ? listing_.rows : arrange(listing_.rows, filter_, sort_, descending_, hidden_);
}

/// One slash at the end, so that typing goes on with a name.
std::string FileBrowser::place_text() const {
  return folder_ == folder_.root_path() ? folder_.string() : folder_.string() + "/";
}

void FileBrowser::go_to(const fs::path& folder) {
  wanted_name_ = folder == folder_.parent_path() ? folder_.filename().string() : std::string();
  folder_ = folder;
  path_text = place_text();
  message.clear();
  replaces_.reset();
  rows_.clear();
  choose(-1);
  reading_ = true;
  folders_->ask({folder_, {}});
}

void FileBrowser::go_to_recent() {
  folder_.clear();
  path_text.clear();
  message.clear();
  rows_.clear();
  choose(-1);
  reading_ = true;
  folders_->ask({{}, recent_});
}

void FileBrowser::go_up() {
  if (!folder_.empty() && folder_.has_parent_path() && folder_ != folder_.root_path()) go_to(folder_.parent_path());
}

void FileBrowser::choose(int index) {
  chosen_ = index;
  reveal = true;
  const FileRow* row = chosen_row();
  const fs::path shown = row != nullptr && !row->folder ? row->path : fs::path();
  if (shown != preview_of_) {
    preview_of_ = shown;
    preview_ = {};
    if (!shown.empty()) previews_->ask(shown);
  }
  if (row != nullptr && !row->folder && saves()) name = row->name;
}

void FileBrowser::set_filter(FileFilter filter) {
  filter_ = filter;
  arrange_rows();
  choose(rows_.empty() || saves() ? -1 : 0);
}

void FileBrowser::sort_by(FileSort sort) {
  descending_ = sort == sort_ && !descending_;
  sort_ = sort;
  const FileRow* row = chosen_row();
  const fs::path kept = row != nullptr ? row->path : fs::path();
  arrange_rows();
  const auto found = std::ranges::find(rows_, kept, &FileRow::path);
  chosen_ = found == rows_.end() ? -1 : static_cast<int>(found - rows_.begin());
  reveal = true;
}

void FileBrowser::show_hidden(bool shown) {
  hidden_ = shown;
  arrange_rows();
  choose(-1);
}

void FileBrowser::set_format(ExportFormat format) {
  format_ = format;
  if (!name.empty()) name = fs::path(name).replace_extension(format == ExportFormat::kJpeg ? ".jpg" : ".png").string();
}

void FileBrowser::make_folder() {
  const fs::path made = path_of(new_folder, folder_);
  std::error_code error;
  if (new_folder.empty() || folder_.empty()) return;
  if (is_there(made)) {
    message = "There is a " + made.filename().string() + " already.";
  } else if (!fs::create_directory(made, error)) {
    message = made.string() + " cannot be made: " + error.message() + ".";
  } else {
    asks_folder = false;
    go_to(made);
  }
}

void FileBrowser::answer(const fs::path& path, bool replace, ActionSink& sink) {
  const For purpose = request_->purpose;
  sink.emit(action::Dismiss{});
  switch (purpose) {
  case For::kOpen:
    return sink.emit(action::Open{path});
  case For::kAddSource:
    return sink.emit(action::AddSource{path});
  case For::kSetTarget:
    return sink.emit(action::SetTarget{path});
  case For::kSaveAs:
    return sink.emit(action::SaveAs{path, replace});
  case For::kExport:
    return sink.emit(action::Export{path, format_ == ExportFormat::kPng16 ? 16 : 8, replace});
  }
}

void FileBrowser::answer_saving(ActionSink& sink) {
  message.clear();
  if (name.empty()) {
    message = "Give it a name.";
    return;
  }
  const fs::path typed = path_of(name, folder_.empty() ? existing_folder({}) : folder_);
  if (is_folder(typed)) {
    name.clear();
    return go_to(typed);
  }
  const fs::path path = with_saved_ending(typed, request_->purpose, format_);
  if (!is_folder(path.parent_path())) {
    message = "There is no folder " + path.parent_path().string() + ".";
  } else if (is_there(path)) {
    replaces_ = path;
  } else {
    answer(path, false, sink);
  }
}

void FileBrowser::accept(ActionSink& sink) {
  message.clear();
  const FileRow* row = chosen_row();
  if (row != nullptr && row->folder) return go_to(fs::path(row->path));
  if (saves()) return answer_saving(sink);
  if (row != nullptr) answer(row->path, false, sink);
}

void FileBrowser::accept_path(ActionSink& sink) {
  message.clear();
  const fs::path path = path_of(path_text, folder_);
  if (is_folder(path)) return go_to(path.has_filename() ? path : path.parent_path());
  if (saves()) {
    if (!is_folder(path.parent_path())) {
      message = "There is no folder " + path.parent_path().string() + ".";
      return;
    }
    go_to(path.parent_path());
    name = path.filename().string();
    return answer_saving(sink);
  }
  if (is_there(path))
    answer(path, false, sink);
  else
    message = "There is no " + path.string() + ".";
}

void FileBrowser::confirm(ActionSink& sink) {
  if (path_is_typed()) return accept_path(sink);
  if (saves()) return answer_saving(sink);
  accept(sink);
}

bool FileBrowser::can_confirm() const {
  return path_is_typed() || (saves() ? !name.empty() : chosen_row() != nullptr);
}

void FileBrowser::click(int index) {
  path_text = place_text();
  choose(index);
}

void FileBrowser::replace(ActionSink& sink) {
  if (replaces_) answer(fs::path(*replaces_), true, sink);
}

void FileBrowser::cancel(ActionSink& sink) {
  if (replaces_) return replaces_.reset();
  if (asks_folder) {
    asks_folder = false;
    return;
  }
  sink.emit(action::Dismiss{});
}

void FileBrowser::move(int by) {
  if (rows_.empty()) return;
  choose(std::clamp(chosen_ + by, 0, static_cast<int>(rows_.size()) - 1));
}

void FileBrowser::jump(char typed, double now_s) {
  const bool goes_on = now_s < jump_until_s_;
  if (!goes_on) jump_text_.clear();
  jump_text_ += typed;
  jump_until_s_ = now_s + kTypingPause_s;
  // The same letter again goes to the next name that begins with it.
  const bool again = jump_text_.find_first_not_of(typed) == std::string::npos;
  const int found = find_by_prefix(rows_, again ? std::string_view(jump_text_).substr(0, 1) : jump_text_,
                                   again ? chosen_ + 1 : chosen_);
  if (found >= 0) choose(found);
}

bool FileBrowser::begin_path(std::string_view text) {
  text = text.substr(0, text.find_first_of("\r\n"));
  const std::size_t at = text.find_first_not_of(" \t");
  if (at == std::string_view::npos || (text[at] != '/' && text[at] != '~')) return false;
  path_text = text.substr(at);
  path_begins = true;
  return true;
}

void FileBrowser::read_keys(const InputEvents& events, bool typing, double now_s, ActionSink& sink) {
  for (const InputEvent& event : events) {
    const bool down = event.kind == InputEvent::Kind::kKeyDown || event.kind == InputEvent::Kind::kKeyRepeat;
    if (!down || event.modifiers.ctrl || event.modifiers.alt) continue;
    if (event.key == Key::kEscape) return cancel(sink);
    if (typing) continue;
    switch (event.key) {
    case Key::kUp:
      move(-1);
      break;
    case Key::kDown:
      move(1);
      break;
    case Key::kPageUp:
      move(-kPage);
      break;
    case Key::kPageDown:
      move(kPage);
      break;
    case Key::kHome:
      move(-static_cast<int>(rows_.size()));
      break;
    case Key::kEnd:
      move(static_cast<int>(rows_.size()));
      break;
    case Key::kBackspace:
      go_up();
      break;
    case Key::kEnter:
      return replaces_ ? replace(sink) : accept(sink);
    default:
      if (event.key != key_of('/') && static_cast<int>(event.key) > 32 && static_cast<int>(event.key) < 127)
        jump(static_cast<char>(std::tolower(static_cast<int>(event.key))), now_s);
    }
  }
}

} // namespace oversketch
