#pragma once

#include "core/base/result.h"
#include "core/io/file_claim.h"
#include "core/io/limits.h"
#include "core/io/session_journal.h"
#include "ui/state/editor_state.h"
#include "ui/state/file_jobs.h"
#include "ui/widgets/frame_reply.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace oversketch {

/// Carries out what panels and tools ask for: the one place where the window's state changes.
///
/// Knows neither window nor graphics.  Files are read and written on the sessions' workers; what comes of it is taken
/// up by update(), so that no call here waits for a disk.
/// @threads one thread, the window's.
class Editor {
public:
  struct Setup {
    /// The project's folder of that name: samples.
    std::filesystem::path assets;
    Preferences preferences;
    /// Called from any thread when update() has something to do; must be quick.
    std::function<void()> wake;
    /// Called with preferences that have changed.
    std::function<void(const Preferences&)> keep_preferences;
    /// Where journals of unsaved work lie (default_state_folder()); empty: none are kept, and none are looked for.
    std::filesystem::path state_folder = {};
  };
  explicit Editor(Setup setup);
  ~Editor();
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  const EditorState& state() const { return state_; }

  /// Takes what workers have finished, tells of what was refused, fits the views that wait for it.  Once a frame,
  /// before it is drawn.
  /// @param canvases  where they were in the last frame.
  /// @param now_s     the frame clock.
  void update(const CanvasRects& canvases, double now_s);

  void perform(Action action);
  /// The actions of one frame.
  void perform_all(std::vector<Action> actions);

  /// Runs a whole script in a tab of its own, as the command line would.
  void run_script_in_tab(const std::filesystem::path& script, const std::filesystem::path& out);
  /// Writes the session in front as a script, and waits for it.
  Result<void> record_front(const std::filesystem::path& path);

  /// Whether anything is still being worked on.
  bool busy() const;
  /// Everything that was to be done before leaving is done.
  bool wants_to_quit() const { return quit_; }
  /// The end, in order: what is not saved was not wanted, and the journals go.
  void leave();
  /// What went wrong since the last call.
  std::vector<Error> take_problems();

private:
  struct Inbox;
  /// What the editor remembers of a tab besides what is shown.
  struct Memory {
    std::uint64_t problem_number = 0;
    Hash source;
    Hash target;
    bool saving = false;
    /// Work on its session whose outcome has not been taken yet.
    int running = 0;
    /// The project that is being opened in it; empty once it is there.
    std::filesystem::path coming;
    std::shared_ptr<SessionJournal> journal;
    /// Why not all that was done is in it, and whether that is said.
    std::optional<Error> unkept;
    bool tells_unkept = false;
    /// Of the tab's path; none where another window has it.
    std::optional<FileClaim> claim;
    /// The file there as it was opened or saved last.
    std::optional<FileStamp> stamp;
  };
  /// A session whose tab is gone, until its work has stopped.
  struct Closed {
    std::unique_ptr<LiveSession> session;
    std::shared_ptr<SessionJournal> journal;
  };
  /// Tabs are being saved in order to be closed.
  struct Leaving {
    /// That one; none: all, and the program ends.
    std::optional<int> tab;
    std::set<int> saved;
  };
  using Then = std::function<void(Editor&, const Result<void>&)>;

  void perform_view(const Action& action);
  void perform_window(const Action& action);
  void say(std::string text);
  void say(const Error& error);

  Tab& add_tab(std::string name);
  /// The tab in front while nothing has begun in it, else a new one.
  Tab& empty_tab();
  /// "Untitled", "Untitled 2"…: the first that no tab has.
  std::string unused_name(const std::string& stem) const;
  /// Nothing has begun in it.
  bool is_untouched(const Tab& tab) const;
  Tab* find_tab(int id);
  std::optional<std::size_t> index_of(int id) const;
  void remove_tab(std::size_t index);
  /// Runs work on the tab's session; `then` is called here, by update(), unless the tab is gone by then.
  void run(Tab& tab, std::string label, LiveSession::Job job, Then then);
  IoLimits io_limits() const;
  void request_file(FileRequest::For purpose, std::filesystem::path proposal);
  void remember_file(const std::filesystem::path& path);

  /// @param remember  among the recent files.
  void open(const std::filesystem::path& path, bool remember = true);
  void add_source(const std::filesystem::path& path);
  void set_target(const std::filesystem::path& path);
  void new_document(const action::NewDocument& asked);
  void save(Tab& tab);
  void save_as(const action::SaveAs& asked);
  void save_to(Tab& tab, const std::filesystem::path& path);
  void export_again();
  void export_to(const action::Export& asked);
  void search_lost_work();
  void take_lost_work(std::vector<AbandonedJournal> found);
  void recover(std::size_t index);
  /// Those of what is to be recovered whose files are no longer being opened.
  void recover_waiting();
  bool is_opening(const std::filesystem::path& project) const;
  void recover_now(const RecoveredWork& work);
  void tell_unrecovered(std::size_t index, const Error& error);
  /// Closes the tab that has the project open as it was saved, for one with newer work on it.
  /// @returns the tab's hold on the file; none where there is no such tab, or something has been done in it.
  std::optional<FileClaim> take_over(const std::filesystem::path& project);
  void discard_recovered(const action::DiscardRecovered& asked);
  void close(const action::CloseTab& asked);
  void quit(const action::Quit& asked);
  void advance_leaving();
  bool ask_to_replace(const std::filesystem::path& path, Action again);
  /// The same of a tab's own file where another program has written it meanwhile.
  bool ask_to_replace_newer(const Tab& tab);
  /// Says in the middle of the window that a file was not written, and offers to write another.
  void tell_failure(const std::string& title, const Error& error, const std::string& elsewhere, Action again);

  /// Says over the canvases that a file was not opened; work goes on meanwhile.
  void tell_unopened(const std::filesystem::path& path, const Error& error);
  void write_notice();
  void dismiss_notice();

  void take_inbox();
  void watch_tab(Tab& tab);
  void fit(Tab& tab, Side side);
  std::optional<Point> picture_size(const Tab& tab, Side side) const;
  std::optional<Point> canvas_size(Side side) const;
  void zoom(Side side, double factor);
  void show_compare(Tab& tab);

  Setup setup_;
  EditorState state_;
  std::shared_ptr<Inbox> inbox_;
  std::map<int, Memory> memories_;
  std::optional<Leaving> leaving_;
  CanvasRects canvases_;
  CanvasRects last_canvases_;
  double now_s_ = 0;
  /// Lines of the notice that stay until the next file is opened.
  std::vector<std::string> told_;
  int next_tab_ = 1;
  bool quit_ = false;
  std::vector<Error> problems_;
  std::vector<Closed> closed_;
  /// Earlier runs' work is being looked for, or thrown away.
  bool searching_ = false;
  /// To be recovered once the tabs that open the same files have them.
  std::vector<RecoveredWork> waiting_;
  std::jthread janitor_;
};

/// An error as one line for a person: what is wrong, and where.
std::string to_line(const Error& error);

} // namespace oversketch
