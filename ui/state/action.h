#pragma once

#include "core/document/command.h"
#include "ui/state/preferences.h"
#include "ui/state/view_state.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace oversketch {

/// Anything the window may ask for, as plain data.  Panels and tools only ever emit these; the Editor carries them out.
namespace action {

// The document in front.
struct Execute {
  Command command;
};
/// The gesture in hand; see LiveSession.
struct Preview {
  Command command;
};
struct Commit {};
struct Abandon {};
struct Undo {
  int steps = 1;
};
struct Redo {
  int steps = 1;
};
struct Jump {
  std::size_t entry = 0;
};
struct CancelWork {};

// Files.  Without a path a dialog asks for it.
/// In a tab of its own.
struct NewDocument {
  std::optional<DocumentNew> what;
};
/// A project, a script or a picture: in a tab of its own.
struct Open {
  std::filesystem::path path;
};
/// A picture becomes the source of a new layer, or ("@target") the target itself does.
struct AddSource {
  std::filesystem::path path;
};
struct SetTarget {
  std::filesystem::path path;
};
struct Save {};
struct SaveAs {
  std::filesystem::path path;
  /// Over another file that is there: otherwise that is asked.
  bool replace = false;
};
/// To where it went before.
struct ExportAgain {};
struct Export {
  std::filesystem::path path;
  int depth = 8;
  bool replace = false;
};
struct OpenSample {};
struct SelectTab {
  std::size_t tab = 0;
};
/// Asks when there are changes that are not saved.
struct CloseTab {
  std::size_t tab = 0;
  bool without_asking = false;
  /// Saves it first, and closes only when that went well.
  bool save_first = false;
};
struct Quit {
  bool without_asking = false;
  bool save_first = false;
};
/// The question or the file browser is left without an answer, or after it.
struct Dismiss {};
/// Work that an earlier run left behind: taken up in a tab of its own; left for another time; or, when asked twice,
/// thrown away.
struct Recover {
  std::size_t index = 0;
};
struct LeaveRecovered {};
struct DiscardRecovered {
  std::size_t index = 0;
  bool without_asking = false;
};

// The view.
struct PickTool {
  Tool tool = Tool::kSketch;
};
struct SetOverlays {
  Overlays overlays;
};
struct SetPreferences {
  Preferences preferences;
};
struct SetView {
  Side side = Side::kTarget;
  View view;
};
struct Fit {
  Side side = Side::kTarget;
};
/// About the middle of the canvas; `factor` times, or to that zoom.
struct ZoomBy {
  Side side = Side::kTarget;
  double factor = 1;
};
struct ZoomTo {
  Side side = Side::kTarget;
  double zoom = 1;
};
struct SetSplit {
  double split = 0.5;
};
struct SetCompare {
  LiveSession::Compare compare = LiveSession::Compare::kOff;
  double split = 0.5;
};
/// The target without the selected layer, while it is held.
struct HoldBefore {
  bool held = false;
};
struct SelectPin {
  std::optional<PinId> pin;
};
struct WantAlternatives {
  bool wanted = false;
};
enum class Window { kShortcuts, kPreferences, kAbout };
struct ShowWindow {
  Window window = Window::kShortcuts;
  bool shown = true;
};
/// What could not be opened has been read.
struct DismissNotice {};
/// A line for the status bar: why nothing happened.
struct Say {
  std::string text;
};

} // namespace action

/// Copied, moved and ended in one place: a variant of so many kinds is dear to compile.
class Action
    : public std::variant<action::Execute, action::Preview, action::Commit, action::Abandon, action::Undo, action::Redo,
                          action::Jump, action::CancelWork, action::NewDocument, action::Open, action::AddSource,
                          action::SetTarget, action::Save, action::SaveAs, action::ExportAgain, action::Export,
                          action::OpenSample, action::SelectTab, action::CloseTab, action::Quit, action::Dismiss,
                          action::Recover, action::LeaveRecovered, action::DiscardRecovered, action::PickTool,
                          action::SetOverlays, action::SetPreferences, action::SetView, action::Fit, action::ZoomBy,
                          action::ZoomTo, action::SetSplit, action::SetCompare, action::HoldBefore, action::SelectPin,
                          action::WantAlternatives, action::ShowWindow, action::DismissNotice, action::Say> {
public:
  using variant::variant;
  Action(const Action& other);
  Action(Action&& other) noexcept;
  Action& operator=(const Action& other);
  Action& operator=(Action&& other) noexcept;
  ~Action();
};

/// Where panels and tools put what they want done; carried out after the frame.
class ActionSink {
public:
  void emit(Action action) { actions_.push_back(std::move(action)); }
  std::vector<Action> take() { return std::exchange(actions_, {}); }
  const std::vector<Action>& pending() const { return actions_; }

private:
  std::vector<Action> actions_;
};

} // namespace oversketch
