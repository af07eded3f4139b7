#include "ui/state/settings.h"

#include "tests/support/kept_variable.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace oversketch {
namespace {

using testing::TempFolder;

TEST(Settings, a_broken_file_means_the_defaults_and_says_so) {
  const TempFolder folder;
  for (const char* text : {"", "{", "[1, 2]", "nonsense", "{\"theme\": "}) {
    folder.write("settings.json", text);
    const LoadedPreferences loaded = load_preferences(folder / "settings.json");
    EXPECT_EQ(loaded.preferences, Preferences()) << text;
    ASSERT_TRUE(loaded.problem) << text;
    EXPECT_EQ(loaded.problem->code, "settings.damaged");
  }
  EXPECT_TRUE(load_preferences(folder.path()).problem) << "a folder is no file";
}

TEST(Settings, no_file_means_the_defaults_without_a_word) {
  const TempFolder folder;
  EXPECT_FALSE(load_preferences(folder / "none.json").problem);
  EXPECT_FALSE(load_preferences({}).problem);
}

TEST(Settings, values_that_make_no_sense_count_as_not_there) {
  const TempFolder folder;
  folder.write("settings.json", R"({"theme": "pink", "ui_scale": 1e9, "tolerance_px": "ten", "wheel_zooms": 1,
                                    "smoothing": "none", "recent_files": ["/a.png", 7, ""]})");
  Preferences expected;
  expected.smoothing = Smoothing::kNone;
  expected.recent_files = {"/a.png"};
  const LoadedPreferences loaded = load_preferences(folder / "settings.json");
  EXPECT_FALSE(loaded.problem);
  EXPECT_EQ(loaded.preferences, expected);
}

Preferences unusual() {
  Preferences preferences;
  preferences.theme = Theme::kLight;
  preferences.ui_scale = 1.75;
  preferences.wheel_zooms = false;
  preferences.smoothing = Smoothing::kStabiliser;
  preferences.tolerance_px = 17.5;
  preferences.history_mib = 123;
  preferences.pictures_mib = 456;
  preferences.system_dialog = true;
  preferences.recent_files = {"/ü/a b.ora", "/c.png"};
  return preferences;
}

TEST(Settings, what_is_kept_is_read_again_and_other_keys_stay) {
  const TempFolder folder;
  const auto path = folder / "deep/er/settings.json";
  ASSERT_TRUE(save_preferences(unusual(), path).ok());
  EXPECT_EQ(load_preferences(path).preferences, unusual());
  folder.write("settings.json", R"({"of_a_newer_version": [1, 2], "ui_scale": 2})");
  ASSERT_TRUE(save_preferences(unusual(), folder / "settings.json").ok());
  EXPECT_NE(folder.read("settings.json").find("of_a_newer_version"), std::string::npos);
  EXPECT_EQ(load_preferences(folder / "settings.json").preferences, unusual());
}

TEST(Settings, the_keeper_writes_the_last_ones) {
  const TempFolder folder;
  {
    PreferencesKeeper keeper(folder / "settings.json");
    for (int i = 0; i < 50; ++i)
      keeper.keep({});
    keeper.keep(unusual());
  }
  EXPECT_EQ(load_preferences(folder / "settings.json").preferences, unusual());
  folder.write("plain", "");
  PreferencesKeeper keeper(folder / "plain/settings.json");
  keeper.keep({});
  std::optional<Error> problem;
  while (!problem)
    problem = keeper.take_problem();
  EXPECT_EQ(problem->code, "file.write");
}

TEST(Settings, tolerances_step_by_what_a_hand_feels_and_end) {
  EXPECT_EQ(stepped_tolerance(10, true), 13);
  EXPECT_EQ(stepped_tolerance(10, false), 8);
  EXPECT_EQ(stepped_tolerance(2, true), 3);
  EXPECT_EQ(stepped_tolerance(1, false), 1);
  EXPECT_EQ(stepped_tolerance(90, true), 100);
}

TEST(Settings, the_file_lies_where_the_desktop_says) {
  const testing::KeptVariable config("XDG_CONFIG_HOME"), home("HOME");
  setenv("XDG_CONFIG_HOME", "/somewhere", 1);
  EXPECT_EQ(settings_path(), "/somewhere/oversketch/settings.json");
  setenv("XDG_CONFIG_HOME", "relative", 1);
  setenv("HOME", "/home/her", 1);
  EXPECT_EQ(settings_path(), "/home/her/.config/oversketch/settings.json");
  unsetenv("HOME");
  EXPECT_EQ(settings_path(), "");
}

} // namespace
} // namespace oversketch
