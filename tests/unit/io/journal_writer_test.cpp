#include "core/io/journal_writer.h"

#include "tests/unit/io/projects.h"

#include <condition_variable>
#include <mutex>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

/// Posts a step whose picture cannot be written: a file is where the pictures' folder should be, LEFT/images.
void append_in_vain(JournalWriter& writer, const fs::path& left) {
  ASSERT_TRUE(write_file(left / "images", "in the way").ok());
  DocumentNew begin;
  begin.target = loaded_ref("target.png", wavy_image(20, 20, 1));
  writer.append(begin);
  writer.flush();
  ASSERT_TRUE(writer.problem().has_value());
}

TEST(JournalWriter, writes_everything_in_order_before_it_goes) {
  const TempFolder folder;
  const Session session = small_session();
  fs::path left;
  {
    auto journal = Journal::begin(folder.path(), "work");
    ASSERT_TRUE(journal.ok());
    left = journal->folder();
    JournalWriter writer(std::move(*journal));
    for (const Step& step : session.log())
      writer.append(step);
    writer.flush();
    EXPECT_EQ(writer.problem(), std::nullopt);
    writer.mark_saved("later.ora");
    writer.append(UndoStep{2});
  }
  const auto found = list_abandoned_journals(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "later.ora");
  EXPECT_EQ(found[0].unsaved_steps, 1);
  const auto recovered = recover_journal(left);
  ASSERT_TRUE(recovered.ok()) << to_string(recovered.error());
  EXPECT_EQ(recovered->session.history().cursor(), session.history().cursor() - 2);
  EXPECT_EQ(recovered->session.history().entries().back().document, session.document());
}

TEST(JournalWriter, tells_what_could_not_be_written_and_goes_on_when_it_can) {
  const TempFolder folder;
  auto journal = Journal::begin(folder.path(), "work");
  ASSERT_TRUE(journal.ok());
  const fs::path left = journal->folder();
  {
    JournalWriter writer(std::move(*journal));
    append_in_vain(writer, left);
    EXPECT_EQ(writer.problem()->code, "file.write");
    fs::remove(left / "images");
    writer.append(LayerAdd{{std::string(kTargetName), {}}, {}});
    writer.flush();
    EXPECT_EQ(writer.problem(), std::nullopt);
  }
  const auto recovered = recover_journal(left);
  ASSERT_TRUE(recovered.ok()) << to_string(recovered.error());
  EXPECT_EQ(recovered->steps, 2);
}

TEST(JournalWriter, tries_again_by_itself_when_nothing_more_is_done) {
  const TempFolder folder;
  auto journal = Journal::begin(folder.path(), "work");
  ASSERT_TRUE(journal.ok());
  const fs::path left = journal->folder();
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<bool> news;
  const auto on_news = [&](const std::optional<Error>& problem) {
    const std::lock_guard lock(mutex);
    news.push_back(problem.has_value());
    changed.notify_all();
  };
  JournalWriter writer(std::move(*journal), on_news, std::chrono::milliseconds(5));
  append_in_vain(writer, left);
  fs::remove(left / "images");
  std::unique_lock lock(mutex);
  EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(60), [&] { return news.size() > 1; }));
  EXPECT_EQ(news, (std::vector<bool>{true, false}));
  lock.unlock();
  EXPECT_NE(read_text_file(left / "journal.jsonl")->find("document.new"), std::string::npos);
}

TEST(JournalWriter, leaves_nothing_after_a_clean_exit) {
  const TempFolder folder;
  auto journal = Journal::begin(folder.path(), "work");
  ASSERT_TRUE(journal.ok());
  const fs::path left = journal->folder();
  JournalWriter writer(std::move(*journal));
  writer.append(new_document(20, 20));
  writer.discard();
  EXPECT_FALSE(fs::exists(left));
}

} // namespace
} // namespace oversketch
