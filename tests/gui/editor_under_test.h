#pragma once

#include "tests/gui/hand.h"
#include "tests/gui/processes.h"
#include "tests/support/temp_folder.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oversketch::testing {

using Json = nlohmann::json;

/// The real program in a real window on a virtual screen, and a hand that uses it.
///
/// What happens is read from the map that the program keeps of its window (--ui-map).  Nothing here sleeps: each wait
/// ends when the map says what it waits for, or fails after kPatience_s.
class EditorUnderTest {
public:
  struct Setup {
    std::vector<std::string> arguments = {};
    std::map<std::string, std::string> environment = {};
    /// Of preferences, as settings.json holds them.
    Json preferences = Json::object();
    int width = 1280;
    int height = 800;
  };
  explicit EditorUnderTest(Setup setup);
  ~EditorUnderTest();

  /// Until the window is there and at rest.
  bool start();
  Hand& hand() { return *hand_; }
  Process& program() { return *program_; }
  const TempFolder& folder() const { return folder_; }
  /// What the program printed.
  std::string printed() const { return folder_.read("printed"); }

  /// The map as it is now; null before there is one.
  Json map() const;
  /// Waits until the map fulfils something.
  bool wait_for(const std::string& what, const std::function<bool(const Json&)>& holds);
  /// Waits until everything that the hand did has been taken, and all work that came of it is done.
  bool rest();

  /// The middle of a widget, window pixels.
  std::optional<Point> widget(const std::string& id) const;
  /// Clicks a widget, which must be there, and rests.
  bool click(const std::string& id);
  /// Presses keys and rests.
  bool press(const std::string& chord);
  /// Where a pixel of a picture is in the window; side is "source" or "target".
  Point to_window(const std::string& side, Point picture) const;
  /// Draws on a picture, and rests.
  bool draw(const std::string& side, const Points& picture);
  /// Gives the window another size, and rests.
  bool resize(int width, int height);
  /// Closes the window as a window manager would, and waits for the program's end.
  std::optional<int> close();

private:
  TempFolder folder_;
  Setup setup_;
  std::unique_ptr<VirtualScreen> screen_;
  std::unique_ptr<Process> program_;
  std::unique_ptr<Hand> hand_;
  int watch_ = -1;
};

} // namespace oversketch::testing
