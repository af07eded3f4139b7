#pragma once

#include "ui/canvas/input.h"
#include "ui/panels/file_kinds.h"
#include "ui/panels/file_listing.h"
#include "ui/panels/latest_worker.h"
#include "ui/widgets/draw_context.h"
#include "ui/widgets/pictures.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// The file browser's mind: where it is, what it lists, what is typed and chosen.  Folders and pictures are read on
/// threads of its own, so that no disk is ever waited for.
///
/// An answer is emitted as Dismiss and then the request's action with its path.
class FileBrowser {
public:
  /// @param wake     called from other threads when something has been read.
  /// @param samples  the folder of the samples; may be empty.
  explicit FileBrowser(std::function<void()> wake, std::filesystem::path samples = {});

  /// Once a frame while it is open: begins anew when the request is another one, takes what has been read.
  void update(const FileRequest& request, const std::vector<std::filesystem::path>& recent);
  /// Once a frame while nothing is asked.
  void close() { request_.reset(); }

  bool saves() const;
  const FileRequest& request() const { return *request_; }
  /// Empty while the recent files are listed.
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<FileRow>& rows() const { return rows_; }
  bool reading() const { return reading_; }
  int chosen() const { return chosen_; }
  const FileRow* chosen_row() const;
  const FilePreview& preview() const { return preview_; }
  const std::vector<Place>& places() const { return places_; }
  FileFilter filter() const { return filter_; }
  FileSort sort() const { return sort_; }
  bool descending() const { return descending_; }
  bool hidden() const { return hidden_; }
  ExportFormat format() const { return format_; }
  /// The file that would be replaced, while that is asked.
  const std::optional<std::filesystem::path>& replaces() const { return replaces_; }

  void go_to(const std::filesystem::path& folder);
  void go_to_recent();
  void go_up();
  void choose(int index);
  /// With the pointer: instead of a path that is being typed.
  void click(int index);
  void set_filter(FileFilter filter);
  /// The same column again turns the order round.
  void sort_by(FileSort sort);
  void show_hidden(bool shown);
  void set_format(ExportFormat format);
  void make_folder();

  /// Enter, the button, a double click: goes into the chosen folder, or answers.
  void accept(ActionSink& sink);
  /// The name field's Enter, and the button that saves.
  void accept_name(ActionSink& sink) { answer_saving(sink); }
  /// The path field's Enter.
  void accept_path(ActionSink& sink);
  /// The button: what is typed into the path field, or else what is chosen or named.
  void confirm(ActionSink& sink);
  bool can_confirm() const;
  void replace(ActionSink& sink);
  void keep_file() { replaces_.reset(); }
  void cancel(ActionSink& sink);
  /// Text that comes while the list has the keyboard and is the beginning of a path, or a whole one that is pasted:
  /// it goes to the path field.
  /// @returns whether it is such.
  bool begin_path(std::string_view text);
  /// Arrows, Enter, Backspace, Esc, and typing that jumps to a name.
  /// @param typing  a text field has the keyboard: then only Esc counts.
  void read_keys(const InputEvents& events, bool typing, double now_s, ActionSink& sink);

  // What text fields write into.
  std::string path_text;
  std::string name;
  std::string new_folder;
  bool asks_folder = false;
  /// Why something did not go; shown until the next step.
  std::string message;
  /// The path field is to take the keyboard, behind what stands there.
  bool path_begins = false;
  /// The chosen row is to be scrolled into sight.
  bool reveal = false;

private:
  struct Question {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> files;
  };

  void begin(const FileRequest& request);
  void take_listing();
  void arrange_rows();
  void move(int by);
  void jump(char typed, double now_s);
  /// What the path field says of the folder.
  std::string place_text() const;
  bool path_is_typed() const { return path_text != place_text(); }
  void answer(const std::filesystem::path& path, bool replace, ActionSink& sink);
  void answer_saving(ActionSink& sink);

  std::optional<FileRequest> request_;
  std::vector<std::filesystem::path> recent_;
  std::vector<Place> places_;
  std::filesystem::path folder_;
  FolderListing listing_;
  std::vector<FileRow> rows_;
  bool reading_ = false;
  int chosen_ = -1;
  /// To be chosen when its folder has been read.
  std::string wanted_name_;
  FileFilter filter_ = FileFilter::kAll;
  FileSort sort_ = FileSort::kName;
  bool descending_ = false;
  bool hidden_ = false;
  ExportFormat format_ = ExportFormat::kPng;
  std::optional<std::filesystem::path> replaces_;
  std::string jump_text_;
  double jump_until_s_ = 0;
  std::filesystem::path preview_of_;
  FilePreview preview_;
  // Last, so that the threads end before what they wake.
  std::unique_ptr<LatestWorker<Question, FolderListing>> folders_;
  std::unique_ptr<LatestWorker<std::filesystem::path, FilePreview>> previews_;
};

/// Draws it as a dialog.  "browser.path", "browser.up", "browser.new_folder", "browser.place.home" …,
/// "browser.sort.name" …, "browser.row.0" …, "browser.filter", "browser.name", "browser.format.png" …,
/// "browser.accept", "browser.cancel", "browser.replace", "browser.keep".
void draw_file_browser(FileBrowser& browser, Pictures& pictures, const InputEvents& events, const DrawContext& context);

} // namespace oversketch
