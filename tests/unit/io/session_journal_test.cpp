#include "core/io/session_journal.h"

#include "tests/unit/io/projects.h"

#include <functional>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

/// A session and its journal, followed as a worker does it: after each request.
class Followed {
public:
  Followed(const fs::path& state_folder, const std::string& name) : journal(state_folder, name, [this] { ++told; }) {}

  void run(const Command& command) {
    must_run(session, command);
    journal.follow(session);
  }

  int told = 0;
  Session session;
  SessionJournal journal;
};

DocumentNew begin_with(int side) {
  DocumentNew begin;
  begin.target = loaded_ref("sea.png", wavy_image(side, side, 1));
  return begin;
}

const Command kAddTarget = LayerAdd{{std::string(kTargetName), {}}, "part"};

TEST(SessionJournal, tells_as_long_as_it_cannot_write_and_stops_nothing) {
  const TempFolder folder;
  folder.write("plain", "a file, not a folder");
  Followed work(folder / "plain", "sea");
  work.run(begin_with(20));
  work.run(kAddTarget);
  work.run(LayerRename{{}, "other"});
  EXPECT_EQ(work.told, 1);
  ASSERT_TRUE(work.journal.problem().has_value());
  EXPECT_EQ(work.journal.problem()->code, "journal.write");
  // The disk is there again: nothing is missing.
  fs::remove(folder / "plain");
  work.run(LayerRename{{}, "third"});
  work.journal.flush();
  EXPECT_EQ(work.told, 2);
  EXPECT_EQ(work.journal.problem(), std::nullopt);
  const auto left = fs::directory_iterator(folder / "plain/journals")->path();
  work.journal.discard();
  EXPECT_FALSE(fs::exists(left));
}

TEST(SessionJournal, writes_nothing_without_a_folder_or_a_change) {
  const TempFolder folder;
  Followed nowhere("", "sea");
  nowhere.run(begin_with(20));
  nowhere.run(kAddTarget);
  EXPECT_EQ(nowhere.told, 0);
  Followed unchanged(folder.path(), "sea");
  unchanged.run(begin_with(20));
  unchanged.journal.flush();
  EXPECT_FALSE(fs::exists(folder / "journals")) << "a picture that was opened is no work";
}

TEST(SessionJournal, a_crash_loses_neither_pictures_nor_history) {
  const TempFolder folder;
  std::vector<std::string> labels;
  Document document;
  {
    Followed work(folder.path(), "sea");
    work.run(begin_with(20));
    work.run(kAddTarget);
    work.run(LayerRename{{}, "other"});
    ASSERT_TRUE(work.session.undo().ok());
    work.journal.follow(work.session);
    document = work.session.document();
  }
  const auto found = list_abandoned_journals(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "sea");
  EXPECT_EQ(found[0].unsaved_steps, 4);
  auto recovered = recover_journal(found[0].folder);
  ASSERT_TRUE(recovered.ok()) << to_string(recovered.error());
  EXPECT_EQ(recovered->session.document(), document);
  EXPECT_EQ(recovered->session.history().entries().size(), 3u);
  EXPECT_EQ(recovered->session.history().cursor(), 1u);

  // And it goes on from there, until the next crash.
  {
    Followed again(folder.path(), "");
    again.session.adopt(std::move(recovered->session));
    again.journal.resume(again.session, std::move(recovered->journal));
    again.run(LayerRename{{}, "fourth"});
    document = again.session.document();
  }
  const auto second = list_abandoned_journals(folder.path());
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].steps, 5);
  const auto last = recover_journal(second[0].folder);
  ASSERT_TRUE(last.ok());
  EXPECT_EQ(last->session.document(), document);
}

TEST(SessionJournal, what_was_opened_is_copied_before_anybody_saves_over_it) {
  const TempFolder folder;
  Session saved = small_session();
  const fs::path file = folder / "work.ora";
  ASSERT_TRUE(save_project(saved, file, {}, {}).ok());
  Document document;
  {
    Followed work(folder / "state", "");
    auto loaded = load_project(file, {}, {});
    ASSERT_TRUE(loaded.ok());
    work.session.adopt(std::move(loaded->session));
    work.journal.begin(work.session, file.string(), file);
    fs::remove(file);
    work.run(LayerRename{{}, "after"});
    document = work.session.document();
  }
  const auto found = list_abandoned_journals(folder / "state");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, file.string());
  EXPECT_EQ(found[0].steps, 1);
  const auto recovered = recover_journal(found[0].folder);
  ASSERT_TRUE(recovered.ok()) << to_string(recovered.error());
  EXPECT_EQ(recovered->session.document(), document);
}

/// Opens a picture, saves it, does what `meanwhile` does to the file, goes on, and crashes.
void expect_recovered_after_saving(const std::function<void(const fs::path& file)>& meanwhile) {
  const TempFolder folder;
  const fs::path file = folder / "sea.ora";
  Document document;
  {
    Followed work(folder / "state", "sea");
    work.run(begin_with(20));
    ASSERT_TRUE(save_project(work.session, file).ok());
    work.session.mark_saved();
    work.journal.mark_saved(work.session, file);
    meanwhile(file);
    work.run(kAddTarget);
    document = work.session.document();
  }
  const auto found = list_abandoned_journals(folder / "state");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, file.string());
  const auto recovered = recover_journal(found[0].folder);
  ASSERT_TRUE(recovered.ok()) << to_string(recovered.error());
  EXPECT_EQ(recovered->message, "");
  EXPECT_EQ(recovered->session.document(), document);
}

TEST(SessionJournal, what_becomes_of_a_saved_file_is_nobodys_concern) {
  expect_recovered_after_saving([](const fs::path& file) { fs::remove(file); });
  expect_recovered_after_saving([](const fs::path& file) {
    Session other = small_session();
    ASSERT_TRUE(save_project(other, file).ok());
  });
}

TEST(SessionJournal, begins_at_the_beginning_where_the_saved_file_is_gone) {
  const TempFolder folder;
  Document document;
  {
    Followed work(folder / "state", "sea");
    work.run(begin_with(20));
    work.journal.mark_saved(work.session, folder / "none.ora");
    EXPECT_EQ(work.journal.problem(), std::nullopt);
    work.run(kAddTarget);
    document = work.session.document();
  }
  const auto found = list_abandoned_journals(folder / "state");
  ASSERT_EQ(found.size(), 1u);
  const auto recovered = recover_journal(found[0].folder);
  ASSERT_TRUE(recovered.ok()) << to_string(recovered.error());
  EXPECT_EQ(recovered->session.document(), document);
}

TEST(SessionJournal, a_document_in_its_place_begins_another) {
  const TempFolder folder;
  {
    Followed work(folder.path(), "sea");
    work.run(begin_with(20));
    work.run(kAddTarget);
    work.run(begin_with(30));
    work.run(LayerAdd{loaded_ref("fish.png", wavy_image(24, 22, 2)), "fish"});
  }
  const auto found = list_abandoned_journals(folder.path());
  ASSERT_EQ(found.size(), 1u);
  const auto recovered = recover_journal(found[0].folder);
  ASSERT_TRUE(recovered.ok());
  EXPECT_EQ(recovered->session.document().target.image.width(), 30);
  EXPECT_EQ(recovered->steps, 2);
}

TEST(SessionJournal, saving_leaves_nothing_to_recover) {
  const TempFolder folder;
  {
    Followed work(folder.path(), "sea");
    work.run(begin_with(20));
    work.run(kAddTarget);
    work.session.mark_saved();
    work.journal.mark_saved(work.session, folder / "sea.ora");
  }
  const auto found = list_abandoned_journals(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].unsaved_steps, 0);
  EXPECT_EQ(found[0].name, (folder / "sea.ora").string());
  discard_abandoned_journal(found[0].folder);
  EXPECT_TRUE(list_abandoned_journals(folder.path()).empty());
}

} // namespace
} // namespace oversketch
