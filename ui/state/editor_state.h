#pragma once

#include "core/base/file.h"
#include "core/session/live_session.h"
#include "ui/state/action.h"
#include "ui/state/preferences.h"
#include "ui/state/view_state.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// One document in the window.
struct Tab {
  /// Of this tab and no other, as long as the program runs.
  int id = 0;
  std::unique_ptr<LiveSession> session;
  DocumentView view;
  /// What the window's title and the tab say: the file's name without its ending, or "Untitled".
  std::string name;
  /// Where it was opened from or saved to; empty before that.
  std::filesystem::path path;
  /// Where dialogs begin: beside what was opened or saved last.
  std::filesystem::path folder;
  std::filesystem::path exported_to;
  int export_depth = 8;
  /// Cannot be saved over its file (a newer version's, or open in another window): save asks for another name.
  bool read_only = false;
};

/// Something that must be answered before work goes on; drawn as a dialog with one button per answer.  Each answer is
/// an action that the dialog emits, and with it action::Dismiss; so does leaving it with Esc.
struct Question {
  struct Answer {
    /// Of the button; its widget is called "question." + id.
    std::string id;
    std::string label;
    /// None: nothing is done.
    std::vector<Action> actions;
    /// What Enter chooses.
    bool preferred = false;
  };
  std::string title;
  std::string text;
  std::vector<Answer> answers;
};

/// A file is wanted: the browser is open for it.  The choice is emitted as the action with its path filled in.
struct FileRequest {
  enum class For { kOpen, kAddSource, kSetTarget, kSaveAs, kExport };
  For purpose = For::kOpen;
  /// Where the browser begins: a folder, or a file's name that is proposed.
  std::filesystem::path proposal;
};

/// What an earlier run did not save.
struct RecoveredWork {
  std::filesystem::path journal;
  /// The file that it was opened from or saved to; empty for one that never was.
  std::filesystem::path project;
  /// Of the document, as a person knows it.
  std::string name;
  /// "today 14:03", "Tuesday 09:12".
  std::string when;
  /// Since it was last saved.
  std::size_t steps = 0;
  /// The project's file as that run knew it.
  std::optional<FileStamp> stamp = {};
};

/// All that the window shows and no document holds.
struct EditorState {
  std::vector<Tab> tabs;
  std::size_t front = 0;
  Tool tool = Tool::kOutline;
  Overlays overlays;
  Preferences preferences;
  /// The status bar's line, and until when it stays (the frame clock's seconds).
  std::string said;
  double said_until = 0;
  bool show_shortcuts = false;
  bool show_preferences = false;
  bool show_about = false;
  std::optional<Question> question;
  /// What could not be opened or kept and why, line by line; over the canvases until it is dismissed or the next file
  /// comes.
  std::string notice;
  std::optional<FileRequest> file_request;
  /// The size and colour of a new document are asked for.
  bool asks_new_document = false;
  /// Newest first.
  std::vector<RecoveredWork> recovered;
  /// Not offered over other work any more in this run.
  bool recovered_left = false;

  Tab* tab() { return front < tabs.size() ? &tabs[front] : nullptr; }
  const Tab* tab() const { return front < tabs.size() ? &tabs[front] : nullptr; }
};

} // namespace oversketch
