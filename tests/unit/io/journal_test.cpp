#include "core/io/journal.h"

#include "core/image/image_io.h"
#include "core/io/runner.h"

#include "tests/support/kept_variable.h"
#include "tests/unit/io/journal_fixture.h"

#include <csignal>
#include <cstdlib>
#include <sys/wait.h>
#include <unistd.h>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

TEST_F(JournalTest, what_cannot_be_written_or_read_is_an_error) {
  folder.write("file", "no folder");
  EXPECT_EQ(Journal::begin(folder / "file", "a").error().code, "journal.write");
  EXPECT_EQ(Journal::begin(folder.path(), "a", folder / "none.ora").error().code, "journal.write");
  EXPECT_TRUE(fs::is_empty(folder / "journals")) << "half a journal";
  EXPECT_EQ(recover_journal(folder / "none").error().code, "journal.unreadable");
  EXPECT_TRUE(list_abandoned_journals(folder / "none").empty());
  EXPECT_EQ(remove_old_journals(folder / "none", {}), 0);
}

TEST_F(JournalTest, the_state_folder_is_where_the_system_wants_it) {
  const testing::KeptVariable state("XDG_STATE_HOME"), home("HOME");
  ::setenv("XDG_STATE_HOME", "/some/state", 1);
  EXPECT_EQ(*default_state_folder(), "/some/state/oversketch");
  ::setenv("XDG_STATE_HOME", "relative", 1);
  ::setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(*default_state_folder(), "/home/someone/.local/state/oversketch");
  ::unsetenv("XDG_STATE_HOME");
  EXPECT_EQ(*default_state_folder(), "/home/someone/.local/state/oversketch");
  ::unsetenv("HOME");
  EXPECT_EQ(default_state_folder().error().code, "journal.no-home");
}

TEST_F(JournalTest, brings_back_what_was_done) {
  for (unsigned seed = 30; seed < 36; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Session session = random_session(seed, 25, wavy_image(90, 80, 1));
    if (!session.composite()) continue;
    fs::path left;
    {
      Journal journal = begin();
      append_from(journal, session, 0);
      left = journal.folder();
      EXPECT_TRUE(list_abandoned_journals(folder.path()).empty()) << "its process lives";
      EXPECT_EQ(recover_journal(left).error().code, "journal.in-use");
    }
    const auto found = list_abandoned_journals(folder.path());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].folder, left);
    EXPECT_EQ(found[0].name, "work.ora");
    EXPECT_EQ(found[0].steps, static_cast<int>(session.log().size()));
    EXPECT_LT(std::chrono::system_clock::now() - found[0].last_change, std::chrono::minutes(5));
    RecoveredJournal recovered = recover(left);
    EXPECT_EQ(recovered.message, "");
    EXPECT_EQ(recovered.steps, found[0].steps);
    expect_same(recovered.session, session);
    EXPECT_TRUE(recovered.session.history().modified() || session.history().cursor() == 0);
    recovered.journal.discard();
    EXPECT_FALSE(fs::exists(left));
  }
}

TEST_F(JournalTest, is_a_script_that_others_can_run) {
  Session session = small_session(), replay;
  Journal journal = begin();
  append_from(journal, session, 0);
  const auto done = run_script_file(replay, journal.folder() / "journal.jsonl", folder.path(), {});
  ASSERT_TRUE(done.ok()) << to_string(done.error());
  expect_same(replay, session);
}

TEST_F(JournalTest, goes_on_from_an_opened_project_and_from_a_recovered_journal) {
  Session session = small_session();
  save(session, folder / "work.ora");
  const std::size_t before = session.log().size();
  fs::path left;
  {
    Journal journal = begin(folder / "work.ora");
    left = journal.folder();
    must_run(session, LayerMove{{}, {5, 1}});
    append_from(journal, session, before);
  }
  // The project may be gone or another by now.
  folder.write("work.ora", "another");
  {
    RecoveredJournal recovered = recover(left);
    expect_same(recovered.session, session);
    EXPECT_EQ(recovered.steps, 1);
    EXPECT_TRUE(recovered.session.history().modified());
    must_run(recovered.session, LayerMove{{}, {0, 3}});
    must_run(session, LayerMove{{}, {0, 3}});
    ASSERT_TRUE(recovered.journal.append(LayerMove{{}, {0, 3}}).ok());
  }
  RecoveredJournal again = recover(left);
  expect_same(again.session, session);
}

TEST_F(JournalTest, knows_what_was_saved_since) {
  Session session = small_session();
  fs::path left;
  {
    Journal journal = begin();
    left = journal.folder();
    append_from(journal, session, 0);
    ASSERT_TRUE(journal.mark_saved("later.ora").ok());
    must_run(session, LayerMove{{}, {5, 1}});
    append_from(journal, session, 6);
  }
  const auto found = list_abandoned_journals(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "later.ora");
  EXPECT_EQ(found[0].steps, 7);
  EXPECT_EQ(found[0].unsaved_steps, 1);
  RecoveredJournal recovered = recover(left);
  EXPECT_TRUE(recovered.session.history().modified());
  ASSERT_TRUE(recovered.session.undo().ok());
  EXPECT_FALSE(recovered.session.history().modified());
}

TEST_F(JournalTest, loses_the_line_in_hand_alone_wherever_it_was_cut) {
  Session session = small_session();
  std::string whole;
  fs::path left;
  {
    Journal journal = begin();
    left = journal.folder();
    append_from(journal, session, 0);
    whole = text(left);
  }
  const std::size_t last_line = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t length = whole.size() - 1; length >= last_line; length -= 3) {
    set_text(left, whole.substr(0, length));
    RecoveredJournal recovered = recover(left);
    EXPECT_EQ(recovered.steps, 5);
    EXPECT_EQ(recovered.message, "");
    EXPECT_EQ(recovered.session.document().layers[0].pins.size(), 1u);
    // The cut line is gone, so that the next one stands alone.
    ASSERT_TRUE(recovered.journal.append(UndoStep{1}).ok());
    EXPECT_EQ(text(left), whole.substr(0, last_line) + "{\"do\":\"undo\"}\n");
  }
}

TEST_F(JournalTest, replays_up_to_the_line_that_is_damaged_and_keeps_the_rest) {
  Session session = small_session();
  const fs::path left = leave_journal(session);
  std::string bad = text(left);
  const auto at = bad.find("{\"do\":\"pin.add\"");
  ASSERT_NE(at, std::string::npos);
  bad[at + 1] = '#';
  set_text(left, bad);
  const RecoveredJournal recovered = recover(left);
  EXPECT_EQ(recovered.steps, 4);
  EXPECT_NE(recovered.message.find("line 7 of 8"), std::string::npos) << recovered.message;
  EXPECT_TRUE(recovered.session.document().layers[0].pins.empty());
  EXPECT_EQ(text(left), bad.substr(0, at));
  EXPECT_EQ(*read_text_file(left / "journal.jsonl~"), bad.substr(at));
}

TEST_F(JournalTest, what_two_recoveries_left_over_is_all_there) {
  Session session = small_session();
  const fs::path left = leave_journal(session);
  const std::string whole = text(left);
  for (const char* rest : {"garbage\nand more\n", "garbage again\n"}) {
    set_text(left, whole + rest);
    EXPECT_NE(recover(left).message, "");
    EXPECT_EQ(text(left), whole);
  }
  EXPECT_EQ(*read_text_file(left / "journal.jsonl~"), "garbage\nand more\ngarbage again\n");
}

TEST_F(JournalTest, passes_over_no_line_that_is_neither_a_step_nor_a_comment) {
  Session session = small_session();
  must_run(session, LayerMove{{}, {7, 0}});
  const fs::path left = leave_journal(session);
  std::string bad = text(left);
  const auto at = bad.find("{\"do\":\"pin.add\""), end = bad.find('\n', at);
  ASSERT_NE(at, std::string::npos);
  set_text(left, bad.replace(at, end - at, "garbage"));
  const RecoveredJournal recovered = recover(left);
  EXPECT_EQ(recovered.session.history().entries().size(), 4U);
  EXPECT_NE(recovered.message.find("line 7 of 9"), std::string::npos) << recovered.message;
}

TEST_F(JournalTest, reads_nothing_outside_its_folder) {
  ASSERT_TRUE(write_file(folder / "secret.png", std::span<const std::byte>(*encode_png(wavy_image(9, 9, 0)))).ok());
  Session session = small_session();
  save(session, folder / "secret.ora");
  fs::path left;
  {
    Journal journal = begin();
    left = journal.folder();
  }
  const std::string header = text(left);
  fs::create_symlink(folder / "secret.png", left / "link.png");
  fs::create_directory_symlink(folder.path(), left / "up");
  const std::string secret = (folder / "secret.png").string();
  for (const std::string& name : {secret, std::string("../../secret.png"), std::string("link.png"),
                                  std::string("up/secret.png"), std::string("images/../../../secret.png")}) {
    set_text(left, header + "{\"do\": \"document.new\", \"target\": \"" + name + "\"}\n");
    EXPECT_EQ(recover_journal(left).error().code, "journal.outside") << name;
  }
  for (const char* name : {"../../secret.ora", "up/secret.ora"}) {
    set_text(left, header + "{\"do\": \"open\", \"path\": \"" + name + "\"}\n");
    EXPECT_EQ(recover_journal(left).error().code, "journal.outside") << name;
  }
  for (const char* line : {"{\"do\": \"export\", \"path\": \"x.png\"}", "{\"do\": \"save\", \"path\": \"x.ora\"}",
                           "{\"do\": \"expect\", \"image\": \"../../secret.png\"}"}) {
    set_text(left, header + line + "\n");
    EXPECT_EQ(recover_journal(left).error().code, "journal.step") << line;
  }
  set_text(left, header + "{\"do\": \"document.new\", \"target\": \"journal.jsonl\"}\n");
  EXPECT_EQ(recover_journal(left).error().code, "image.unknown-format") << "not even its own, when it is no picture";
  fs::remove(left / "journal.jsonl");
  fs::create_symlink(folder / "secret.png", left / "journal.jsonl");
  EXPECT_EQ(recover_journal(left).error().code, "journal.unreadable");
}

TEST_F(JournalTest, takes_no_more_memory_than_it_may) {
  Session session = small_session();
  const fs::path left = leave_journal(session);
  IoLimits little;
  little.memory_bytes = 200'000;
  EXPECT_NE(recover_journal(left, little)->message.find("memory"), std::string::npos) << "the second picture";
  little.memory_bytes = 100'000;
  EXPECT_EQ(recover_journal(left, little).error().code, "project.too-large");
}

TEST_F(JournalTest, is_removed_after_a_clean_exit_and_after_a_week) {
  Journal living = begin();
  ASSERT_TRUE(living.append(new_document(20, 20)).ok());
  fs::path left;
  {
    Journal journal = begin();
    ASSERT_TRUE(journal.append(new_document(20, 20)).ok());
    left = journal.folder();
    Journal clean = begin();
    const fs::path gone = clean.folder();
    ASSERT_TRUE(fs::exists(gone));
    clean.discard();
    EXPECT_FALSE(fs::exists(gone));
  }
  const auto now = std::chrono::system_clock::now();
  EXPECT_EQ(remove_old_journals(folder.path(), now + std::chrono::hours(24 * 6)), 0);
  EXPECT_EQ(remove_old_journals(folder.path(), now + std::chrono::hours(24 * 8)), 1);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(living.folder())) << "its process lives";
}

TEST_F(JournalTest, one_that_is_killed_is_found_and_one_that_lives_is_not) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    auto journal = Journal::begin(folder.path(), "of a child");
    const bool good = journal.ok() && journal->append(new_document(20, 20)).ok();
    (void)!::write(ready[1], good ? "y" : "n", 1);
    ::pause();
    ::_exit(0);
  }
  char answer = 0;
  ASSERT_EQ(::read(ready[0], &answer, 1), 1);
  EXPECT_EQ(answer, 'y');
  EXPECT_TRUE(list_abandoned_journals(folder.path()).empty());
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const auto found = list_abandoned_journals(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "of a child");
}

} // namespace
} // namespace oversketch
