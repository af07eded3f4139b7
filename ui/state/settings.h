#pragma once

#include "core/base/result.h"
#include "ui/state/preferences.h"

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

namespace oversketch {

/// $XDG_CONFIG_HOME/oversketch/settings.json, ~/.config where that is not set (or no absolute path, as its
/// specification has it); empty where there is no home either.
std::filesystem::path settings_path();

struct LoadedPreferences {
  Preferences preferences;
  /// For the person, when the file could not be used: then these are the defaults.
  std::optional<Error> problem;
};

/// Reads the preferences; a file that is not there means the defaults.  Unknown keys are left alone, values of a wrong
/// kind or out of range count as not there.
LoadedPreferences load_preferences(const std::filesystem::path& path);

/// Writes them, whole or not at all; what else the file holds is kept.
/// @errors file.write.
Result<void> save_preferences(const Preferences& preferences, const std::filesystem::path& path);

/// The next tolerance, screen pixels: a step that a hand can feel, whatever it is now.
double stepped_tolerance(double tolerance_px, bool greater);

/// Within their ranges; at most kMostRecent recent files.
Preferences put_in_range(Preferences preferences);
inline constexpr std::size_t kMostRecent = 12;

/// Writes preferences on a thread of its own, the newest only; the last ones when it ends.
class PreferencesKeeper {
public:
  /// @param path  empty: nothing is ever written.
  explicit PreferencesKeeper(std::filesystem::path path);
  ~PreferencesKeeper();
  PreferencesKeeper(const PreferencesKeeper&) = delete;
  PreferencesKeeper& operator=(const PreferencesKeeper&) = delete;

  void keep(Preferences preferences);
  /// Why the last writing failed; each failure once.
  std::optional<Error> take_problem();

private:
  void write_all();

  std::filesystem::path path_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Preferences> waiting_;
  std::optional<Error> problem_;
  bool ending_ = false;
  std::jthread thread_;
};

} // namespace oversketch
