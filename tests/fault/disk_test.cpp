// Every call that writes to the disk fails once, for want of room and for a broken disk: an error, the old file intact.

#include "core/base/file.h"
#include "core/io/journal.h"
#include "core/io/project.h"

#include "tests/fault/failing_disk.h"
#include "tests/fault/memory_folder.h"
#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cerrno>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

Session small_work() {
  Session session;
  DocumentNew begin;
  begin.target = loaded_ref("target.png", wavy_image(60, 50, 1));
  EXPECT_TRUE(session.execute(begin).ok());
  EXPECT_TRUE(session.execute(LayerAdd{loaded_ref("s.png", wavy_image(60, 50, 2)), {}}).ok());
  EXPECT_TRUE(session.execute(RegionSet{{}, blob({30, 25}, 15)}).ok());
  return session;
}

/// Calls visit(n, error) for n = 1, 2, … until `work` has no n-th call any more; returns how many there are.
template <class Visit>
int for_each_failure(const Visit& visit) {
  int most = 0;
  for (const int error : {ENOSPC, EIO}) {
    int n = 1;
    while (n < 1000 && visit(n, error))
      ++n;
    most = std::max(most, n - 1);
  }
  return most;
}

std::size_t count_files(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator()));
}

TEST(Disk, whatever_write_fails_a_project_stays_as_it_was) {
  use_folders_in_memory();
  Session session = small_work();
  const TempFolder folder;
  const fs::path path = folder / "work.ora";
  ASSERT_TRUE(save_project(session, path).ok());
  const std::string old = folder.read("work.ora");
  ASSERT_TRUE(session.execute(LayerMove{{}, {3, 3}}).ok());
  const auto contents = gather_project(session);
  ASSERT_TRUE(contents.ok());
  ASSERT_TRUE(write_project(*contents, folder / "new.ora").ok());
  const std::string fresh = folder.read("new.ora");
  fs::remove(folder / "new.ora");
  ASSERT_NE(old, fresh);
  int refused = 0;
  const int calls = for_each_failure([&](int n, int error) {
    folder.write("work.ora", old);
    fs::remove(folder / "work.ora~");
    fail_disk_call(n, error);
    const auto written = write_project(*contents, path);
    const bool reached = mend_disk() >= n;
    if (written) {
      EXPECT_EQ(folder.read("work.ora"), fresh) << n;
    } else {
      ++refused;
      EXPECT_EQ(written.error().code, "file.write") << n;
      EXPECT_NE(written.error().sentence.find(error == EIO ? "error" : "space"), std::string::npos)
          << written.error().sentence;
      EXPECT_EQ(folder.read("work.ora"), old) << n;
    }
    if (fs::exists(folder / "work.ora~")) EXPECT_EQ(folder.read("work.ora~"), old) << n;
    EXPECT_EQ(count_files(folder.path()), fs::exists(folder / "work.ora~") ? 2u : 1u)
        << n << ": something stayed behind";
    return reached;
  });
  EXPECT_GE(calls, 6) << "make, write, sync, link, rename twice";
  EXPECT_GE(refused, 2 * 5);
}

TEST(Disk, whatever_write_fails_a_new_project_is_whole_or_not_there) {
  use_folders_in_memory();
  Session session = small_work();
  const auto contents = gather_project(session);
  ASSERT_TRUE(contents.ok());
  const TempFolder folder;
  for_each_failure([&](int n, int error) {
    fs::remove(folder / "new.ora");
    fail_disk_call(n, error);
    const auto written = write_project(*contents, folder / "new.ora");
    const bool reached = mend_disk() >= n;
    EXPECT_EQ(written.ok(), fs::exists(folder / "new.ora")) << n;
    EXPECT_EQ(count_files(folder.path()), written.ok() ? 1u : 0u) << n;
    return reached;
  });
}

TEST(Disk, whatever_write_fails_a_journal_catches_up_and_loses_nothing) {
  use_folders_in_memory();
  const Session session = small_work();
  const TempFolder folder;
  const int calls = for_each_failure([&](int n, int error) {
    const fs::path state = folder / ("state" + std::to_string(n) + "-" + std::to_string(error));
    auto journal = Journal::begin(state, "work");
    EXPECT_TRUE(journal.ok());
    fs::path left = journal->folder();
    fail_disk_call(n, error);
    int refused = 0;
    for (const Step& step : session.log())
      if (const auto done = journal->append(step); !done) {
        ++refused;
        EXPECT_FALSE(done.error().sentence.empty());
      }
    const bool reached = mend_disk() >= n;
    EXPECT_LE(refused, 1) << n << ": the next one brings it along";
    EXPECT_TRUE(journal->append(UndoStep{1}).ok());
    { const Journal gone = std::move(*journal); }
    auto recovered = recover_journal(left);
    EXPECT_TRUE(recovered.ok()) << n << " " << to_string(recovered.error());
    if (!recovered) return false;
    EXPECT_EQ(recovered->message, "") << n;
    EXPECT_EQ(recovered->steps, 4) << n;
    EXPECT_EQ(recovered->session.history().entries().size(), 3u) << n;
    EXPECT_EQ(recovered->session.document(), session.history().entries()[1].document) << n;
    return reached;
  });
  EXPECT_GE(calls, 3 * 3);
}

TEST(Disk, whatever_write_fails_a_journal_begins_whole_or_not_at_all) {
  use_folders_in_memory();
  const TempFolder folder;
  for_each_failure([&](int n, int error) {
    const fs::path state = folder / ("state" + std::to_string(n) + "-" + std::to_string(error));
    fail_disk_call(n, error);
    auto journal = Journal::begin(state, "work");
    const bool reached = mend_disk() >= n;
    if (journal)
      EXPECT_TRUE(journal->append(new_document(20, 20)).ok()) << n;
    else
      EXPECT_EQ(journal.error().code, "journal.write") << n;
    return reached;
  });
}

} // namespace
} // namespace oversketch
