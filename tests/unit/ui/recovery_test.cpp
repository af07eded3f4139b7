#include "ui/panels/recovery_bar.h"
#include "ui/state/editor.h"
#include "ui/state/recovered_work.h"

#include "core/image/image_io.h"
#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;
using testing::wavy_image;

/// A run of the program without a window.
class Program {
public:
  explicit Program(const fs::path& state_folder) : editor({{}, {}, {}, {}, state_folder}) { settle(); }

  void settle() {
    do {
      editor.update({}, now_s_ += 0.01);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (editor.busy());
    editor.update({}, now_s_ += 0.01);
  }
  void does(Action action) {
    editor.perform_all({std::move(action)});
    settle();
  }
  const EditorState& state() const { return editor.state(); }
  std::shared_ptr<const Snapshot> snapshot() const { return state().tab()->session->snapshot(); }

  Editor editor;

private:
  double now_s_ = 0;
};

class Recovery : public ::testing::Test {
protected:
  fs::path picture(const std::string& name, int width) {
    EXPECT_TRUE(save_image(wavy_image(width, 40, 0.3), folder_ / name).ok());
    return folder_ / name;
  }
  /// Three steps that are saved nowhere; the run ends as if it were killed.
  Document crash() {
    Program run(state_);
    run.does(action::Open{picture("sea.jpg", 60)});
    run.does(action::AddSource{picture("fish.png", 50)});
    run.does(action::Execute{LayerRename{{}, "puffer"}});
    run.does(action::Undo{});
    return run.snapshot()->document;
  }
  /// Saves a project with one layer and names that "newer", which is saved nowhere; the run ends as if it were killed.
  void crash_after_saving(const fs::path& file) {
    Program run(state_);
    run.does(action::Open{picture("sea.png", 60)});
    run.does(action::AddSource{std::string(kTargetName)});
    run.does(action::SaveAs{file, true});
    run.does(action::Execute{LayerRename{{}, "newer"}});
  }
  bool is_nothing_left() const {
    std::error_code failure;
    return !fs::exists(state_ / "journals", failure) || fs::is_empty(state_ / "journals");
  }

  TempFolder folder_;
  fs::path state_ = folder_ / "state";
};

TEST_F(Recovery, a_journal_that_cannot_be_written_is_said_as_long_as_it_is_so) {
  folder_.write("plain", "a file, not a folder");
  Program run(folder_ / "plain");
  run.does(action::Open{picture("sea.png", 60)});
  run.does(action::AddSource{std::string(kTargetName)});
  EXPECT_NE(run.state().notice.find("crash"), std::string::npos) << run.state().notice;
  EXPECT_TRUE(run.editor.take_problems().empty());
  EXPECT_EQ(run.snapshot()->document.layers.size(), 1u);
  run.does(action::Open{picture("fish.png", 50)});
  EXPECT_NE(run.state().notice.find("crash"), std::string::npos) << "another file that is opened does not mend it";
  run.does(action::SelectTab{0});
  run.does(action::DismissNotice{});
  run.does(action::Execute{LayerRename{{}, "puffer"}});
  EXPECT_TRUE(run.state().notice.empty()) << "said already";
  run.does(action::Open{picture("third.png", 40)});
  run.does(action::AddSource{std::string(kTargetName)});
  EXPECT_NE(run.state().notice.find("third cannot be kept"), std::string::npos) << run.state().notice;
  run.does(action::CloseTab{2, true});
  EXPECT_EQ(run.state().notice.find("third"), std::string::npos) << run.state().notice;
}

TEST_F(Recovery, a_clean_end_leaves_nothing) {
  {
    Program run(state_);
    run.does(action::Open{picture("sea.png", 60)});
    run.does(action::AddSource{std::string(kTargetName)});
    EXPECT_FALSE(is_nothing_left());
    run.does(action::CloseTab{0, true});
    EXPECT_TRUE(is_nothing_left()) << "closed without saving, as it was wanted";
    run.does(action::Open{folder_ / "sea.png"});
    run.does(action::AddSource{std::string(kTargetName)});
    EXPECT_FALSE(is_nothing_left());
    run.does(action::Quit{true});
    ASSERT_TRUE(run.editor.wants_to_quit());
    run.editor.leave();
  }
  EXPECT_TRUE(is_nothing_left());
}

TEST_F(Recovery, what_a_crash_left_is_offered_and_comes_back_with_its_history) {
  const Document lost = crash();
  Program run(state_);
  ASSERT_EQ(run.state().recovered.size(), 1u);
  EXPECT_EQ(run.state().recovered[0].name, "sea");
  EXPECT_EQ(run.state().recovered[0].steps, 4u);
  EXPECT_EQ(run.state().recovered[0].when.substr(0, 6), "today ");
  run.does(action::Recover{7});
  EXPECT_TRUE(run.state().tabs.empty());
  run.does(action::Recover{0});
  ASSERT_EQ(run.state().tabs.size(), 1u) << run.state().said;
  EXPECT_TRUE(run.state().recovered.empty());
  EXPECT_EQ(run.snapshot()->document, lost);
  EXPECT_EQ(run.snapshot()->history.size(), 3u);
  EXPECT_NE(run.snapshot()->history[0].find("sea.jpg"), std::string::npos) << run.snapshot()->history[0];
  EXPECT_EQ(run.snapshot()->cursor, 1u);
  EXPECT_TRUE(run.snapshot()->modified);
  EXPECT_EQ(run.state().tab()->name, "sea");
  run.does(action::Redo{});
  EXPECT_EQ(run.snapshot()->document.layers[0].name, "puffer");
}

TEST_F(Recovery, what_was_recovered_is_recovered_again_after_the_next_crash) {
  crash();
  Document lost;
  {
    Program run(state_);
    run.does(action::Recover{0});
    run.does(action::Execute{LayerRename{{}, "again"}});
    lost = run.snapshot()->document;
  }
  Program run(state_);
  ASSERT_EQ(run.state().recovered.size(), 1u);
  run.does(action::Recover{0});
  EXPECT_EQ(run.snapshot()->document, lost);
}

TEST_F(Recovery, left_alone_it_is_offered_again_and_thrown_away_only_when_told_twice) {
  crash();
  {
    Program run(state_);
    EXPECT_FALSE(make_recovery_bar_model(run.state(), true).text.empty());
    EXPECT_EQ(make_recovery_bar_model(run.state(), false).documents, 0u) << "the empty state offers it itself";
    run.does(action::LeaveRecovered{});
    EXPECT_TRUE(make_recovery_bar_model(run.state(), true).text.empty());
    run.does(action::Quit{});
    run.editor.leave();
  }
  {
    Program run(state_);
    ASSERT_EQ(run.state().recovered.size(), 1u);
    run.does(action::DiscardRecovered{0});
    ASSERT_TRUE(run.state().question);
    EXPECT_EQ(run.state().recovered.size(), 1u);
    run.editor.perform_all({action::Dismiss{}, run.state().question->answers[0].actions[0]});
    run.settle();
    EXPECT_TRUE(run.state().recovered.empty());
  }
  EXPECT_TRUE(Program(state_).state().recovered.empty());
}

TEST_F(Recovery, a_damaged_journal_stays_where_it_is) {
  crash();
  for (const auto& journal : fs::directory_iterator(state_ / "journals"))
    fs::remove_all(journal.path() / "images");
  Program run(state_);
  run.does(action::Recover{0});
  EXPECT_TRUE(run.state().tabs.empty());
  EXPECT_FALSE(run.state().said.empty());
  ASSERT_EQ(run.state().recovered.size(), 1u);
  EXPECT_FALSE(is_nothing_left());
  // It is told, and can be thrown away there.
  ASSERT_TRUE(run.state().question);
  ASSERT_EQ(run.state().question->answers.size(), 2U);
  EXPECT_TRUE(run.state().question->answers[0].actions.empty());
  run.does(run.state().question->answers[1].actions.front());
  EXPECT_TRUE(run.state().recovered.empty());
}

TEST_F(Recovery, a_project_comes_back_under_its_own_name) {
  const fs::path file = folder_ / "work.ora";
  crash_after_saving(file);
  Program run(state_);
  ASSERT_EQ(run.state().recovered.size(), 1u);
  EXPECT_EQ(run.state().recovered[0].name, "work");
  EXPECT_EQ(run.state().recovered[0].steps, 1u) << "since it was saved";
  run.does(action::Recover{0});
  EXPECT_EQ(run.state().tab()->path, file);
  EXPECT_TRUE(run.snapshot()->modified);
  run.does(action::Save{});
  EXPECT_FALSE(run.state().file_request);
  EXPECT_FALSE(run.snapshot()->modified);
  EXPECT_FALSE(run.state().question);
}

TEST_F(Recovery, a_project_that_was_written_meanwhile_is_replaced_only_when_told_so) {
  const fs::path file = folder_ / "work.ora";
  crash_after_saving(file);
  folder_.write("work.ora", "precious");
  Program run(state_);
  run.does(action::Recover{0});
  run.does(action::Save{});
  ASSERT_TRUE(run.state().question);
  EXPECT_EQ(folder_.read("work.ora"), "precious");
  EXPECT_TRUE(run.snapshot()->modified);
  run.editor.perform_all({run.state().question->answers[0].actions.front(), action::Dismiss{}});
  run.settle();
  EXPECT_FALSE(run.state().question);
  EXPECT_FALSE(run.snapshot()->modified);
  EXPECT_NE(folder_.read("work.ora"), "precious");
  run.does(action::Execute{LayerRename{{}, "again"}});
  run.does(action::Save{});
  EXPECT_FALSE(run.state().question) << "it is its own file again";
  EXPECT_FALSE(run.snapshot()->modified);
}

TEST_F(Recovery, takes_the_place_of_its_project_while_that_is_as_it_was_saved) {
  const fs::path file = folder_ / "work.ora";
  for (const bool touched : {false, true}) {
    SCOPED_TRACE(touched);
    crash_after_saving(file);
    Program run(state_);
    run.does(action::Open{file});
    run.does(action::Open{picture("other.png", 50)});
    if (touched) {
      run.does(action::SelectTab{0});
      run.does(action::Execute{LayerRename{{}, "own"}});
    }
    run.does(action::Recover{0});
    ASSERT_EQ(run.state().tabs.size(), touched ? 3U : 2U);
    EXPECT_EQ(run.state().front, run.state().tabs.size() - 1);
    EXPECT_EQ(run.snapshot()->document.layers[0].name, "newer");
    EXPECT_EQ(run.state().tab()->read_only, touched);
    run.does(action::Save{});
    EXPECT_EQ(run.snapshot()->modified, touched);
    EXPECT_EQ(run.state().file_request.has_value(), touched);
    run.does(action::Dismiss{});
    run.does(action::SelectTab{0});
    EXPECT_EQ(run.snapshot()->document.layers.empty(), !touched) << "no other tab is closed";
    run.does(action::Quit{true});
    run.editor.leave();
  }
}

TEST_F(Recovery, the_second_window_on_a_project_is_told_and_does_not_save_over_it) {
  const fs::path file = folder_ / "work.ora";
  Program first(state_);
  first.does(action::Open{picture("sea.png", 60)});
  first.does(action::AddSource{std::string(kTargetName)});
  first.does(action::SaveAs{file});
  Program second(state_);
  second.does(action::Open{file});
  ASSERT_EQ(second.state().tabs.size(), 1u);
  EXPECT_TRUE(second.state().tab()->read_only);
  EXPECT_NE(second.state().said.find("another"), std::string::npos) << second.state().said;
  second.does(action::Execute{LayerRename{{}, "mine"}});
  second.does(action::SaveAs{file, true});
  EXPECT_TRUE(second.snapshot()->modified);
  second.does(action::SaveAs{folder_ / "mine.ora"});
  EXPECT_FALSE(second.snapshot()->modified);
  EXPECT_FALSE(second.state().tab()->read_only);
  // Its own file is free as soon as its window is closed, and the first one's stays its own.
  first.does(action::Save{});
  EXPECT_FALSE(first.snapshot()->modified);
  first.does(action::CloseTab{0});
  second.does(action::Open{file});
  EXPECT_FALSE(second.state().tab()->read_only) << second.state().said;
}

TEST(LostWork, is_told_by_the_clock_on_the_wall) {
  std::tm noon{};
  noon.tm_year = 126, noon.tm_mon = 2, noon.tm_mday = 12, noon.tm_hour = 12, noon.tm_isdst = -1;
  const auto now = std::chrono::system_clock::from_time_t(std::mktime(&noon));
  const auto before = [&](int hours, int minutes = 0) {
    return describe_time(now - std::chrono::hours(hours) - std::chrono::minutes(minutes), now);
  };
  EXPECT_EQ(before(0, 5), "today 11:55");
  EXPECT_EQ(before(12), "today 00:00");
  EXPECT_EQ(before(12, 1), "yesterday 23:59");
  EXPECT_EQ(before(48), "Tuesday 12:00");
  EXPECT_EQ(before(6 * 24), "Friday 12:00");
  EXPECT_EQ(before(7 * 24), "5 March 2026");
}

TEST_F(Recovery, waits_for_its_project_where_that_is_still_being_opened) {
  const fs::path file = folder_ / "work.ora";
  crash_after_saving(file);
  Program run(state_);
  run.editor.perform_all({action::Open{file}, action::Open{file}, action::Recover{0}});
  run.settle();
  ASSERT_EQ(run.state().tabs.size(), 1U) << "nor is it opened twice";
  EXPECT_EQ(run.snapshot()->document.layers[0].name, "newer");
  EXPECT_FALSE(run.state().tab()->read_only);
}

} // namespace
} // namespace oversketch
