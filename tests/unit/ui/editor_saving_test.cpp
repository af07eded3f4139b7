// What becomes of work: saved, exported, closed.
#include "tests/unit/ui/editor_fixture.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using testing::EditorTest;

TEST_F(EditorTest, what_was_saved_opens_again_as_it_was) {
  begin_work();
  does(action::SaveAs{folder_ / "work"});
  const fs::path file = folder_ / (std::string("work") + kProjectEnding);
  ASSERT_TRUE(fs::exists(file)) << state().said;
  EXPECT_FALSE(snapshot()->modified);
  EXPECT_EQ(state().tab()->name, "work");
  const Document saved = snapshot()->document;
  const auto history = snapshot()->history;
  does(action::CloseTab{0});
  ASSERT_TRUE(state().tabs.empty());
  does(action::Open{file});
  ASSERT_EQ(state().tabs.size(), 1u) << state().said;
  EXPECT_EQ(snapshot()->document, saved);
  EXPECT_EQ(snapshot()->history, history);
  EXPECT_FALSE(snapshot()->modified);
}

TEST_F(EditorTest, saving_that_fails_keeps_the_work_and_its_star) {
  begin_work();
  folder_.write("plain", "a file, not a folder");
  does(action::SaveAs{folder_ / "plain/work"});
  EXPECT_NE(code_of_problem(), "none");
  EXPECT_TRUE(snapshot()->modified);
  EXPECT_TRUE(state().tab()->path.empty());
  // Not in a quiet line alone.
  ASSERT_TRUE(state().question);
  EXPECT_NE(state().question->text.find("plain"), std::string::npos) << state().question->text;
  answer("elsewhere");
  EXPECT_FALSE(state().question);
  ASSERT_TRUE(state().file_request);
  EXPECT_EQ(state().file_request->purpose, FileRequest::For::kSaveAs);
}

TEST_F(EditorTest, an_export_that_fails_is_told_and_can_go_elsewhere) {
  begin_work();
  folder_.write("plain", "a file, not a folder");
  does(action::Export{folder_ / "plain/picture.png", 16});
  ASSERT_TRUE(state().question);
  answer("elsewhere");
  ASSERT_TRUE(state().file_request);
  EXPECT_EQ(state().file_request->purpose, FileRequest::For::kExport);
}

TEST_F(EditorTest, another_file_is_replaced_only_when_told_so) {
  begin_work();
  const std::string name = std::string("work") + kProjectEnding;
  folder_.write(name, "precious");
  does(action::SaveAs{folder_ / name});
  ASSERT_TRUE(state().question);
  EXPECT_EQ(folder_.read(name), "precious");
  answer("cancel");
  EXPECT_EQ(folder_.read(name), "precious");
  does(action::SaveAs{folder_ / name});
  answer("replace");
  EXPECT_NE(folder_.read(name), "precious");
  EXPECT_FALSE(snapshot()->modified);
  // Its own file is saved over without a word.
  does(action::Execute{LayerRename{{}, "other"}});
  does(action::Save{});
  EXPECT_FALSE(state().question);
  EXPECT_FALSE(snapshot()->modified);
}

TEST_F(EditorTest, a_file_that_others_wrote_meanwhile_is_replaced_only_when_told_so) {
  begin_work();
  const fs::path file = folder_ / (std::string("work") + kProjectEnding);
  does(action::SaveAs{file});
  does(action::Execute{LayerRename{{}, "mine"}});
  folder_.write(file.filename().string(), "theirs");
  for (Action again : {Action(action::Save{}), Action(action::SaveAs{file})}) {
    does(std::move(again));
    ASSERT_TRUE(state().question);
    EXPECT_EQ(folder_.read(file.filename().string()), "theirs");
    answer("cancel");
    EXPECT_TRUE(snapshot()->modified);
  }
  does(action::CloseTab{0, false, true});
  answer("cancel");
  EXPECT_EQ(state().tabs.size(), 1U) << "nor is it closed then";
  does(action::Save{});
  answer("elsewhere");
  ASSERT_TRUE(state().file_request);
  does(action::Dismiss{});
  // What is gone is no one's any more.
  fs::remove(file);
  does(action::Save{});
  EXPECT_FALSE(state().question);
  EXPECT_FALSE(snapshot()->modified);
}

TEST_F(EditorTest, the_finished_picture_is_exported_by_its_ending) {
  begin_work();
  does(action::Export{folder_ / "out.png", 16});
  const auto exported = load_image(folder_ / "out.png");
  ASSERT_TRUE(exported.ok()) << state().said;
  EXPECT_EQ(*exported, *load_image(folder_ / "sea.png"));
  EXPECT_TRUE(snapshot()->modified) << "an export is no saving";
  fs::remove(folder_ / "out.png");
  does(action::ExportAgain{});
  EXPECT_TRUE(fs::exists(folder_ / "out.png"));
  EXPECT_FALSE(state().question);
  does(action::Export{folder_ / "out.gif"});
  EXPECT_EQ(code_of_problem(), "image.unknown-extension");
}

TEST_F(EditorTest, closing_asks_about_changes) {
  begin_work();
  does(action::CloseTab{0});
  ASSERT_TRUE(state().question);
  answer("cancel");
  EXPECT_EQ(state().tabs.size(), 1u);
  does(action::CloseTab{0});
  answer("discard");
  EXPECT_TRUE(state().tabs.empty());
}

TEST_F(EditorTest, closing_after_saving_waits_for_a_name_and_for_the_file) {
  begin_work();
  does(action::CloseTab{0});
  answer("save");
  ASSERT_TRUE(state().file_request);
  EXPECT_EQ(state().tabs.size(), 1u);
  does(action::Dismiss{});
  EXPECT_EQ(state().tabs.size(), 1u) << "without a name nothing is closed";
  does(action::CloseTab{0});
  answer("save");
  editor_.perform_all({action::SaveAs{folder_ / "work"}, action::Dismiss{}});
  settle();
  EXPECT_TRUE(state().tabs.empty());
  EXPECT_TRUE(fs::exists(folder_ / (std::string("work") + kProjectEnding)));
}

TEST_F(EditorTest, a_saving_that_fails_closes_nothing) {
  begin_work();
  does(action::Quit{});
  answer("save");
  folder_.write("plain", "");
  editor_.perform_all({action::SaveAs{folder_ / "plain/work"}, action::Dismiss{}});
  settle();
  EXPECT_EQ(state().tabs.size(), 1u);
  EXPECT_FALSE(editor_.wants_to_quit());
}

TEST_F(EditorTest, quitting_asks_and_saves_every_document) {
  begin_work();
  does(action::Open{picture("second.png")});
  does(action::AddSource{folder_ / "fish.png"});
  does(action::Quit{});
  ASSERT_TRUE(state().question);
  EXPECT_NE(state().question->title.find("2 documents"), std::string::npos) << state().question->title;
  EXPECT_NE(state().question->text.find("\nsea\nsecond"), std::string::npos) << state().question->text;
  answer("save");
  for (const char* name : {"a", "b"}) {
    ASSERT_TRUE(state().file_request) << name;
    EXPECT_FALSE(editor_.wants_to_quit());
    editor_.perform_all({action::SaveAs{folder_ / name}, action::Dismiss{}});
    settle();
  }
  EXPECT_TRUE(editor_.wants_to_quit());
  EXPECT_TRUE(fs::exists(folder_ / (std::string("a") + kProjectEnding)));
  EXPECT_TRUE(fs::exists(folder_ / (std::string("b") + kProjectEnding)));
}

TEST_F(EditorTest, quitting_without_changes_asks_nothing) {
  does(action::Open{picture("sea.png")});
  does(action::Quit{});
  EXPECT_FALSE(state().question);
  EXPECT_TRUE(editor_.wants_to_quit());
}

} // namespace
} // namespace oversketch
