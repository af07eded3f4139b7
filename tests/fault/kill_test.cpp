// A process is killed at random moments while it works and saves: what it had done must be there.
//
// OVERSKETCH_KILLS sets how often (30 when it is not set, fewer with the sanitizers); the seed is printed on failure.

#include "core/io/journal.h"
#include "core/io/project.h"

#include "tests/fault/memory_folder.h"
#include "tests/fault/work.h"
#include "tests/support/documents.h"
#include "tests/support/effort.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <random>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

/// What the victim had said when it died.
struct LastWords {
  std::size_t journaled = 0;
  std::size_t save_begun = 0;
  std::size_t save_done = 0;
  int lines = 0;
};

void hear(LastWords& words, const std::string& line) {
  const std::size_t steps = std::strtoull(line.c_str() + 2, nullptr, 10);
  (line[0] == 'J' ? words.journaled : line[0] == 'S' ? words.save_begun : words.save_done) = steps;
  ++words.lines;
}

/// Runs the victim, kills it some time after it has said so many lines, and hears all that it said.
LastWords run_and_kill(const fs::path& folder, unsigned seed, int lines, std::chrono::microseconds later) {
  int pipe[2];
  EXPECT_EQ(::pipe(pipe), 0);
  const pid_t victim = ::fork();
  if (victim == 0) {
    ::dup2(pipe[1], STDOUT_FILENO);
    ::close(pipe[0]);
    ::close(pipe[1]);
    ::execl(OVERSKETCH_FAULT_VICTIM, "victim", folder.c_str(), std::to_string(seed).c_str(), nullptr);
    ::_exit(127);
  }
  ::close(pipe[1]);
  LastWords words;
  std::string line;
  bool killed = false;
  for (char c = 0; ::read(pipe[0], &c, 1) == 1;) {
    line += c;
    if (c != '\n') continue;
    hear(words, line);
    line.clear();
    if (killed || words.lines < lines) continue;
    std::this_thread::sleep_for(later);
    ::kill(victim, SIGKILL);
    killed = true;
  }
  ::close(pipe[0]);
  int status = 0;
  ::waitpid(victim, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "ended by itself: " << status;
  return words;
}

void expect_same(const Session& found, const Session& known) {
  EXPECT_EQ(found.document(), known.document());
  EXPECT_EQ(found.history().cursor(), known.history().cursor());
  EXPECT_EQ(found.history().entries().size(), known.history().entries().size());
}

/// The work as it was after so many steps.
Session work_after(unsigned seed, std::size_t steps) {
  Work work(seed);
  while (work.session().log().size() < steps)
    work.go_on();
  return std::move(work.session());
}

void expect_journal(const fs::path& folder, unsigned seed, const LastWords& words) {
  const auto journals = list_abandoned_journals(folder / "state");
  if (journals.empty()) {
    EXPECT_EQ(words.journaled, 0u);
    return;
  }
  ASSERT_EQ(journals.size(), 1u);
  const auto recovered = recover_journal(journals[0].folder);
  ASSERT_TRUE(recovered.ok()) << to_string(recovered.error());
  EXPECT_EQ(recovered->message, "");
  const auto steps = static_cast<std::size_t>(recovered->steps);
  EXPECT_GE(steps, words.journaled) << "a step that was synced is lost";
  EXPECT_LE(steps, words.journaled + 1);
  expect_same(recovered->session, work_after(seed, steps));
}

void expect_project(const fs::path& folder, unsigned seed, const LastWords& words) {
  for (const char* name : {"work.ora", "work.ora~"}) {
    std::error_code ignored;
    if (!fs::exists(folder / name, ignored)) continue;
    const auto loaded = load_project(folder / name);
    ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
    if (std::string_view(name) == "work.ora~") continue;
    // The history tells which of the two states it is.
    const Session before = work_after(seed, words.save_done), after = work_after(seed, words.save_begun);
    const bool is_after = loaded->session.document() == after.document() &&
                          loaded->session.history().entries().size() == after.history().entries().size() &&
                          loaded->session.history().cursor() == after.history().cursor();
    if (!is_after) expect_same(loaded->session, before);
  }
  if (words.save_done > 0) EXPECT_TRUE(fs::exists(folder / "work.ora")) << "a save that was done is gone";
}

int count_half_written(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    count += entry.path().extension() == ".tmp" ? 1 : 0;
  return count;
}

/// Whoever saves there next clears away what the dead one left half-written.
void expect_cleared(const fs::path& folder) {
  Session session;
  ASSERT_TRUE(session.execute(new_document(8, 8)).ok());
  const auto saved = save_project(session, folder / "next.ora");
  ASSERT_TRUE(saved.ok()) << to_string(saved.error());
  EXPECT_EQ(count_half_written(folder), 0);
}

TEST(Killed, at_any_moment_a_process_leaves_the_project_whole_and_loses_one_step_at_most) {
  use_folders_in_memory();
  const int kills = testing::tries(30, "OVERSKETCH_KILLS");
  std::mt19937 random(2026);
  int in_save = 0, with_project = 0, half_written = 0;
  for (int i = 0; i < kills; ++i) {
    const unsigned seed = 1 + static_cast<unsigned>(i % 7);
    const int lines = 1 + static_cast<int>(random() % 60);
    const std::chrono::microseconds later(random() % 12'000);
    SCOPED_TRACE("kill " + std::to_string(i) + ": seed " + std::to_string(seed) + ", after " + std::to_string(lines) +
                 " lines and " + std::to_string(later.count()) + " µs");
    const TempFolder folder;
    const LastWords words = run_and_kill(folder.path(), seed, lines, later);
    in_save += words.save_begun > words.save_done ? 1 : 0;
    with_project += words.save_done > 0 ? 1 : 0;
    expect_journal(folder.path(), seed, words);
    expect_project(folder.path(), seed, words);
    half_written += count_half_written(folder.path());
    expect_cleared(folder.path());
    if (HasFailure()) break;
  }
  RecordProperty("kills", kills);
  RecordProperty("during_a_save", in_save);
  RecordProperty("half_written_files", half_written);
  EXPECT_GT(in_save, kills / 20) << "kills hit saves too";
  EXPECT_GT(with_project, kills / 2);
}

} // namespace
} // namespace oversketch
